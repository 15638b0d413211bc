// The irregular z-buffer: the mask begins lit, and triangles of casters darken the listed pixels behind them.
#include "source/lists.hpp"

#include <algorithm>

namespace gnomon::render {
namespace {

// Locations as shaders/pass/lists/* state them.
constexpr GLint kMapLocation = 3, kWrapLocation = 4, kSamplesLocation = 6;

}  // namespace

const SourceSupport ListSource::kSupport{
    "irregular", "pixels listed by the texels of a `ShadowPlan`'s maps",
    FrameOptionSet{FrameOption::light, FrameOption::aliasing, FrameOption::heat_map,
                   FrameOption::cascade_tint, FrameOption::moved_world, FrameOption::caster_clusters,
                   FrameOption::alpha_test, FrameOption::panes, FrameOption::bent_maps}};

ListSource::ListSource(CasterScene& casters, const CasterPass& pass, Screen& screen)
    : casters_(casters), pass_(pass), screen_(screen) {}

bool ListSource::fits(const Camera& camera, const Source& source) const noexcept {
  return lists_.fits(camera.width, camera.height, source.samples);
}

FrameOptionSet ListSource::supports(const FrameJob&) const noexcept {
  return kSupport.supports;
}

SourceSteps ListSource::steps(const FrameJob&) const noexcept {
  return {.casters_last = true};
}

void ListSource::begin(FrameJob& frame) {
  casters_.movers.forget_changes();  // every frame draws all casters
  const BlurSides blur{};
  glm::ivec2 size(1);
  for (const ShadowMap& map : frame.plan.maps()) size = glm::max(size, glm::ivec2(map.width, map.height));
  frame.block = frame_block(frame.plan, frame.camera, frame.options, size.x, size.y, blur, DepthCurves{});
  frame.filtering = filter_block(default_settings(filters::hard), blur);
  casters_.buffers.place(SceneBuffers::Placed::for_camera, frame.camera.position);
  // The rule that loses small casters is the only one that an exact mask would show.
  casters_.lists.build_uncached({frame.plan, frame.options.prune.without(PruneRule::small_casters)},
                                frame.camera);
  screen_.targets.add_off_plane();
  lists_.set_light(light_frames(frame.plan, frame.camera, casters_.buffers.extent()));
}

SurfacePass ListSource::surfaces() const noexcept {
  return {screen_.targets.off_plane_fbo.name(), &lists_.surfaces()};
}

void ListSource::mask(FrameJob& frame, GLuint) {
  const Camera& camera = frame.camera;
  lists_.clear({camera.width, camera.height}, frame.filter.source.samples,
               {frame.block.layer.x, frame.block.layer.y}, std::max(frame.plan.map_count, 1));
  screen_.bind_surfaces();
  lists_.list(screen_.targets.off_plane.name(), screen_.targets.mask.name());
}

void ListSource::update(FrameJob& frame) {
  const GLuint mask = screen_.targets.mask.name();
  lists_.bind(mask);
  glBindVertexArray(casters_.buffers.vertex_array());
  // From the camera, as the surfaces: casters then have the very corners of the triangles that are seen.
  casters_.buffers.use(SceneBuffers::Placed::for_camera);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  for (int i = 0; i < frame.plan.map_count; ++i) {
    const ShadowMap& map = frame.plan.map[static_cast<std::size_t>(i)];
    glViewport(0, 0, map.width, map.height);
    for (const DrawnPart& part : casters_.lists.parts(i)) {
      pass_.draw_by(part, CasterPrograms{lists_.opaque(), lists_.masked(), kWrapLocation},
                    frame.options.prune.has(PruneRule::alpha_test), [i, this] {
                      glUniform1i(kMapLocation, i);
                      glUniform1i(kSamplesLocation, lists_.samples());
                    });
    }
  }
  lists_.average(mask);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                  GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ListSource::tint(FrameJob& frame) {
  PanePass& panes = *frame.panes;
  panes.resize(frame.camera.width, frame.camera.height);
  lists_.bind(screen_.targets.mask.name());
  panes.draw_listed(frame.plan, frame.camera.position, lists_);
  screen_.fullscreen(panes.fbo(), panes.listed_program());
}

void ListSource::count(FrameJob& frame) {
  FrameStats& stats = frame.stats;
  stats.map_count = frame.plan.map_count;
  for (int i = 0; i < stats.map_count; ++i) {
    stats.map[static_cast<std::size_t>(i)] = casters_.lists.map_stats(i);
    stats.texels += casters_.lists.map_stats(i).texels;
  }
  count_lists(casters_.lists, stats);
  stats.irregular = true;
  stats.map_bytes = lists_.bytes() + (frame.panes != nullptr ? frame.panes->bytes() : 0);
}

}  // namespace gnomon::render
