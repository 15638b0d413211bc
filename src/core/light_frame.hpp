// The frame in which warps and fits work: x, y across the light, z towards it, origin at the camera.
#pragma once

#include <glm/vec3.hpp>

#include "gnomon/camera.hpp"

namespace gnomon {

/// Orthonormal, right-handed axes in world space; z points against the light's direction of travel.
struct LightFrame {
  glm::dvec3 x, y, z;
};

/// y along the projection of `along` across the light; any axis where they are parallel.
[[nodiscard]] LightFrame frame_along(const glm::dvec3& light_direction, const glm::dvec3& along) noexcept;

/// y along the view direction's projection across the light, away from the viewer. Where view and light are
/// parallel (sine below 1e-3, where rounding and mouse noise would spin the axis) y is the camera's up axis
/// instead.
[[nodiscard]] LightFrame view_aligned_frame(const glm::dvec3& light_direction,
                                            const CameraAxes& axes) noexcept;

/// Depends on the light alone, so that a snapped grid never turns with the camera.
[[nodiscard]] LightFrame fixed_frame(const glm::dvec3& light_direction) noexcept;

}  // namespace gnomon
