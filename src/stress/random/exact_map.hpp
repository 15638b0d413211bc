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

}  // namespace gnomon::stress
