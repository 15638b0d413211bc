// How deep a map is along the light: the receivers and every caster that can shadow them.
#pragma once

#include <optional>

#include "cull/sweep.hpp"
#include "map/light_body.hpp"

namespace gnomon {

/// What a map keeps free round its body for kernels.
struct MapBorder {
  double share;        ///< of the rectangle's side, on each side
  double log_w = 0.0;  ///< rows that undo the warp: logarithm of w's growth over the border, which replaces
                       ///< the share along the warp
};

/// A fitted plane with its casters, not yet its depths.
struct FittedPlane {
  const LightBody& body;
  const PlaneMap& plane;
  const SweptBody& swept;
  MapBorder border;                          ///< of the map
  std::optional<double> measured_from = {};  ///< height that HeightRange::height counts from; its own bottom
};

/// Heights that a map covers, in light space.
struct HeightRange {
  double bottom = 0.0, height = 0.0;
  bool has_casters = false;     ///< any that reaches the body
  int too_near = 0;             ///< casters nearer to a local light than its maps show
  double nearest = 0.0;         ///< local light: distance from which on the map shows casters
  double nearest_caster = 0.0;  ///< local light: least distance of a caster that counts
};

/// Distances at least PlanOptions::light_near_share of the farthest, unless boxes are known to be nearer.
[[nodiscard]] HeightRange height_range(const PlanContext& c, const MapRequest& request,
                                       const FittedPlane& fitted) noexcept;

/// With room to spare for rounding in shaders. `extent`: of the map across the light.
[[nodiscard]] LightDepths padded(double bottom, double height, double extent) noexcept;

/// Planes round everything that can shadow the body or fall into the kernels round it.
void sweep_for(const PlanContext& c, const MapRequest& request, const LightBody& body, const PlaneMap& plane,
               const MapBorder& border, SweptBody& swept) noexcept;

}  // namespace gnomon
