// One frame: culling, shadow maps, surfaces, mask, picture, and the error per pixel.
#include "gnomon/render/renderer.hpp"

#include <algorithm>
#include <cstdio>

#include "context/backend.hpp"
#include "gnomon/render/probe.hpp"
#include "gl/pass_timer.hpp"
#include "gl/program.hpp"
#include "frame/renderer_impl.hpp"

namespace gnomon::render {
namespace {

constexpr GLuint kFrameBinding = 0;

void GLAD_API_PTR report_gl_error(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                                  const void*) {
  if (type == GL_DEBUG_TYPE_ERROR) std::fprintf(stderr, "OpenGL: %s\n", message);
}

/// Averages over a pixel's footprint, pyramids of depths, and options found from all of a map's depths know
/// no margin.
bool reads_everywhere(const FilterSettings& settings, const ShadowPlan& plan) noexcept {
  const Filter& filter = *settings.filter;
  return wants_mipmaps(settings, plan) ||
         (filter.hooks.needs_depth_max != nullptr && filter.hooks.needs_depth_max(settings)) ||
         (filter.hooks.adapts != nullptr && filter.hooks.adapts(settings));
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

Renderer::Impl::Impl(const Scene& from_scene)
    : scene(from_scene),
      lists(scene),
      movers(scene),
      frame_buffer(make_buffer()),
      filter_buffer(make_buffer()),
      no_vertices(make_vertex_array()) {
  glNamedBufferStorage(frame_buffer.name(), sizeof(FrameBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferStorage(filter_buffer.name(), sizeof(FilterBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
  accumulate.prepare(false);  // frames may ask for it without notice
  targets.resize(1, 1);
  can_layer = !layer_extension().empty();
  const auto* driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  software = driver != nullptr && is_software(driver);
}

Renderer::Renderer(const Scene& scene) {
  glDebugMessageCallback(report_gl_error, nullptr);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  impl_ = std::make_unique<Impl>(scene);
}

Renderer::~Renderer() = default;

void Renderer::Impl::fit_maps(const ShadowPlan& plan) {
  int width = 1, height = 1;
  bool alike = !plan.sizes_vary;
  map_count = plan.map_count;
  if (map_count == 0) return;  // what the maps hold stays for the next frame
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    map_size[i] = glm::ivec2(plan.map[i].width, plan.map[i].height);
    alike = alike && map_size[i] == map_size[0] && map_size[i].x == map_size[i].y;
    width = std::max(width, plan.map[i].width);
    height = std::max(height, plan.map[i].height);
  }
  // Sizes that follow the view differ by little from frame to frame: new images for all of that would cost
  // more than the texels.
  constexpr int kLayerStep = 256;
  const auto layer = [alike](int side) {
    return alike ? side : (side + kLayerStep - 1) / kLayerStep * kLayerStep;
  };
  if (maps.fit(layer(width), layer(height), plan.map_count)) lists.forget_maps();
}

PreparedFilter Renderer::prepare(const FilterSettings& settings) {
  auto& known = impl_->filter_programs;
  const FilterVariant variant = variant_of(settings);
  if (settings.contacts) impl_->contacts.prepare(false);
  if (settings.filter->info.draws_silhouettes && !impl_->silhouettes)
    impl_->silhouettes.emplace(impl_->scene);
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const FilterPrograms& p) { return p.variant == variant; });
  if (found != known.end()) return {settings, static_cast<std::size_t>(found - known.begin())};
  known.push_back(make_filter_programs(settings));
  return {settings, known.size() - 1};
}

void Renderer::Impl::upload(const FrameBlock& frame, const FilterBlock& filtering) noexcept {
  glNamedBufferSubData(frame_buffer.name(), 0, sizeof frame, &frame);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, frame_buffer.name());
  glNamedBufferSubData(filter_buffer.name(), 0, sizeof filtering, &filtering);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFilterBinding, filter_buffer.name());
}

DrawnMaps Renderer::Impl::place_scene(const ShadowPlan& plan, const glm::dvec3& camera_world) {
  const DrawnMaps drawn = drawn_maps(plan, camera_world, scene.origin_step());
  const auto planned = plan.maps();
  const bool bends =
      std::any_of(planned.begin(), planned.end(), [](const ShadowMap& map) { return !map.shape->affine; });
  if (bends && !bent) {
    try {
      bent.emplace();
    } catch (const RenderError&) {
      // A lost context compiles nothing; who drew the frame finds out from the context.
    }
  }
  scene.place(SceneBuffers::Placed::for_camera, camera_world);
  scene.place(SceneBuffers::Placed::for_maps, drawn.origin_world);
  return drawn;
}

void Renderer::Impl::draw_pictures(const PassTimer& timed, const FrameOptions& options,
                                   const std::function<void()>& shade) noexcept {
  timed(Pass::shade, shade);
  if (options.aliasing) timed(Pass::aliasing, [&] { draw_aliasing(); });
  if (options.aliasing && options.heat_map) timed(Pass::heat_map, [&] { draw_heat_map(); });
  if (options.cascade_tint) timed(Pass::cascade_tint, [&] { draw_cascade_tint(); });
}

LayeredRule Renderer::Impl::layered_rule(const FrameOptions& options) noexcept {
  const bool wanted =
      options.map_passes == MapPasses::layered || (options.map_passes == MapPasses::automatic && !software);
  if (!wanted || !can_layer || info_of(options.depth_layer).peels) return {};
  if (!layered) {
    try {
      layered.emplace();
    } catch (const RenderError&) {
      // The driver names the extension and its compiler refuses it, or the context is lost.
      can_layer = false;
      return {};
    }
  }
  return {options.map_passes, options.depth_layer == DepthLayer::back, software};
}

MapStats Renderer::Impl::work_of_map(int map) const noexcept {
  MapStats work = lists.map_stats(map);
  if (!info_of(drawn_layer).peels) return work;
  work.draws *= 2;
  work.triangles *= 2;
  return work;
}

void Renderer::Impl::count_work(const ShadowPlan& plan, FrameStats& stats) const noexcept {
  stats.map_count = plan.map_count;
  for (int i = 0; i < plan.map_count; ++i) {
    stats.map[static_cast<std::size_t>(i)] = work_of_map(i);
    stats.texels += lists.map_stats(i).texels;
  }
  stats.saved = lists.saved();
  stats.camera = lists.camera_stats();
  stats.layered_maps = static_cast<int>(lists.layered_maps().size());
  stats.layered_draws = lists.layered_draws();
}

void Renderer::Impl::take_layer(DepthLayer layer, double dual_limit_texels, bool linear) noexcept {
  const bool same = layer == drawn_layer && linear == drawn_linear &&
                    (drawn_layer != DepthLayer::dual || dual_limit_texels == drawn_limit_texels);
  drawn_layer = layer;
  drawn_limit_texels = dual_limit_texels;
  drawn_linear = linear;
  if (same) return;
  lists.forget_maps();
  pages.forget();
}

void Renderer::Impl::take_silhouettes(const FilterSettings& settings) {
  const bool wanted = settings.filter->info.draws_silhouettes && silhouettes;
  const bool lost = wanted && silhouettes->fit(maps);
  if (lost || (wanted && !drew_silhouettes)) lists.forget_maps();
  drew_silhouettes = wanted;
}

void Renderer::Impl::take_shapes(const ShadowPlan& plan, const PreparedFilter& filter,
                                 bool accumulated) noexcept {
  const auto planned = plan.maps();
  shaped = std::any_of(planned.begin(), planned.end(),
                       [](const ShadowMap& map) { return map.shape != &shapes::linear; });
  if (!shaped) return;
  try {
    make_shaped_programs(filter.settings, filter_programs[filter.program]);
    if (filter.settings.contacts) contacts.prepare(true);
    if (accumulated) accumulate.prepare(true);
  } catch (const RenderError&) {
    // A lost context compiles nothing; who drew the frame finds out from the context.
  }
}

void Renderer::Impl::take_moved(std::span<const Box> moved_world) {
  if (!movers.changed_world().empty()) lists.rebuild_casters();
  movers.add(moved_world);
}

bool Renderer::Impl::tells_apart(const FrameOptions& options) const noexcept {
  return options.prune.has(PruneRule::static_casters) && options.prune.has(PruneRule::held_maps) &&
         !info_of(options.depth_layer).peels && !drew_silhouettes;
}

std::span<const std::uint8_t> Renderer::Impl::moves(const FrameOptions& options) const noexcept {
  return tells_apart(options) && movers.any() ? movers.moves() : std::span<const std::uint8_t>{};
}

void Renderer::Impl::forget_moved() noexcept {
  lists.forget_maps();
  pages.forget();
  movers.forget_changes();
}

void Renderer::add_panes(const Scene& panes) {
  impl_->panes.reset();
  impl_->pane_posed = {};
  if (panes.instances.empty()) return;
  impl_->panes.emplace(panes);
  if (impl_->pixel_lists) impl_->panes->prepare_listed();
  if (impl_->reads_pages) impl_->panes->prepare_pages();
}

FrameStats Renderer::draw(const ShadowPlan& plan, const Camera& camera, const PreparedFilter& filter,
                          const FrameOptions& options) noexcept {
  Impl& impl = *impl_;
  if (impl.light_pass) impl.light_pass->holds = false;
  impl.take_moved(options.moved_world);
  // A frame without maps brings none up to date: what moved is for the next one, as long as it is worth it.
  constexpr std::size_t kMostMoved = 4096;
  if (plan.map_count > 0) impl.pages.forget();
  if (filter.irregular || impl.movers.changed_world().size() > kMostMoved) impl.forget_moved();
  const bool identified = impl.takes_identifiers(plan, filter);
  impl.take_layer(identified ? DepthLayer::front : options.depth_layer, options.dual_limit_texels,
                  options.linear_depth && !identified);
  impl.take_identifiers(identified ? std::optional(filter.identifiers->of) : std::nullopt);
  if (identified) {
    impl.drew_silhouettes = false;
    return impl.draw_identified(plan, camera, filter, options);
  }
  if (filter.irregular && impl.pixel_lists &&
      impl.pixel_lists->fits(camera.width, camera.height, filter.samples))
    return impl.draw_irregular(plan, camera, filter, options);
  FrameStats stats;
  const PassTimer timed{stats, options.time_passes};
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  impl.targets.resize(camera.width, camera.height);
  impl.fit_maps(plan);
  impl.take_silhouettes(filter.settings);
  impl.take_shapes(plan, filter, options.accumulation.on);
  const BlurSides blur = blur_sides(filter.settings, plan);
  FilterBlock filtering = filter_block(filter.settings, blur);
  const DepthCurves curves = depth_curves(plan, options.linear_depth);
  set_depth_curves(curves, filtering);
  filtering.sums.w = options.receiver_plane ? 0.0f : 1.0f;
  const FrameBlock block =
      frame_block(plan, camera, options, impl.maps.width, impl.maps.height, blur, curves);
  fit_options(filter.settings, plan, filtering);
  DrawnMaps drawn;
  timed(Pass::shadow_maps, [&] {
    impl.upload(block, filtering);
    drawn = impl.place_scene(plan, camera.position);
    for (std::size_t i = 0; i < plan.maps().size(); ++i)
      drawn.map[i].even_scale = static_cast<float>(std::max(-curves[i], 0.0));
    impl.lists.build(
        {plan, options.prune, options.lost_shadow_share, reads_everywhere(filter.settings, plan),
         info_of(options.depth_layer).peels || impl.drew_silhouettes, impl.movers.changed_world(),
         impl.movers.static_changed_world(), impl.moves(options), &impl.movers},
        drawn, camera, impl.layered_rule(options));
    if (options.accumulation.on) impl.history.forget_behind(impl.movers.changed_world());
    if (plan.map_count > 0) impl.movers.finish_frame();
    impl.draw_shadow_maps(plan, drawn, depth_draw(options));
    if (impl.drew_silhouettes)
      impl.silhouettes->draw(impl.scene, impl.lists, impl.maps, drawn, impl.map_count);
  });
  timed(Pass::surfaces,
        [&] { impl.draw_surfaces(impl.targets.surfaces_fbo.name(), impl.programs.surfaces); });
  timed(Pass::prefilter,
        [&] { impl.prefilter(plan, filter, filtering, options.prune.has(PruneRule::unread_tiles)); });
  const bool accumulated = options.accumulation.on;
  accumulated ? impl.history.resize(camera.width, camera.height) : impl.history.forget();
  timed(Pass::mask, [&] {
    impl.bind_noise(options.noise);
    const GLuint fbo = accumulated ? impl.history.single_fbo() : impl.targets.mask_fbo.name();
    impl.draw_mask(impl.filter_programs[filter.program].mask_for(impl.shaped), fbo);
    if (filter.settings.contacts && plan.map_count > 0) impl.draw_contacts(plan, filter.settings, fbo);
  });
  if (accumulated) timed(Pass::accumulate, [&] { impl.draw_accumulated(camera, options, block); });
  if (impl.panes) {
    timed(Pass::panes, [&] { impl.draw_transmittance(plan, drawn, camera, options, stats); });
  }
  impl.draw_pictures(timed, options, [&] { impl.draw_shade(block, camera.position); });
  impl.count_work(plan, stats);
  if (options.time_passes) {
    stats.filtered_texels = impl.stored.take_filtered_texels();
    const std::uint64_t whole = impl.stored.whole_texels();
    stats.saved[static_cast<std::size_t>(PruneRule::unread_tiles)].filtered =
        whole - std::min(stats.filtered_texels, whole);
  }
  stats.prefilter_passes = impl.stored.passes();
  stats.maps_read_back = impl.maps_read_back;
  stats.map_bytes = impl.maps.bytes() + impl.stored.bytes() + (impl.panes ? impl.panes->bytes() : 0);
  stats.scratch_bytes = impl.stored.scratch_bytes() + impl.depth_peel.bytes();
  if (impl.drew_silhouettes) {
    stats.map_bytes += impl.silhouettes->bytes();
    stats.scratch_bytes += impl.silhouettes->scratch_bytes();
  }
  return stats;
}

std::uint32_t Renderer::depth_array() const noexcept {
  return impl_->maps.depth.name();
}

const Framebuffer& Renderer::Impl::framebuffer_of(Picture picture) const noexcept {
  switch (picture) {
    case Picture::heat_map:
      return targets.heat_fbo;
    case Picture::cascade_tint:
      return targets.tint_fbo;
    case Picture::lit:
      break;
  }
  return targets.color_fbo;
}

void Renderer::copy(Picture picture, std::uint32_t framebuffer) const noexcept {
  const FrameTargets& t = impl_->targets;
  glBlitNamedFramebuffer(impl_->framebuffer_of(picture).name(), framebuffer, 0, 0, t.width, t.height, 0, 0,
                         t.width, t.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Renderer::show(Picture picture, int width, int height) const noexcept {
  const FrameTargets& t = impl_->targets;
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
