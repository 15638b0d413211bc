// What a program calls: a scene, its filters, what moves in it, its frames and where they are shown.
#include "gnomon/render/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "casters/view_planes.hpp"
#include "frame/renderer_impl.hpp"
#include "gnomon/render/page_filter.hpp"

namespace gnomon::render {
namespace {

void GLAD_API_PTR report_gl_error(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                                  const void*) {
  if (type == GL_DEBUG_TYPE_ERROR) std::fprintf(stderr, "OpenGL: %s\n", message);
}

/// A camera of parallel rays with planes next to what it shows. Its depths are even: planes far from all
/// surfaces would leave those few steps of a float.
Camera between_surfaces(Camera camera, std::span<const Box> casters, std::span<const Box> panes) noexcept {
  if (!camera.orthographic) return camera;
  const CameraAxes axes = camera_axes(camera);
  const std::array<ViewPlane, 6> planes = view_planes(camera, axes);
  const auto beside = [&](const Box& box) {
    return std::any_of(planes.begin(), planes.begin() + kViewSides,
                       [&](const ViewPlane& side) { return wholly_outside(box, camera.position, side); });
  };
  double nearest = camera.far_depth, farthest = camera.near_depth;
  for (const std::span<const Box> boxes : {casters, panes}) {
    for (const Box& box : boxes) {
      if (box.empty() || beside(box)) continue;
      const double middle = glm::dot(0.5 * (box.min + box.max) - camera.position, axes.forward);
      const double half = glm::dot(0.5 * (box.max - box.min), glm::abs(axes.forward));
      nearest = std::min(nearest, middle - half);
      farthest = std::max(farthest, middle + half);
    }
  }
  constexpr double kRoom = 0x1p-10;  // of the depths, for rounding
  const double room = kRoom * (std::abs(nearest) + std::abs(farthest));
  const double near_depth = std::max(camera.near_depth, nearest - room);
  const double far_depth = std::min(camera.far_depth, farthest + room);
  if (near_depth < far_depth) {
    camera.near_depth = near_depth;
    camera.far_depth = far_depth;
  }
  return camera;
}

}  // namespace

std::string_view to_string(Pass pass) noexcept {
  switch (pass) {
    case Pass::shadow_maps:
      return "shadow_maps";
    case Pass::prefilter:
      return "prefilter";
    case Pass::surfaces:
      return "surfaces";
    case Pass::mask:
      return "mask";
    case Pass::accumulate:
      return "accumulate";
    case Pass::shade:
      return "shade";
    case Pass::aliasing:
      return "aliasing";
    case Pass::heat_map:
      return "heat_map";
    case Pass::cascade_tint:
      return "cascade_tint";
    case Pass::panes:
      return "panes";
  }
  return "";
}

FrameSource& Sources::of(const FrameJob& frame) noexcept {
  const Source& wanted = frame.filter.source;
  if (frame.shadows.pages() != nullptr)
    return frame.plan.map_count > 0 && frame.programs.mask_pages ? pages : static_cast<FrameSource&>(maps);
  if (frame.shadows.light_plan() != nullptr)
    return lights && frame.programs.mask_lights ? *lights : static_cast<FrameSource&>(maps);
  if (wanted.kind == SourceKind::irregular && lists && lists->fits(frame.camera, wanted)) return *lists;
  return maps;
}

void Sources::lose(const FrameSource* but) noexcept {
  const std::array<FrameSource*, 4> all{&maps, &pages, lights ? &*lights : nullptr,
                                        lists ? &*lists : nullptr};
  for (FrameSource* const source : all)
    if (source != nullptr && source != but) source->lose();
}

Renderer::Impl::Impl(const Scene& scene)
    : bounds_world(scene.bounds_world),
      casters(scene),
      caster_pass(casters),
      screen(casters),
      sources{{casters, caster_pass, depths, screen}, {casters, caster_pass, depths, screen}, false, {}, {}},
      pictures(screen) {
  accumulate_pass.prepare();  // frames may ask for it without notice
}

Renderer::Renderer(const Scene& scene) {
  glDebugMessageCallback(report_gl_error, nullptr);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  impl_ = std::make_unique<Impl>(scene);
}

Renderer::~Renderer() = default;

std::size_t Renderer::Impl::program_of(const FilterSettings& settings) {
  const FilterVariant variant = variant_of(settings);
  const auto found = std::find_if(filters.begin(), filters.end(),
                                  [&](const FilterPrograms& known) { return known.variant == variant; });
  if (found != filters.end()) return static_cast<std::size_t>(found - filters.begin());
  filters.push_back(make_filter_programs(settings));
  return filters.size() - 1;
}

PreparedFilter Renderer::prepare(const FilterSettings& settings, const Source& source) {
  Impl& impl = *impl_;
  Sources& sources = impl.sources;
  const bool by_pages = source.kind == SourceKind::pages;
  PreparedFilter prepared{by_pages ? settings_for_pages(settings) : settings, 0, source};
  if (settings.contacts) impl.contact_pass.prepare();
  sources.maps.prepare(settings);
  prepared.program = impl.program_of(prepared.settings);
  FilterPrograms& programs = impl.filters[prepared.program];
  switch (source.kind) {
    case SourceKind::maps:
      break;
    case SourceKind::pages:
      make_pages_programs(prepared.settings, programs);
      sources.reads_pages = true;
      if (impl.panes) impl.panes->prepare_pages();
      break;
    case SourceKind::lights:
      if (!programs.mask_lights) programs.mask_lights = make_lights_program(settings);
      if (!programs.shade_clusters && LightLists::are_supported())
        programs.shade_clusters = make_clusters_program(settings);
      if (!sources.lights) sources.lights.emplace(impl.casters, impl.caster_pass, impl.depths, impl.screen);
      break;
    case SourceKind::irregular:
      prepared.source = Source::irregular(source.samples);
      if (!sources.lists) sources.lists.emplace(impl.casters, impl.caster_pass, impl.screen);
      if (impl.panes) impl.panes->prepare_listed();
      break;
    case SourceKind::identifiers:
      prepared.source = Source::identifiers(source.test);
      sources.maps.prepare_identifiers();
      break;
  }
  return prepared;
}

void Renderer::add_panes(const Scene& panes) {
  impl_->panes.reset();
  impl_->pane_posed = {};
  if (panes.instances.empty()) return;
  impl_->panes.emplace(panes);
  if (impl_->sources.lists) impl_->panes->prepare_listed();
  if (impl_->sources.reads_pages) impl_->panes->prepare_pages();
}

FrameStats Renderer::draw(const Shadows& shadows, const Camera& camera, const PreparedFilter& filter,
                          const FrameOptions& options) noexcept {
  Impl& impl = *impl_;
  // What the passes read of a plan of pages besides them: the light, and how the first one stores depth.
  ShadowPlan of_light;
  if (const PagePlan* const pages = shadows.pages()) {
    of_light.origin_world = pages->origin_world;
    of_light.light_direction = pages->light_direction;
    of_light.clip_space = pages->clip_space;
    of_light.bias = pages->bias;
    FilterPrograms& programs = impl.filters[filter.program];
    of_light.map_count = !pages->pages.empty() && programs.mask_pages ? 1 : 0;
    if (of_light.map_count > 0) of_light.map[0] = page_map(*pages, pages->pages[0]);
  }
  const Camera drawn = between_surfaces(camera, impl.casters.buffers.boxes(),
                                        impl.panes ? impl.panes->scene().boxes() : std::span<const Box>());
  FrameJob frame{shadows,
                 shadows.maps() != nullptr ? *shadows.maps() : of_light,
                 drawn,
                 filter,
                 options,
                 impl.filters[filter.program],
                 impl.panes ? &*impl.panes : nullptr,
                 camera.far_depth};
  impl.draw(frame, impl.sources.of(frame));
  return frame.stats;
}

bool Renderer::move_instance(std::size_t instance, const Instance& to) {
  if (instance >= impl_->casters.buffers.boxes().size() || to.bounds_world.empty()) return false;
  impl_->casters.posed = {};
  impl_->casters.move(instance, to);
  return true;
}

bool Renderer::apply_pose(const Pose& pose) {
  return render::apply_pose(pose, impl_->casters);
}

bool Renderer::move_pane(std::size_t instance, const Instance& to) {
  Impl& impl = *impl_;
  if (!impl.panes || instance >= impl.panes->scene().boxes().size() || to.bounds_world.empty()) return false;
  impl.pane_posed = {};
  impl.panes->move(instance, to);
  return true;
}

bool Renderer::apply_pane_pose(const Pose& pose) {
  Impl& impl = *impl_;
  if (!impl.panes) return pose.instances.empty() && pose.vertices.empty();
  return render::apply_pose(pose, impl.pane_posed, *impl.panes);
}

std::uint32_t Renderer::depth_array() const noexcept {
  return impl_->depths.depth.name();
}

const Framebuffer& Renderer::Impl::framebuffer_of(Picture picture) const noexcept {
  switch (picture) {
    case Picture::heat_map:
      return screen.targets.heat_fbo;
    case Picture::cascade_tint:
      return screen.targets.tint_fbo;
    case Picture::lit:
      break;
  }
  return screen.targets.color_fbo;
}

void Renderer::copy(Picture picture, std::uint32_t framebuffer) const noexcept {
  const FrameTargets& t = impl_->screen.targets;
  glBlitNamedFramebuffer(impl_->framebuffer_of(picture).name(), framebuffer, 0, 0, t.width, t.height, 0, 0,
                         t.width, t.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Renderer::show(Picture picture, int width, int height) const noexcept {
  const FrameTargets& t = impl_->screen.targets;
  glBlitNamedFramebuffer(impl_->framebuffer_of(picture).name(), 0, 0, 0, t.width, t.height, 0, 0, width,
                         height, GL_COLOR_BUFFER_BIT,
                         t.width == width && t.height == height ? GL_NEAREST : GL_LINEAR);
  impl_->screen_size = {width, height};
}

void Renderer::show_overlay(const Image& image) const {
  const Texture texture = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, GL_RGBA8, image.width, image.height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                      image.rgba.data());
  const Framebuffer fbo = make_framebuffer();
  glNamedFramebufferTexture(fbo.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  // Upside down: the picture's first row is its top.
  glBlitNamedFramebuffer(fbo.name(), 0, 0, 0, image.width, image.height, 0, image.height, image.width, 0,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace gnomon::render
