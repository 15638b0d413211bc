// From a warp's strength and a rectangle to the map's matrix.
// Based on: Wimmer, Scherzer, Purgathofer 2004, rewritten in kappa = 1 / (distance of the projection centre),
// so that kappa = 0 is the orthographic map and nothing tends to infinity.
#include "light_map.hpp"

#include "vector.hpp"

namespace gnomon {
namespace {

// An extent of nothing would divide by zero; this much of the largest extent is far below a texel.
constexpr double kFlattest = 1e-6;
// For a body that is a single point: any size serves, this one keeps the matrix well scaled.
constexpr double kPointSize = 1e-3;

void widen(double& low, double& high, double least) noexcept {
  if (high - low >= least) return;
  const double middle = 0.5 * (low + high);
  low = middle - 0.5 * least;
  high = middle + 0.5 * least;
}

}  // namespace

LightRectangle rectangle_round(std::span<const WarpInput::Point> body, double kappa) noexcept {
  LightRectangle r{0.0, 0.0, body.front().y, body.front().y};
  double z_low = body.front().z, z_high = z_low, farthest = 0.0;
  for (const WarpInput::Point& p : body) {
    r.y_min = min_of(r.y_min, p.y);
    r.y_max = max_of(r.y_max, p.y);
    z_low = min_of(z_low, p.z);
    z_high = max_of(z_high, p.z);
    farthest = max_of(farthest, p.depth);
  }
  bool first = true;
  for (const WarpInput::Point& p : body) {
    const double x = p.x / (1.0 + kappa * (p.y - r.y_min));
    r.left = first ? x : min_of(r.left, x);
    r.right = first ? x : max_of(r.right, x);
    first = false;
  }
  const double extent = max_of(max_of(r.right - r.left, r.y_max - r.y_min), z_high - z_low);
  const double least = extent > 0.0 ? kFlattest * extent : kPointSize * farthest;
  widen(r.left, r.right, least);
  widen(r.y_min, r.y_max, least);
  return r;
}

glm::dmat4 clip_from_light(const LightRectangle& r, double kappa, const LightDepths& depths, double rim_x,
                           double rim_y) noexcept {
  const double length = r.y_max - r.y_min;
  const double fill_x = 1.0 - 2.0 * rim_x, fill_y = 1.0 - 2.0 * rim_y;
  const double scale_x = 2.0 * fill_x / (r.right - r.left);
  const double middle_x = 0.5 * (r.left + r.right);
  const double scale_y = 2.0 / length + kappa;
  const double w0 = 1.0 - kappa * r.y_min;
  const double scale_z = 2.0 / depths.height;
  // Row by row: x = scale_x (x - middle w), y = fill_y (scale_y (y - y_min) - 1), z = w - scale_z (z -
  // bottom), w.
  glm::dmat4 m(0.0);
  m[0][0] = scale_x;
  m[1] = {-scale_x * middle_x * kappa, fill_y * scale_y, kappa, kappa};
  m[2][2] = -scale_z;
  m[3] = {-scale_x * middle_x * w0, -fill_y * (scale_y * r.y_min + 1.0), w0 + scale_z * depths.bottom, w0};
  return m;
}

glm::dmat4 light_from_relative(const LightFrame& frame) noexcept {
  glm::dmat4 m(1.0);
  for (int column = 0; column < 3; ++column) {
    m[column] = {frame.x[column], frame.y[column], frame.z[column], 0.0};
  }
  return m;
}

}  // namespace gnomon
