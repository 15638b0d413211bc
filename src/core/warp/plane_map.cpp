// From a warp's strength and a rectangle to the map's matrix, and what the body needs of that map.
// Based on: Wimmer, Scherzer, Purgathofer 2004, rewritten in kappa = 1 / (distance of the projection centre),
// so that kappa = 0 is the orthographic map and nothing tends to infinity.
#include "warp/plane_map.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

// An extent of nothing would divide by zero; this much of the largest extent is far below a texel.
constexpr double kFlattest = 1e-6;
// An extent that is smaller than this much of the body's distance is its rounding: the body is a point.
constexpr double kPointSize = 1e-9;

}  // namespace

double least_extent(double extent, double distance) noexcept {
  return max_of(kFlattest * extent, distance > 0.0 ? kPointSize * distance : kPointSize);
}

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

double border_in_image(const PlaneMap& map, double border) noexcept {
  const glm::dvec2 a = map.choice.row_a, b = map.choice.row_b;
  // The image's step per unit of A is as long as row b over the rows' area, and the other way round.
  const double area = std::abs(a.x * b.y - a.y * b.x);
  return border *
         ((map.a_max - map.a_min) * std::sqrt(glm::dot(b, b)) +
          (map.b_max - map.b_min) * std::sqrt(glm::dot(a, a))) /
         area;
}

PlaneMap plane_map(std::span<const WarpInput::Point> body, const WarpChoice& choice) noexcept {
  PlaneMap map{};
  map.choice = choice;
  const glm::dvec2 axis = choice.axis;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double u_min = kInfinity, u_max = -kInfinity, z_min = kInfinity, z_max = -kInfinity, distance = 0.0;
  for (const WarpInput::Point& p : body) {
    const double u = p.x * axis.x + p.y * axis.y;
    u_min = min_of(u_min, u);
    u_max = max_of(u_max, u);
    z_min = min_of(z_min, p.z);
    z_max = max_of(z_max, p.z);
    distance = max_of(distance, largest_component({p.x, p.y, p.z}));
  }
  map.u_min = u_min;
  map.length = u_max - u_min;
  map.stretch = 1.0 + choice.kappa * map.length;
  map.a_min = map.b_min = kInfinity;
  map.a_max = map.b_max = -kInfinity;
  for (const WarpInput::Point& p : body) {
    const glm::dvec2 image = map.image(p.x, p.y);
    const double a = choice.row_a.x * image.x + choice.row_a.y * image.y;
    const double b = choice.row_b.x * image.x + choice.row_b.y * image.y;
    map.a_min = min_of(map.a_min, a);
    map.a_max = max_of(map.a_max, a);
    map.b_min = min_of(map.b_min, b);
    map.b_max = max_of(map.b_max, b);
  }
  const double extent = max_of(max_of(map.a_max - map.a_min, map.b_max - map.b_min), z_max - z_min);
  const double least = least_extent(extent, distance);
  widen(map.a_min, map.a_max, least);
  widen(map.b_min, map.b_max, least);
  return map;
}

glm::dmat4 clip_from_light(const PlaneMap& map, const LightDepths& depths,
                           const glm::dvec2& border) noexcept {
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
  const glm::dvec3 row_x = edge_to_edge(across * row_a.x + along * row_a.y, map.a_min, map.a_max, border.x);
  const glm::dvec3 row_y = edge_to_edge(across * row_b.x + along * row_b.y, map.b_min, map.b_max, border.y);
  const double scale_z = 2.0 / depths.height;
  glm::dmat4 m;
  for (int column = 0; column < 2; ++column) m[column] = {row_x[column], row_y[column], w[column], w[column]};
  m[2] = {0.0, 0.0, -scale_z, 0.0};
  m[3] = {row_x.z, row_y.z, w.z + scale_z * depths.bottom, w.z};
  return m;
}

