// How large is each map to be?
#pragma once

#include <array>
#include <cstdint>

#include "gnomon/plan.hpp"
#include "map/context.hpp"

namespace gnomon {

/// Texels along both sides of each map, by ShadowMap::cascade.
struct MapSizes {
  struct Size {
    int width, height;
  };
  std::array<Size, kMaxMaps> of;
};

[[nodiscard]] MapSizes equal_sizes(int size) noexcept;

/// What the maps of a trial need, whatever their size. `square` ones have one need for both axes.
class TexelDemands {
 public:
  TexelDemands(const PlanContext& c, const ShadowPlan& fitted, bool square) noexcept;

  /// Sizes in whole steps of kSizeStep whose texels come to no more than the texel budget, of `count` maps.
  /// They make the largest error of all maps least or, by Objective::picture, the mean over the seen points.
  [[nodiscard]] MapSizes within_budget(int count) const noexcept;
  /// The error that these maps would have at these sizes: the largest bound of m, or the mean over the
  /// points.
  [[nodiscard]] double error(const MapSizes& sizes) const noexcept;
  /// The largest bound of m.
  [[nodiscard]] double largest_error(const MapSizes& sizes) const noexcept;

 private:
  struct Demand {
    std::size_t cascade;
    // Texels inside the border that bring the bound of m, or its mean at the seen points, to 1.
    double s, t;
    double points;  // that it serves, and one for what they miss
    // Of both sides together. A kernel in texels takes the same number of any side, one in world units the
    // same share.
    double border_texels, border_share;
    double bound_s, bound_t, any_direction;  // of the bounds: the last over the larger of both
  };
  /// By the picture: what a map's sides take more than their needs. Else 1.
  [[nodiscard]] double share_of(const Demand& demand) const noexcept;
  [[nodiscard]] MapSizes sizes_at(double scale) const noexcept;
  void count_points(const PlanContext& c, const ShadowPlan& fitted) noexcept;
  [[nodiscard]] static int side(double texels, const Demand& demand, int least) noexcept;
  [[nodiscard]] static double error_along(double texels, const Demand& demand, int size) noexcept;

  const PlanOptions& options_;
  bool square_, by_points_ = false;
  std::array<Demand, kMaxMaps> demand_;
  std::size_t count_ = 0;
};

}  // namespace gnomon
