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

/// Sizes in whole steps of kSizeStep whose texels come to no more than the texel budget and that make the
/// largest error of all maps least. `fitted` are the maps at the size asked for, of `count`; `square` ones
/// have one bound for both axes.
[[nodiscard]] MapSizes budgeted_sizes(const ShadowPlan& fitted, const PlanOptions& options, int count,
                                      bool square) noexcept;

/// The largest bound of m that these maps would have at these sizes.
[[nodiscard]] double largest_error(const ShadowPlan& fitted, const PlanOptions& options,
                                   const MapSizes& sizes) noexcept;

}  // namespace gnomon
