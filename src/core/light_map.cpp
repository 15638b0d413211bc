// From a warp's strength and a rectangle to the map's matrix.
// Based on: Wimmer, Scherzer, Purgathofer 2004, rewritten in kappa = 1 / (distance of the projection centre),
// so that kappa = 0 is the orthographic map and nothing tends to infinity.
#include "light_map.hpp"

#include "vector.hpp"

namespace gnomon {
namespace {

// An extent of nothing would divide by zero; this much of the largest extent is far below a texel.
constexpr double kFlattest = 1e-6;
// An extent that is smaller than this much of the body's distance is its rounding: the body is a point.
constexpr double kPointSize = 1e-9;

}  // namespace

void widen(double& low, double& high, double least) noexcept {
  if (high - low >= least) return;
  const double middle = 0.5 * (low + high);
  low = middle - 0.5 * least;
  high = middle + 0.5 * least;
}

void grow(PlaneMap& map, double share) noexcept {
  const double a = share * (map.a_max - map.a_min), b = share * (map.b_max - map.b_min);
  map.a_min -= a;
  map.a_max += a;
  map.b_min -= b;
  map.b_max += b;
}

PlaneMap plane_map(std::span<const WarpInput::Point> body, const WarpChoice& choice) noexcept {
  PlaneMap map{};
  map.choice = choice;
  const glm::dvec2 axis = choice.axis;
  const auto along = [&](const WarpInput::Point& p) { return p.x * axis.x + p.y * axis.y; };
  double u_max = along(body.front());
  map.u_min = u_max;
  for (const WarpInput::Point& p : body) {
    map.u_min = min_of(map.u_min, along(p));
    u_max = max_of(u_max, along(p));
  }
  map.length = u_max - map.u_min;
  map.stretch = 1.0 + choice.kappa * map.length;
  bool first = true;
  for (const WarpInput::Point& p : body) {
    const double u = along(p) - map.u_min, s = p.x * axis.y - p.y * axis.x - choice.centre;
    const double inverse = 1.0 / (1.0 + choice.kappa * u);
    const double x = s * inverse, y = u * map.stretch * inverse;
    const double a = choice.row_a.x * x + choice.row_a.y * y, b = choice.row_b.x * x + choice.row_b.y * y;
    map.a_min = first ? a : min_of(map.a_min, a);
    map.a_max = first ? a : max_of(map.a_max, a);
    map.b_min = first ? b : min_of(map.b_min, b);
    map.b_max = first ? b : max_of(map.b_max, b);
    first = false;
  }
  double z_low = body.front().z, z_high = z_low, distance = 0.0;
  for (const WarpInput::Point& p : body) {
    z_low = min_of(z_low, p.z);
    z_high = max_of(z_high, p.z);
    distance = max_of(distance, largest_component({p.x, p.y, p.z}));
  }
  const double extent = max_of(max_of(map.a_max - map.a_min, map.b_max - map.b_min), z_high - z_low);
  const double least = max_of(kFlattest * extent, distance > 0.0 ? kPointSize * distance : kPointSize);
  widen(map.a_min, map.a_max, least);
  widen(map.b_min, map.b_max, least);
  return map;
}

glm::dmat4 clip_from_light(const PlaneMap& map, const LightDepths& depths, const glm::dvec2& rim) noexcept {
  // Rows over (x, y, z, 1) of the light frame. Before the division by w: the image's x is s - centre, its y u
  // * stretch.
  const glm::dvec2 axis = map.choice.axis, row_a = map.choice.row_a, row_b = map.choice.row_b;
  const double kappa = map.choice.kappa;
  const glm::dvec3 across{axis.y, -axis.x, -map.choice.centre};  // over (x, y, 1)
  const glm::dvec3 along{axis.x * map.stretch, axis.y * map.stretch, -map.u_min * map.stretch};
  const glm::dvec3 w{kappa * axis.x, kappa * axis.y, 1.0 - kappa * map.u_min};
  const auto edge_to_edge = [&](const glm::dvec3& row, double low, double high, double part) {
    return (row - w * (0.5 * (low + high))) * (2.0 * (1.0 - 2.0 * part) / (high - low));
  };
  const glm::dvec3 row_x = edge_to_edge(across * row_a.x + along * row_a.y, map.a_min, map.a_max, rim.x);
  const glm::dvec3 row_y = edge_to_edge(across * row_b.x + along * row_b.y, map.b_min, map.b_max, rim.y);
  const double scale_z = 2.0 / depths.height;
  glm::dmat4 m;
  for (int column = 0; column < 2; ++column) m[column] = {row_x[column], row_y[column], w[column], w[column]};
  m[2] = {0.0, 0.0, -scale_z, 0.0};
  m[3] = {row_x.z, row_y.z, w.z + scale_z * depths.bottom, w.z};
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
