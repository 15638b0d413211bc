// One frame: depths, surfaces, mask, panes and pictures, whatever the shadows are read from.
#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "frame/options_in_use.hpp"
#include "frame/renderer_impl.hpp"
#include "gl/pass_timer.hpp"
#include "gnomon/render/contacts.hpp"

namespace gnomon::render {
namespace {

/// View depth of thick air: the far plane's for an eye in the scene. Farther off for one outside, whose far
/// plane may lie close behind a single object: that has no distance in it.
double air_depth(const Camera& camera, double far_depth, const Box& scene_world) noexcept {
  constexpr double kLeast = 0.01;
  if (scene_world.empty()) return far_depth;
  const glm::dvec3 nearest = glm::clamp(camera.position, scene_world.min, scene_world.max);
  const double within = std::max(1.0 - glm::distance(nearest, camera.position) / far_depth, kLeast);
  return far_depth / (within * within);
}

}  // namespace

void Renderer::Impl::draw(FrameJob& frame, FrameSource& source) {
  const PassTimer timed{frame.stats, frame.options.time_passes};
  const SourceSteps steps = source.steps(frame);
  const auto update = [&] { source.update(frame); };
  begin(frame, source);
  frame.block.layer.w = static_cast<float>(air_depth(frame.camera, frame.far_depth, bounds_world));
  screen.upload(frame.block, frame.filtering);
  if (!steps.casters_last) timed(Pass::shadow_maps, update);
  bool holds_surfaces = false;
  timed(Pass::surfaces, [&] {
    holds_surfaces = !screen.draw_surfaces(source.surfaces(), frame.camera.position, frame.block);
  });
  if (steps.stores_texels) timed(Pass::prefilter, [&] { source.store(frame); });
  timed(Pass::mask, [&] { draw_mask(frame, source); });
  if (steps.casters_last) timed(Pass::shadow_maps, update);
  if (frame.draws(FrameOption::accumulation)) timed(Pass::accumulate, [&] { accumulate(frame); });
  if (frame.panes != nullptr && !steps.adds_light) timed(Pass::panes, [&] { source.tint(frame); });
  timed(Pass::shade, [&] {
    steps.adds_light ? source.shade(frame) : pictures.shade(frame.block, frame.camera.position, frame.panes);
  });
  draw_pictures(frame, timed);
  source.count(frame);
  if (holds_surfaces) frame.stats.camera = {.held = true};
  frame.stats.ignored = frame.asked.without(frame.honoured);
}

void Renderer::Impl::begin(FrameJob& frame, FrameSource& source) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  screen.targets.resize(frame.camera.width, frame.camera.height);
  frame.asked = options_in_use(frame);
  frame.honoured = frame.asked.without(FrameOptionSet::all().without(source.supports(frame)));
  casters.take_moved(frame.options.moved_world);
  // A frame without maps brings none up to date: what moved is for the next one, as long as it is worth it.
  constexpr std::size_t kMaxMoved = 4096;
  if (source.steps(frame).takes_depths) {
    sources.lose(&source);
  } else if (casters.movers.changed_world().size() > kMaxMoved) {
    sources.lose(nullptr);
    casters.movers.forget_changes();
  }
  source.begin(frame);
  if (frame.draws(FrameOption::accumulation)) {
    history.resize(frame.camera.width, frame.camera.height);
    history.forget_behind(casters.movers.changed_world());
  } else {
    history.forget();  // the mask is this frame's alone
  }
}

void Renderer::Impl::draw_mask(FrameJob& frame, FrameSource& source) {
  const GLuint fbo =
      frame.draws(FrameOption::accumulation) ? history.single_fbo() : screen.targets.mask_fbo.name();
  if (source.supports(frame).has(FrameOption::noise)) screen.bind_noise(frame.options.noise);
  source.mask(frame, fbo);
  if (!frame.draws(FrameOption::contacts) || frame.plan.map_count == 0) return;
  constexpr GLint kFallOffLocation = 0;
  const FilterSettings& settings = frame.filter.settings;
  std::array<float, kMaxMaps> fall_off{};
  for (std::size_t i = 0; i < frame.plan.maps().size(); ++i)
    fall_off[i] = static_cast<float>(contact_reach_world(settings, map_depths(settings, frame.plan.map[i])));
  const Program& program = contact_pass.program(frame.shaped);
  glProgramUniform1fv(program.name(), kFallOffLocation, static_cast<GLsizei>(kMaxMaps), fall_off.data());
  glEnable(GL_BLEND);
  glBlendEquation(GL_MIN);
  screen.fullscreen(fbo, program);
  glBlendEquation(GL_FUNC_ADD);
  glDisable(GL_BLEND);
}

void Renderer::Impl::accumulate(const FrameJob& frame) {
  history.bind(frame.camera, frame.options.accumulation);
  screen.fullscreen(history.fbo_with(screen.targets.mask), accumulate_pass.program(frame.shaped));
  history.keep(frame.camera, frame.block);
}

void Renderer::Impl::draw_pictures(const FrameJob& frame, const PassTimer& timed) const {
  const bool aliasing = frame.draws(FrameOption::aliasing);
  if (aliasing) timed(Pass::aliasing, [&] { pictures.aliasing(); });
  if (aliasing && frame.draws(FrameOption::heat_map)) timed(Pass::heat_map, [&] { pictures.heat_map(); });
  if (frame.draws(FrameOption::cascade_tint)) timed(Pass::cascade_tint, [&] { pictures.cascade_tint(); });
}

}  // namespace gnomon::render
