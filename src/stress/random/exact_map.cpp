// A map's matrix in long double, and how far the rounding of doubles and floats may move what it shows.
#include "exact_map.hpp"

#include <cmath>

namespace gnomon::stress {
namespace {

// Of a position relative to the camera or to a local light: about 4000 roundings of a double. The core clips
// its bodies with 1e-13 of the largest distance at hand, face after face.
constexpr Real kPosition = 1e-12L;
// Of a row times a world position: the column that moves it is a sum of eight roundings, of numbers that are
// sums themselves.
constexpr Real kWorld = 64.0L * 0x1p-53L;

}  // namespace

RelativeMap::RelativeMap(const ShadowPlan& plan, const ShadowMap& map, const View& view)
    : matrix_(relative_matrix(map.clip_from_world, glm::dvec3(view.eye))),
      world_(map.clip_from_world),
      eye_(view.eye),
      apex_(0.0L),
      space_(plan.clip_space) {
  if (map.light_world.w != 0.0) apex_ = Real3(glm::dvec3(map.light_world)) - view.eye;
}

Real4 RelativeMap::world_error(const Real3& p) const {
  Real4 error(0.0L);
  for (int row = 0; row < 4; ++row) {
    Real sum = std::abs(Real(world_[3][row]));
    for (int c = 0; c < 3; ++c)
      sum += std::abs(Real(world_[c][row])) *
             (std::abs(p[c] + eye_[c]) + std::abs(eye_[c]) + std::abs(apex_[c] + eye_[c]));
    error[row] = kWorld * sum;
  }
  return error;
}

Shown RelativeMap::show(const Real3& p) const {
  Shown shown{matrix_ * Real4(p, 1.0L), world_error(p)};
  const Real moved = kPosition * (length(p) + length(apex_));
  for (int row = 0; row < 4; ++row)
    shown.error[row] += moved * length(Real3(matrix_[0][row], matrix_[1][row], matrix_[2][row]));
  Real& z = shown.clip.z;
  if (space_.ndc_depth == NdcDepth::zero_to_one) {
    z = 2.0L * z - shown.clip.w;
    shown.error.z = 2.0L * shown.error.z + shown.error.w;
  }
  if (space_.reversed_z) z = -z;
  return shown;
}

}  // namespace gnomon::stress
