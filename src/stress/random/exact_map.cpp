// A map's matrix in long double, and how far the rounding of doubles and floats may move what it shows.
#include "exact_map.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gnomon::stress {
namespace {

// Of a position relative to the camera or to a local light: about 4000 roundings of a double. The core clips
// its bodies with 1e-13 of the largest distance at hand, face after face.
constexpr Real kPosition = 1e-12L;

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
    error[row] = kWorldRounding * sum;
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

Real texel_rounding(const glm::dmat4& clip_from_point, Real step, const Real3& point, const Real3& travel) {
  const auto row = [&](int i) {
    return Real3(clip_from_point[0][i], clip_from_point[1][i], clip_from_point[2][i]);
  };
  const auto value = [&](int i) { return glm::dot(row(i), point) + Real(clip_from_point[3][i]); };
  const auto rounding = [&](int i) {
    return step * (glm::dot(glm::abs(row(i)), glm::abs(point)) + std::abs(Real(clip_from_point[3][i])));
  };
  constexpr int kW = 3;
  const Real w = value(kW), relative_w = rounding(kW) / w;
  if (!(w > rounding(kW))) return std::numeric_limits<Real>::infinity();
  // How ndc changes over the world, and what that may be off by.
  Real3 slope[2];
  Real off[2];
  for (int axis = 0; axis < 2; ++axis) {
    const Real ndc = value(axis) / w, ndc_off = rounding(axis) / w + std::abs(ndc) * relative_w;
    slope[axis] = (row(axis) - ndc * row(kW)) / w;
    off[axis] =
        (step * (length(row(axis)) + std::abs(ndc) * length(row(kW))) + ndc_off * length(row(kW))) / w +
        length(slope[axis]) * relative_w;
  }
  // A side is the other axis' slope, turned across the light, over the area of both.
  const Real area = std::abs(glm::dot(glm::cross(slope[0], slope[1]), travel));
  const Real of_area = off[0] * length(slope[1]) + off[1] * length(slope[0]);
  Real of_side = 0.0L;
  for (int axis = 0; axis < 2; ++axis)
    of_side = std::max(of_side, off[axis] / length(glm::cross(slope[axis], travel)));
  return of_area / area + of_side;
}

}  // namespace gnomon::stress
