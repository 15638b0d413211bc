// Where do receivers that are seen need short texels? A shape that follows them (Shape::serving) is set by
// it.
#pragma once

#include "map/context.hpp"

namespace gnomon {

/// True where the options name such a shape, and maps of this plan can follow what is seen.
[[nodiscard]] bool follows_seen(const PlanContext& c) noexcept;

/// Sets the map's shape by the points seen in its depths, where that lowers the objective. `map` has its size
/// and margin; `gl_from_relative`: its matrix for linear texels, from points relative to the camera.
/// Returns how much longer the longest texels become along x and y.
[[nodiscard]] glm::dvec2 serve_seen(const PlanContext& c, const MapRequest& request,
                                    const glm::dmat4& gl_from_relative, MapResult& result) noexcept;

}  // namespace gnomon
