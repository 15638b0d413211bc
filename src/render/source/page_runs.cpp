// Which pages are drawn together, and where?
#include "source/page_runs.hpp"

#include <algorithm>
#include <tuple>

#include "frame/frame_block.hpp"
#include "frame/target.hpp"
#include "maps/texel_mask.hpp"

namespace gnomon::render {
namespace {

constexpr std::int64_t floor_div(std::int64_t a, std::int64_t b) noexcept {
  return a / b - (a % b < 0 ? 1 : 0);
}

auto key_of(const BlockPage& page) noexcept {
  return std::tuple(page.drawn.composed, page.block.level, page.block.row, page.block.column);
}

/// The block as one large page.
ShadowMap block_map(const PagePlan& plan_of_blocks, const PageBlock& block) noexcept {
  const ShadowMap& level = plan_of_blocks.levels[block.level];
  // page_map adds where the level begins.
  const auto cell = [&](std::int64_t at, std::int64_t first) {
    return static_cast<std::int32_t>(at - (level.snap_key.valid ? first / plan_of_blocks.page_texels : 0));
  };
  Page page;
  page.level = block.level;
  page.column = cell(block.column, level.snap_key.x);
  page.row = cell(block.row, level.snap_key.y);
  return page_map(plan_of_blocks, page);
}

/// Culls to a rectangle of the map, as it is drawn, in place of all of it; a local light's plane stays.
void cull_to(const TexelRect& rectangle, const glm::dmat4& drawn_from_plan, ShadowMap& map) noexcept {
  ShadowMap drawn = map;
  drawn.clip_from_world = drawn_from_plan * map.clip_from_world;
  const auto sides = rectangle_planes(drawn, rectangle, kOpenGlZeroToOne);
  std::copy(sides.begin(), sides.end(), map.cull_planes.begin());
}

}  // namespace

PageBlock block_of(const PagePlan& plan, const Page& page) noexcept {
  const ShadowMap& level = plan.levels[page.level];
  const auto place = [&](std::int64_t first, std::int32_t cell) {
    return (level.snap_key.valid ? first / plan.page_texels : 0) + cell;
  };
  const std::int64_t column = place(level.snap_key.x, page.column), row = place(level.snap_key.y, page.row);
  PageBlock block{page.level, floor_div(column, kBlockPages), floor_div(row, kBlockPages)};
  block.x = static_cast<int>(column - kBlockPages * block.column) * plan.page_texels;
  block.y = static_cast<int>(row - kBlockPages * block.row) * plan.page_texels;
  // The plan's x or y may be drawn the other way round.
  const int last = (kBlockPages - 1) * plan.page_texels;
  if (plan.clip_space.handedness == Handedness::left) block.x = last - block.x;
  if (plan.clip_space.y_down) block.y = last - block.y;
  return block;
}

void group_pages(const PagePlan& plan, const glm::dvec3& origin_world, std::vector<BlockPage>& pages,
                 std::vector<PageRun>& runs, std::vector<DrawnPage>& drawn) {
  std::stable_sort(pages.begin(), pages.end(),
                   [](const BlockPage& a, const BlockPage& b) { return key_of(a) < key_of(b); });
  PagePlan of_blocks = plan;
  of_blocks.page_texels *= kBlockPages;
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  for (std::size_t begin = 0, end = 0; begin < pages.size(); begin = end) {
    const auto at = [&](const BlockPage& page) {
      return TexelRect{page.block.x, page.block.y, plan.slot_texels(), plan.slot_texels()};
    };
    DrawnPage run;
    run.place = at(pages[begin]);
    for (; end < pages.size() && key_of(pages[end]) == key_of(pages[begin]); ++end)
      run.place = joined(run.place, at(pages[end]));
    run.composed = pages[begin].drawn.composed;
    run.map = block_map(of_blocks, pages[begin].block);
    cull_to(run.place, drawn_from_plan, run.map);
    glm::dmat4 m = run.map.clip_from_world;
    m[3] = m * glm::dvec4(origin_world, 1.0);
    run.clip_from_position = glm::mat4(drawn_from_plan * m);
    runs.push_back({begin, end});
    drawn.push_back(run);
  }
}

void PageStage::fit(int new_side, std::size_t blocks) {
  // More save waiting for what was drawn, and take memory: up to 16 MiB, or two layers.
  constexpr int kTexels = 1 << 22;
  const int most = std::max(2, kTexels / (new_side * new_side));
  const int wanted = static_cast<int>(std::min(blocks, static_cast<std::size_t>(most)));
  if (side == new_side && layers >= wanted) return;
  side = new_side;
  layers = wanted;
  depth = depth_layers(side, side, layers);
  fbo = depth_framebuffer();
}

void PageStage::attach(int layer) const noexcept {
  glNamedFramebufferTextureLayer(fbo.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0, layer);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo.name());
}

std::uint64_t PageStage::bytes() const noexcept {
  constexpr std::uint64_t kDepthBytes = 4;
  return kDepthBytes * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side) *
         static_cast<std::uint64_t>(layers);
}

}  // namespace gnomon::render
