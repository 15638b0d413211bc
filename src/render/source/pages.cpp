// Pages of depths: neighbours are drawn together into the image of their block, and copied into their slots.
#include "source/pages.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/study/bias.hpp"

#include <algorithm>

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

const SourceSupport PageSource::kSupport{
    "pages", "pages of a `PagePlan`, which a pool keeps",
    FrameOptionSet::all().without(
        {FrameOption::transition, FrameOption::accumulation, FrameOption::linear_depth, FrameOption::aliasing,
         FrameOption::heat_map, FrameOption::cascade_tint, FrameOption::light_clusters,
         FrameOption::small_casters, FrameOption::scrolled_maps, FrameOption::unread_tiles,
         FrameOption::contacts, FrameOption::bent_maps})};

PageSource::PageSource(CasterScene& casters, CasterPass& pass, MapTargets& maps, Screen& screen)
    : casters_(casters), pass_(pass), maps_(maps), screen_(screen) {}

FrameOptionSet PageSource::supports(const FrameJob&) const noexcept {
  return kSupport.supports;
}

SourceSteps PageSource::steps(const FrameJob&) const noexcept {
  return {.stores_texels = true};
}

void PageSource::begin(FrameJob& frame) {
  const FrameOptions& options = frame.options;
  const PagePool::Extent extent = pool_.fit(*frame.shadows.pages());
  const DepthKind kind = depth_kind(options, false);
  if (maps_.fit(extent.side, extent.side, extent.layers) || kind != kind_) pool_.forget();
  kind_ = kind;
  const FilterSettings& settings = frame.filter.settings;
  const BlurSides blur = blur_sides(settings, frame.plan);
  const DepthCurves curves = depth_curves(frame.plan);
  frame.filtering = filter_block(settings, blur);
  set_depth_curves(curves, frame.filtering);
  frame.filtering.sums.w = options.receiver_plane ? 0.0f : 1.0f;
  frame.block = frame_block(frame.plan, frame.camera, options, extent.side, extent.side, blur, curves);
}

void PageSource::update(FrameJob& frame) {
  const PagePlan& plan = *frame.shadows.pages();
  const FrameOptions& options = frame.options;
  MovingCasters& movers = casters_.movers;
  origin_world_ = casters_.place({}, frame.camera.position).origin_world;
  const bool in_runs = options.map_passes != MapPasses::each && !info_of(options.depth_layer).peels;
  const bool apart = in_runs && composes(options);
  pool_.build(
      plan, {origin_world_, options.prune.has(PruneRule::alpha_test), options.prune.has(PruneRule::held_maps),
             apart, in_runs, movers.static_changed_world(), movers.changed_world()});
  casters_.lists.build_pages(pool_.drawn(), frame.camera, options.prune,
                             apart && movers.any() ? movers.moves() : std::span<const std::uint8_t>{});
  movers.finish_frame();
  pass_.begin();
  glEnable(GL_SCISSOR_TEST);
  const DepthDraw how = depth_draw(options);
  if (!pool_.in_runs()) {
    draw_each(frame.plan, how);
  } else {
    if (!pool_.runs().empty())
      stage_.fit(kBlockPages * plan.page_texels + 2 * plan.border_texels, pool_.runs().size());
    const auto layers = static_cast<std::size_t>(stage_.layers);
    for (std::size_t run = 0; run < pool_.runs().size(); run += layers)
      draw_runs(run, std::min(run + layers, pool_.runs().size()), how);
  }
  glDisable(GL_SCISSOR_TEST);
}

void PageSource::draw_runs(std::size_t first, std::size_t last, const DepthDraw& how) noexcept {
  const DrawLists& lists = casters_.lists;
  // All copies before or after all draws: each waits for what is being drawn into its images.
  const auto each_page = [&](auto&& act) {
    for (std::size_t i = first; i < last; ++i)
      for (const BlockPage& page : pool_.pages_of(pool_.runs()[i])) act(page, i, static_cast<int>(i - first));
  };
  const auto draw = [&](std::size_t run, const DrawnPart& part, bool clear) {
    stage_.attach(static_cast<int>(run - first));
    glViewport(0, 0, stage_.side, stage_.side);
    take_rectangle(pool_.drawn()[run].place);
    if (clear) {
      glDisable(GL_SCISSOR_TEST);
      glClearNamedFramebufferfv(stage_.fbo.name(), GL_DEPTH, 0, &kFarthest);
      glEnable(GL_SCISSOR_TEST);
    }
    pass_.draw(part, pool_.drawn()[run].clip_from_position, how);
  };
  each_page([&](const BlockPage& page, std::size_t, int layer) {
    const DrawnPage& at = page.drawn;
    if (!at.composed) return;
    maps_.add_beneath();
    // Without static depths of its own it shows static casters alone.
    if (!at.has_beneath) {
      maps_.copy(MapTargets::Of::static_casters, at.layer, at.place);
      pool_.add_beneath(at.slot);
    }
    copy_depths(maps_.beneath, at.place, at.layer, stage_.depth, in_block(page), layer);
  });
  for (std::size_t i = first; i < last; ++i)
    if (!pool_.drawn()[i].composed) draw(i, lists.page_part(i), true);
  each_page([&](const BlockPage& page, std::size_t run, int layer) {
    if (page.drawn.composed || !lists.draws(lists.moving_part(run))) return;
    maps_.add_beneath();
    copy_depths(stage_.depth, in_block(page), layer, maps_.beneath, page.drawn.place, page.drawn.layer);
    pool_.add_beneath(page.drawn.slot);
  });
  for (std::size_t i = first; i < last; ++i)
    if (lists.draws(lists.moving_part(i))) draw(i, lists.moving_part(i), false);
  each_page([&](const BlockPage& page, std::size_t, int layer) {
    copy_depths(stage_.depth, in_block(page), layer, maps_.depth, page.drawn.place, page.drawn.layer);
  });
}

