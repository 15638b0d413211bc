// Which maps do the planes of WarpOptions::planes get, and what of the cascades is left?
#pragma once

#include "gnomon/extend/body.hpp"
#include "plan/cascades.hpp"

namespace gnomon {

/// One map for each plane that has visible receivers and casters.
struct PlaneMaps {
  /// Planes round the points that a map serves, relative to the camera.
  struct Sides {
    std::array<Plane, kMaxSelectPlanes> plane;
    int count = 0;
    [[nodiscard]] bool hold(const Polytope& body) const noexcept;
  };
  std::array<ShadowMap, kMaxWarpPlanes> map;
  std::array<Sides, kMaxWarpPlanes> sides;
  int count = 0;
  std::array<Omission, kMaxWarpPlanes> omission;  // planes without a map
  int omission_count = 0;
  std::array<Omission, 4 * kMaxWarpPlanes> of_maps;  // what was left out of the maps
  int of_maps_count = 0;

  /// True where one of the maps serves the whole body.
  [[nodiscard]] bool serve(const Polytope& body) const noexcept;
};

/// The maps, in the order of their planes.
[[nodiscard]] PlaneMaps plane_maps(const PlanContext& c, const ParallelScene& scene) noexcept;

/// Puts the maps before those of the plan, which then serve only what is left, each at its own depths.
void add_plane_maps(const PlanContext& c, const PlaneMaps& planes, ShadowPlan& plan) noexcept;

}  // namespace gnomon
