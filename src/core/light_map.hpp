// From a warp's strength and a rectangle to the map's matrix.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "gnomon/warp.hpp"
#include "light_frame.hpp"

namespace gnomon {

/// A warp's map of the light plane with the rectangle round the body's image, before the rim that filters
/// need.
struct PlaneMap {
  WarpChoice choice;
  double u_min, length;               ///< of the body along the axis
  double stretch;                     ///< 1 + kappa length: the image is as long as the body
  double a_min, a_max, b_min, b_max;  ///< rectangle in the turned image
  /// Of a point of the light plane.
  [[nodiscard]] double w(double x, double y) const noexcept {
    return 1.0 + choice.kappa * (x * choice.axis.x + y * choice.axis.y - u_min);
  }
  /// The image (X, Y) of a point of the light plane, before it is turned.
  [[nodiscard]] glm::dvec2 image(double x, double y) const noexcept {
    const double inverse = 1.0 / w(x, y);
    return {(x * choice.axis.y - y * choice.axis.x - choice.centre) * inverse,
            (x * choice.axis.x + y * choice.axis.y - u_min) * stretch * inverse};
  }
};

/// Moves both ends apart to `least` where they are nearer.
void widen(double& low, double& high, double least) noexcept;
/// Moves each side of the rectangle out by this share of the rectangle.
void grow(PlaneMap& map, double share) noexcept;

/// The smallest rectangle that holds the body's image. Flat and single-point bodies get an extent of 1e-6 of
/// the largest one.
[[nodiscard]] PlaneMap plane_map(std::span<const WarpInput::Point> body, const WarpChoice& choice) noexcept;

/// Depths along the light in the light frame: from `bottom` upwards, with (z - bottom) / w between 0 and
/// `height`.
struct LightDepths {
  double bottom, height;
};

/// OpenGL clip space from the light frame. The rectangle fills the map but for `rim` of it on each side,
/// along the map's x and y (0 <= rim < 0.5); depth grows away from the light.
[[nodiscard]] glm::dmat4 clip_from_light(const PlaneMap& map, const LightDepths& depths,
                                         const glm::dvec2& rim) noexcept;
[[nodiscard]] inline glm::dmat4 clip_from_light(const PlaneMap& map, const LightDepths& depths,
                                                double rim) noexcept {
  return clip_from_light(map, depths, glm::dvec2(rim));
}

/// Light frame from points relative to the camera.
[[nodiscard]] glm::dmat4 light_from_relative(const LightFrame& frame) noexcept;

}  // namespace gnomon
