// From a warp's strength and a rectangle to the map's matrix.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "gnomon/warp.hpp"
#include "light_frame.hpp"

namespace gnomon {

/// Edges of the map in the light frame, before the rim that filters need.
struct LightRectangle {
  double left, right;   ///< of x / w
  double y_min, y_max;  ///< of y
};

/// The smallest rectangle that holds the body under w = 1 + kappa (y - y_min). Flat and single-point bodies
/// get an extent of 1e-6 of the largest one.
[[nodiscard]] LightRectangle rectangle_round(std::span<const WarpInput::Point> body, double kappa) noexcept;

/// Depths along the light in the light frame: from `bottom` upwards, with (z - bottom) / w between 0 and
/// `height`.
struct LightDepths {
  double bottom, height;
};

/// OpenGL clip space from the light frame. The rectangle fills the map but for `rim` of it on each side (0 <=
/// rim < 0.5); depth grows away from the light.
[[nodiscard]] glm::dmat4 clip_from_light(const LightRectangle& rectangle, double kappa,
                                         const LightDepths& depths, double rim_x, double rim_y) noexcept;

/// Light frame from points relative to the camera.
[[nodiscard]] glm::dmat4 light_from_relative(const LightFrame& frame) noexcept;

}  // namespace gnomon