bool usable(std::span<const WarpInput::Point> body, const WarpChoice& choice, double most_stretch) noexcept {
  // A body shorter along the axis than this much of its other extents, or of its distance, has its length
  // from rounding, and a warp's strength from it would be noise.
  constexpr double kShortest = 1e-6, kShortestOfDistance = 1e-9;
  const PlaneMap map = plane_map(body, choice);
  double farthest = 0.0, distance = 0.0;
  for (const WarpInput::Point& p : body) {
    if (std::isfinite(p.depth)) farthest = max_of(farthest, p.depth);
    distance = max_of(distance, largest_component({p.x, p.y, p.z}));
  }
  const double extent = max_of(map.a_max - map.a_min, map.b_max - map.b_min);
  return map.length > kShortest * extent && map.length > kShortestOfDistance * farthest &&
         map.stretch <= most_stretch && choice.kappa * distance <= kMostKappaDistance;
}

void texels_needed(std::span<const WarpInput::Point> body, const PlaneMap& plane, double pixels_per_slope,
                   TexelsNeeded& needed) noexcept {
  const WarpChoice& choice = plane.choice;
  const glm::dvec2 axis = choice.axis;
  // The image's X and Y per unit of A and B.
  const double area = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  const glm::dvec2 per_a = glm::dvec2(choice.row_b.y, -choice.row_b.x) / area;
  const glm::dvec2 per_b = glm::dvec2(-choice.row_a.y, choice.row_a.x) / area;
  const glm::dvec2 side{(plane.a_max - plane.a_min) * pixels_per_slope,
                        (plane.b_max - plane.b_min) * pixels_per_slope};
  // Without a warp all texels are alike, and pixels smallest at the nearest vertex.
  const auto nearer = [](const WarpInput::Point& p, const WarpInput::Point& q) { return p.depth < q.depth; };
  if (choice.kappa == 0.0) body = {std::min_element(body.begin(), body.end(), nearer), 1};
  needed.count = 0;
  double a_max = 0.0, b_max = 0.0;
  for (const WarpInput::Point& p : body) {
    const double w = plane.w(p.x, p.y);
    const double lean = choice.kappa * (p.x * axis.y - p.y * axis.x - choice.centre) / w;
    const double along = w * w / plane.stretch;  // of one unit of the image's Y
    const auto extent = [&](const glm::dvec2& image) {
      const double u = along * image.y;
      return glm::dvec2(w * image.x + lean * u, u);
    };
    const glm::dvec2 a = extent(per_a) / p.depth, b = extent(per_b) / p.depth;
    a_max = max_of(a_max, glm::dot(a, a));
    b_max = max_of(b_max, glm::dot(b, b));
    if (needed.count < kMaxBodyPoints)
      needed.vertex[static_cast<std::size_t>(needed.count++)] = {a * side.x, b * side.y};
  }
  needed.sides = {std::sqrt(a_max) * side.x, std::sqrt(b_max) * side.y};
}

double TexelsNeeded::bound(const glm::dvec2& inside, double obliquity) const noexcept {
  double longest = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    // Largest singular value of the texel's two sides.
    const glm::dvec2 a = vertex[i].a / inside.x, b = vertex[i].b / inside.y;
    const double half = 0.5 * (glm::dot(a, a) + glm::dot(b, b)), area = std::abs(a.x * b.y - a.y * b.x);
    const double spread = (half - area) * (half + area);
    longest = max_of(longest, half + std::sqrt(max_of(spread, 0.0)));
  }
  return std::sqrt(longest) * obliquity;
}

double share_per_unit(const PlaneMap& map, std::span<const WarpInput::Point> body) noexcept {
  const WarpChoice& c = map.choice;
  double a = 0.0, b = 0.0;
  for (const WarpInput::Point& p : body) {
    const double inverse = 1.0 / map.w(p.x, p.y);
    const double lean = c.kappa * (p.x * c.axis.y - p.y * c.axis.x - c.centre) * inverse;
    const auto steepness = [&](const glm::dvec2& row) {
      const double along = (row.y * map.stretch * inverse - row.x * lean) * inverse;
      return std::sqrt(row.x * row.x * inverse * inverse + along * along);
    };
    a = max_of(a, steepness(c.row_a));
    b = max_of(b, steepness(c.row_b));
  }
  return max_of(a / (map.a_max - map.a_min), b / (map.b_max - map.b_min));
}

}  // namespace gnomon
