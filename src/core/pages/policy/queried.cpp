// Does the next level change the picture? Pages are refined by an octave while enough of their points change.
// Based on: Giegl, Wimmer, "Queried Virtual Shadow Maps", 2007. Occlusion queries per tile become counts of
// changed points per page; the error is not read, and the target has no effect but through a pool that is too
// small.
#include <algorithm>

#include "pages/base.hpp"

namespace gnomon::page_policies {
namespace {

// Texels along the first map, as published.
constexpr double kFirstTexels = 2048.0;
// Share of a page's points that must change for it to be refined, and at least so many.
constexpr double kChangedShare = 0.01;
constexpr std::uint32_t kLeastChanged = 2;

/// Ladder step whose texels are as small as those of `map`, of the same scene but not of the same base.
int step_of(const PageContext& c, const PagePoint& point, const ShadowMap& map) noexcept {
  const PageBase& base = c.base_of(point.level);
  const double texel = max_of(map.texel_world.x, map.texel_world.y);
  const glm::dvec2 world = base.map.texel_world * glm::dvec2(base.map.width, base.map.height) / base.unit;
  const glm::dvec2 first = base.side * world / static_cast<double>(c.options.page_texels);
  // Rounded down: a ladder that moved a little must not refine by itself.
  constexpr double kRounding = 1.0 - 1e-6;
  return c.step_for(max_of(first.x, first.y) / texel * kRounding);
}

void assign(PageContext& c) noexcept {
  const PagePlan* last = c.history.last;
  const auto counters = last != nullptr && last->pages.size() * 2 <= c.memory.table.size()
                            ? c.memory.table.first(last->pages.size() * 2)
                            : std::span<std::uint32_t>{};
  std::fill(counters.begin(), counters.end(), 0u);
  const auto page_of = [&](std::size_t index) {
    return counters.empty() || c.view.points_world.empty() ? -1
                                                           : page_serving(*last, c.view.points_world[index]);
  };
  c.for_each_point([&](PagePoint& point, std::size_t index) {
    const int page = page_of(index);
    point.order = static_cast<std::uint32_t>(page + 1);
    if (page < 0) return;
    ++counters[2 * static_cast<std::size_t>(page)];
    if ((c.feedback(index) & kShadowChanged) != 0) ++counters[2 * static_cast<std::size_t>(page) + 1];
  });
  // A pool that is too small coarsens all pages by as much.
  const double coarser = c.target / c.options.target_m;
  c.for_each_point([&](PagePoint& point, std::size_t) {
    int step = c.step_for(kFirstTexels / c.options.page_texels);
    if (point.order > 0) {
      const std::size_t page = point.order - 1;
      const std::uint32_t points = counters[2 * page], changed = counters[2 * page + 1];
      const bool refine = changed >= kLeastChanged && changed > kChangedShare * points;
      step = step_of(c, point, last->levels[last->pages[page].level]) + (refine ? c.steps : 0);
    }
    const int down = coarser > 1.0 ? c.step_for(coarser) : 0;
    c.set_step(point, step - down);
  });
}

}  // namespace

const PagePolicy queried{.name = "queried",
                         .summary = "an octave finer wherever the last refinement changed the picture",
                         .octaves = false,
                         .shares_finer = true,
                         .feedback = kShadowChanged,
                         .assign = assign};

}  // namespace gnomon::page_policies
