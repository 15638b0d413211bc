// A map's matrix in long double, and how far the rounding of doubles and floats may move what it shows.
#pragma once

#include "geometry.hpp"
#include "gnomon/plan.hpp"

namespace gnomon::stress {

/// A point in the map's OpenGL clip space, with the error that each part may have.
struct Shown {
  Real4 clip{0.0L};   ///< x and y with the sign of the clip space asked for, z from -w at the near plane to w
  Real4 error{0.0L};  ///< of clip, by the rounding of positions and of the matrix in double
  [[nodiscard]] Real ndc(int row) const { return clip[row] / clip.w; }
  [[nodiscard]] Real ndc_error(int row) const {
    return (error[row] + std::abs(ndc(row)) * error.w) / std::abs(clip.w);
  }
};

/// Of a row times a world position: the column that moves it is a sum of eight roundings, of numbers that are
/// sums themselves.
inline constexpr Real kWorldRounding = 64.0L * 0x1p-53L;
/// Of a number that is rounded to float.
inline constexpr Real kFloatRounding = 0x1p-24L;

class RelativeMap {
 public:
  RelativeMap(const ShadowPlan& plan, const ShadowMap& map, const View& view);
  /// `p` relative to the camera.
  [[nodiscard]] Shown show(const Real3& p) const;
  /// The matrix from points relative to the camera, in the plan's own clip space.
  [[nodiscard]] const Real4x4& matrix() const noexcept { return matrix_; }
  /// Error of each row's value at the point by the matrix in world coordinates alone.
  [[nodiscard]] Real4 world_error(const Real3& p) const;

 private:
  Real4x4 matrix_;
  glm::dmat4 world_;
  Real3 eye_, apex_;
  ClipSpace space_;
};

/// What texel_extent_world() at a point may be off by, of itself, where each number of the matrix is off by
/// `step` of itself. The sides of a texel follow from differences of numbers that may nearly cancel: a warp
/// from w = 1 to 1e8 loses more of them than of the places that it shows. `travel`: unit, of the light.
[[nodiscard]] Real texel_rounding(const glm::dmat4& clip_from_point, Real step, const Real3& point,
                                  const Real3& travel);

}  // namespace gnomon::stress
