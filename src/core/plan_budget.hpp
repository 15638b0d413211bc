// How large each map is to be.
#pragma once

#include <array>
#include <cstdint>

#include "gnomon/plan.hpp"

namespace gnomon {

/// Texels along both sides of each map, by ShadowMap::cascade.
struct MapSizes {
  struct Size {
    int width, height;
  };
  std::array<Size, kMaxMaps> of;
};

[[nodiscard]] MapSizes equal_sizes(int size) noexcept;

/// Sizes in whole steps of kBudgetStep whose texels come to no more than options.texel_budget and that make
/// the largest bound of m, over maps and axes, least. `laid` are the maps as they are, of `count` asked for;
/// `square` ones have one bound for both axes.
[[nodiscard]] MapSizes budgeted_sizes(const ShadowPlan& laid, const PlanOptions& options, int count,
                                      bool square) noexcept;

/// PlanOptions::prune_m, or a target_m below it; 0 where PruneRule::metric_resolution is off or has no say.
[[nodiscard]] double bound_of_pruning(const PlanOptions& options, bool has_history) noexcept;

/// What a side of a map must hold.
struct SideNeed {
  double texels;          ///< inside the rim, under which the bound of m is 1
  double m;               ///< the bound asked for
  double most_rim = 0.5;  ///< share of the side that its rim may take, on each end
};
/// The least side, in whole steps of kBudgetStep and below `full`, under which the bound of m is at or below
/// the one asked for; `full` where there is none, or where so little less is not worth another size.
/// `margin(side)`: texels of the rim on each end, which must not fall as sides grow.
template <typename Margin>
[[nodiscard]] int least_side(const SideNeed& need, int full, const PlanOptions& options,
                             const Margin& margin) noexcept {
  const auto wanted = [&](int side) {
    const double rim = margin(side), inside = need.texels / need.m + 2.0 * rim;
    return inside > rim / need.most_rim ? inside : rim / need.most_rim;
  };
  const auto holds = [&](int side) {
    return need.texels / (side - 2.0 * margin(side)) <= need.m && margin(side) <= need.most_rim * side;
  };
  int side = least_budget_side(options);
  while (side < full && !holds(side)) {
    const double steps = wanted(side) / kBudgetStep;
    if (!(steps * kBudgetStep < full)) return full;
    const int next = kBudgetStep * static_cast<int>(steps);
    side = next > side ? next : side + kBudgetStep;
  }
  // Sizes come and go with the view, and images are made anew for them.
  constexpr double kWorthASize = 0.95;
  return side < kWorthASize * full ? side : full;
}

/// Lists the texels that a map smaller than options.map_size leaves out; `before`: its bound of m at that
/// size.
void omit_texels(const PlanOptions& options, double before, const ShadowMap& map, ShadowPlan& plan) noexcept;

/// The largest bound of m over the plan's maps, were they of these sizes.
[[nodiscard]] double largest_error(const ShadowPlan& laid, const PlanOptions& options,
                                   const MapSizes& sizes) noexcept;

}  // namespace gnomon