void PageSource::draw_each(const ShadowPlan& of_light, const DepthDraw& how) noexcept {
  for (std::size_t i = 0; i < pool_.drawn().size(); ++i) {
    const DrawnPage& page = pool_.drawn()[i];
    const DrawnPart& part = casters_.lists.page_part(i);
    maps_.attach(MapTargets::Of::all, page.layer);
    const TexelRect& at = page.place;
    // Clipping to the viewport alone lets triangles that pass by a local light spill a row into the next
    // page.
    take_rectangle(at);
    glViewport(at.x, at.y, at.width, at.height);
    glClearNamedFramebufferfv(maps_.fbo.name(), GL_DEPTH, 0, &kFarthest);
    pass_.draw(part, page.clip_from_position, how);
    if (!info_of(how.layer).peels) continue;
    pass_.peel(maps_, page.layer, at, part, page.clip_from_position, how, how.peeled(of_light, page.map));
  }
}

SurfacePass PageSource::surfaces() const noexcept {
  return screen_.surfaces();
}

void PageSource::store(FrameJob& frame) {
  stored_.send_levels(*frame.shadows.pages(), frame.filter.settings);
  stored_.build(frame.programs, frame.filter.settings, frame.filtering, screen_.filter_buffer(), pool_,
                maps_.depth.name());
}

void PageSource::mask(FrameJob& frame, GLuint fbo) {
  pool_.bind();
  maps_.bind();
  stored_.bind();
  draw_mask(screen_, frame.programs.mask_pages, fbo);
}

void PageSource::tint(FrameJob& frame) {
  PanePass& panes = *frame.panes;
  panes.resize(frame.camera.width, frame.camera.height);
  panes.draw_pages(*frame.shadows.pages(), pool_, origin_world_);
  pool_.bind();
  panes.bind_pages(frame.camera.position);
  screen_.bind_mask();
  screen_.fullscreen(panes.fbo(), panes.pages_program());
  frame.stats.pane_texels = panes.texels();
}

void PageSource::count(FrameJob& frame) {
  const PagePlan& plan = *frame.shadows.pages();
  const std::span<const BlockPage> drawn = pool_.pages();
  FrameStats& stats = frame.stats;
  stats.map_count = 1;
  stats.map[0] = work_of_map(casters_.lists, 0, kind_.layer);
  const auto slot_texels =
      static_cast<std::uint64_t>(plan.slot_texels()) * static_cast<std::uint64_t>(plan.slot_texels());
  stats.texels = stats.map[0].texels = drawn.size() * slot_texels;
  count_lists(casters_.lists, stats);
  stats.prefilter_passes = stored_.passes();
  stats.filtered_texels = stored_.filtered_texels();
  stats.map_bytes = maps_.bytes() + stored_.bytes() + (frame.panes != nullptr ? frame.panes->bytes() : 0);
  stats.scratch_bytes = stored_.scratch_bytes() + pass_.scratch_bytes() + stage_.bytes();
  stats.pages = static_cast<int>(plan.pages.size());
  stats.pages_drawn = static_cast<int>(drawn.size());
  stats.pages_composed = static_cast<int>(
      std::count_if(drawn.begin(), drawn.end(), [](const BlockPage& page) { return page.drawn.composed; }));
  PruneSaving& held = stats.saved[static_cast<std::size_t>(PruneRule::held_maps)];
  held.maps = static_cast<std::uint64_t>(stats.pages - stats.pages_drawn);
  held.texels = held.maps * slot_texels;
}

void PageSource::lose() noexcept {
  pool_.forget();
}

}  // namespace gnomon::render
