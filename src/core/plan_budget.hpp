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

/// The least sizes, in whole steps of kBudgetStep, that keep both bounds of m of every map laid at or below
/// `m`; a side that has a larger bound stays as it is. True where that leaves out enough texels to be worth
/// another plan.
[[nodiscard]] bool least_sizes(const ShadowPlan& laid, const PlanOptions& options, double m,
                               MapSizes& sizes) noexcept;

/// The largest bound of m over the plan's maps, were they of these sizes.
[[nodiscard]] double largest_error(const ShadowPlan& laid, const PlanOptions& options,
                                   const MapSizes& sizes) noexcept;

}  // namespace gnomon
