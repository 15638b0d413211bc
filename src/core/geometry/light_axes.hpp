// Axes across the light: along the view where a warp wants them, fixed where a grid must not move.
#pragma once

#include "gnomon/camera.hpp"
#include "gnomon/extend/light_space.hpp"

namespace gnomon {

/// y along the projection of `along` across the light; any axis where they are parallel.
[[nodiscard]] LightFrame frame_along(const glm::dvec3& light_direction, const glm::dvec3& along) noexcept;

/// y along the view direction's projection across the light, away from the viewer. Where view and light are
/// parallel (sine below 1e-3, where rounding and mouse noise would spin the axis) y is the camera's up axis
/// instead.
[[nodiscard]] LightFrame view_aligned_frame(const glm::dvec3& light_direction,
                                            const CameraAxes& axes) noexcept;

/// Depends on the light alone.
[[nodiscard]] LightFrame fixed_frame(const glm::dvec3& light_direction) noexcept;

/// That of a parallel light's stable grids: fixed_frame turned about the light by 22.5 degrees.
/// Upright edges would lie along texel columns otherwise, and a whole edge would fall to one side of its
/// texels; across them a filter evens out where it falls.
[[nodiscard]] LightFrame grid_frame(const glm::dvec3& light_direction) noexcept;

/// Of a face of the cube whose faces look along +x -x +y -y +z -z of `cube`; z against the face's axis.
[[nodiscard]] LightFrame face_frame(const LightFrame& cube, int face) noexcept;

}  // namespace gnomon
