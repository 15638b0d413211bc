// A frame of pages: neighbours are drawn together into the image of their block, from which each goes to its
// slot.
#include <algorithm>

#include "gnomon/render/page_filter.hpp"
#include "frame/renderer_impl.hpp"

namespace gnomon::render {
namespace {

constexpr float kFarthest = 1.0f;

void take_rectangle(const TexelRect& at) noexcept {
  glScissor(at.x, at.y, at.width, at.height);
}

/// From one layer into another.
void copy_depths(const Texture& from, const TexelRect& at, int layer, const Texture& into,
                 const TexelRect& to, int to_layer) noexcept {
  glCopyImageSubData(from.name(), GL_TEXTURE_2D_ARRAY, 0, at.x, at.y, layer, into.name(), GL_TEXTURE_2D_ARRAY,
                     0, to.x, to.y, to_layer, at.width, at.height, 1);
}

TexelRect in_block(const BlockPage& page) noexcept {
  return {page.block.x, page.block.y, page.drawn.place.width, page.drawn.place.height};
}

}  // namespace

void Renderer::Impl::draw_pages(const ShadowPlan& of_light, const DepthDraw& how, int block_side) noexcept {
  glBindVertexArray(scene.vertex_array());
  scene.use(SceneBuffers::Placed::for_maps);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  glEnable(GL_SCISSOR_TEST);
  if (!pages.in_runs()) {
    draw_each_page(of_light, how);
  } else {
    if (!pages.runs().empty()) page_stage.fit(block_side, pages.runs().size());
    const auto layers = static_cast<std::size_t>(page_stage.layers);
    for (std::size_t run = 0; run < pages.runs().size(); run += layers)
      draw_page_runs(run, std::min(run + layers, pages.runs().size()), how);
  }
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::Impl::draw_page_runs(std::size_t first, std::size_t last, const DepthDraw& how) noexcept {
  // All copies before or after all draws: each waits for what is being drawn into its images.
  const auto each_page = [&](auto&& act) {
    for (std::size_t i = first; i < last; ++i)
      for (const BlockPage& page : pages.pages_of(pages.runs()[i])) act(page, i, static_cast<int>(i - first));
  };
  const auto draw = [&](std::size_t run, const DrawnPart& part, bool clear) {
    page_stage.attach(static_cast<int>(run - first));
    glViewport(0, 0, page_stage.side, page_stage.side);
    take_rectangle(pages.drawn()[run].place);
    if (clear) {
      glDisable(GL_SCISSOR_TEST);
      glClearNamedFramebufferfv(page_stage.fbo.name(), GL_DEPTH, 0, &kFarthest);
      glEnable(GL_SCISSOR_TEST);
    }
    draw_casters(part, pages.drawn()[run].clip_from_position, how);
  };
  each_page([&](const BlockPage& page, std::size_t, int layer) {
    const DrawnPage& at = page.drawn;
    if (!at.composed) return;
    maps.add_beneath();
    // Without static depths of its own it shows static casters alone.
    if (!at.has_beneath) {
      maps.copy(MapTargets::Of::static_casters, at.layer, at.place);
      pages.add_beneath(at.slot);
    }
    copy_depths(maps.beneath, at.place, at.layer, page_stage.depth, in_block(page), layer);
  });
  for (std::size_t i = first; i < last; ++i)
    if (!pages.drawn()[i].composed) draw(i, lists.page_part(i), true);
  each_page([&](const BlockPage& page, std::size_t run, int layer) {
    if (page.drawn.composed || !lists.draws(lists.moving_part(run))) return;
    maps.add_beneath();
    copy_depths(page_stage.depth, in_block(page), layer, maps.beneath, page.drawn.place, page.drawn.layer);
    pages.add_beneath(page.drawn.slot);
  });
  for (std::size_t i = first; i < last; ++i)
    if (lists.draws(lists.moving_part(i))) draw(i, lists.moving_part(i), false);
  each_page([&](const BlockPage& page, std::size_t, int layer) {
    copy_depths(page_stage.depth, in_block(page), layer, maps.depth, page.drawn.place, page.drawn.layer);
  });
}

void Renderer::Impl::draw_each_page(const ShadowPlan& of_light, const DepthDraw& how) noexcept {
  for (std::size_t i = 0; i < pages.drawn().size(); ++i) {
    const DrawnPage& page = pages.drawn()[i];
    glNamedFramebufferTextureLayer(maps.fbo.name(), GL_DEPTH_ATTACHMENT, maps.depth.name(), 0, page.layer);
    glBindFramebuffer(GL_FRAMEBUFFER, maps.fbo.name());
    const TexelRect& at = page.place;
    // Clipping to the viewport alone lets triangles that pass by a local light spill a row into the next
    // page.
    take_rectangle(at);
    glViewport(at.x, at.y, at.width, at.height);
    glClearNamedFramebufferfv(maps.fbo.name(), GL_DEPTH, 0, &kFarthest);
    draw_casters(lists.page_part(i), page.clip_from_position, how);
    if (!info_of(how.layer).peels) continue;
    peel(lists.page_part(i), at, page.layer, page.clip_from_position, how, how.peeled(of_light, page.map));
  }
}

void Renderer::Impl::count_pages(const PagePlan& plan, FrameStats& stats) const noexcept {
  stats.pane_texels = panes ? panes->texels() : 0;
  stats.map_count = 1;
  stats.map[0] = work_of_map(0);
  const auto slot_texels =
      static_cast<std::uint64_t>(plan.slot_texels()) * static_cast<std::uint64_t>(plan.slot_texels());
  stats.texels = stats.map[0].texels = pages.pages().size() * slot_texels;
  stats.saved = lists.saved();
  stats.camera = lists.camera_stats();
  stats.prefilter_passes = stored_pages.passes();
  stats.filtered_texels = stored_pages.filtered_texels();
  stats.map_bytes = maps.bytes() + stored_pages.bytes() + (panes ? panes->bytes() : 0);
  stats.scratch_bytes = stored_pages.scratch_bytes() + depth_peel.bytes() + page_stage.bytes();
  stats.pages = static_cast<int>(plan.pages.size());
  stats.pages_drawn = static_cast<int>(pages.pages().size());
  stats.pages_composed = static_cast<int>(std::count_if(
      pages.pages().begin(), pages.pages().end(), [](const BlockPage& page) { return page.drawn.composed; }));
  PruneSaving& held = stats.saved[static_cast<std::size_t>(PruneRule::held_maps)];
  held.maps = static_cast<std::uint64_t>(stats.pages - stats.pages_drawn);
  held.texels = held.maps * slot_texels;
}

PreparedFilter Renderer::prepare_pages(const FilterSettings& settings) {
  const FilterSettings fitted = settings_for_pages(settings);
  const PreparedFilter prepared = prepare(fitted);
  make_pages_programs(fitted, impl_->filter_programs[prepared.program]);
  impl_->reads_pages = true;
  if (impl_->panes) impl_->panes->prepare_pages();
  return prepared;
}

FrameStats Renderer::draw(const PagePlan& plan, const Camera& camera, const PreparedFilter& filter,
                          const FrameOptions& options) noexcept {
  Impl& impl = *impl_;
  // What the passes read of a plan besides its maps: the light, and how the first page stores depth.
  ShadowPlan of_light;
  of_light.origin_world = plan.origin_world;
  of_light.light_direction = plan.light_direction;
  of_light.clip_space = plan.clip_space;
  of_light.bias = plan.bias;
  if (plan.pages.empty() || !impl.filter_programs[filter.program].mask_pages)
    return draw(of_light, camera, filter, options);
  of_light.map_count = 1;
  of_light.map[0] = page_map(plan, plan.pages[0]);
  if (impl.light_pass) impl.light_pass->holds = false;
  FrameStats stats;
  const PassTimer timed{stats, options.time_passes};
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  impl.targets.resize(camera.width, camera.height);
  const PagePool::Extent extent = impl.pages.fit(plan);
  if (impl.maps.fit(extent.side, extent.side, extent.layers)) impl.pages.forget();
  impl.lists.forget_maps();
  impl.history.forget();  // the mask is this frame's alone
  impl.map_count = 0;
  impl.drew_silhouettes = false;  // pages have no outlines
  impl.take_layer(options.depth_layer, options.dual_limit_texels);
  const BlurSides blur = blur_sides(filter.settings, of_light);
  const DepthCurves curves = depth_curves(of_light);
  FilterBlock filtering = filter_block(filter.settings, blur);
  set_depth_curves(curves, filtering);
  filtering.sums.w = options.receiver_plane ? 0.0f : 1.0f;
  const FrameBlock block = frame_block(of_light, camera, options, extent.side, extent.side, blur, curves);
  glm::dvec3 origin_world(0.0);
  timed(Pass::shadow_maps, [&] {
    impl.upload(block, filtering);
    origin_world = impl.place_scene({}, camera.position).origin_world;
    impl.take_moved(options.moved_world);
    const bool alpha_test = options.prune.has(PruneRule::alpha_test);
    const bool in_runs = options.map_passes != MapPasses::each && !info_of(options.depth_layer).peels;
    impl.pages.build(plan, {origin_world, alpha_test, options.prune.has(PruneRule::held_maps),
                            in_runs && impl.tells_apart(options), in_runs, impl.movers.static_changed_world(),
                            impl.movers.changed_world()});
    impl.lists.build_pages(impl.pages.drawn(), camera, options.prune,
                           in_runs ? impl.moves(options) : std::span<const std::uint8_t>{});
    impl.movers.finish_frame();
    impl.draw_pages(of_light, depth_draw(options), kBlockPages * plan.page_texels + 2 * plan.border_texels);
  });
  timed(Pass::surfaces,
        [&] { impl.draw_surfaces(impl.targets.surfaces_fbo.name(), impl.programs.surfaces); });
  const FilterPrograms& programs = impl.filter_programs[filter.program];
  timed(Pass::prefilter, [&] {
    impl.stored_pages.send_levels(plan, filter.settings);
    impl.stored_pages.build(programs, filter.settings, filtering, impl.filter_buffer.name(), impl.pages,
                            impl.maps.depth.name());
  });
  timed(Pass::mask, [&] {
    impl.pages.bind();
    impl.bind_noise(options.noise);
    impl.draw_mask(programs.mask_pages, impl.targets.mask_fbo.name(), true);
  });
  if (impl.panes) timed(Pass::panes, [&] { impl.draw_transmittance(plan, origin_world, camera); });
  timed(Pass::shade, [&] { impl.draw_shade(block, camera.position); });
  impl.count_pages(plan, stats);
  return stats;
}

}  // namespace gnomon::render
