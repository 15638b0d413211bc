// What visible points say about where receivers need a map.
#pragma once

#include "map/context.hpp"

namespace gnomon {

/// Cuts `body`, relative to the camera, across the light to the bounds of the visible points between two view
/// depths, with room on every side (kPointSafety). Leaves it as it is where there are none, or none in it.
void clip_to_points(const PlanContext& c, const LightFrame& frame, double begin, double end,
                    Polytope& body) noexcept;

}  // namespace gnomon
