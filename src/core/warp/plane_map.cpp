// From a warp's strength and a rectangle to the map's matrix, and what the body needs of that map.
// Based on: Wimmer, Scherzer, Purgathofer 2004, rewritten in kappa = 1 / (distance of the projection centre),
// so that kappa = 0 is the orthographic map and nothing tends to infinity.
#include "warp/plane_map.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/pair.hpp"
#include "lanes/point_pair.hpp"

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
  return plane_map(body, bounds_of(body), choice);
}

PointBounds bounds_of(std::span<const WarpInput::Point> body) noexcept {
  Pair xy_low = Pair::from(&body[0].x), xy_high = xy_low, z_low = Pair::from(&body[0].z), z_high = z_low;
  for (const WarpInput::Point& p : body.subspan(1)) {
    const Pair xy = Pair::from(&p.x), z = Pair::from(&p.z);  // and depth, for nothing
    xy_low = min_of(xy_low, xy);
    xy_high = max_of(xy_high, xy);
    z_low = min_of(z_low, z);
    z_high = max_of(z_high, z);
  }
  PointBounds b{xy_low.low(), xy_high.low(), xy_low.high(), xy_high.high(), z_low.low(), z_high.low(), 0.0};
  b.distance =
      max_of(largest_component({b.x_min, b.y_min, b.z_min}), largest_component({b.x_max, b.y_max, b.z_max}));
  return b;
}

namespace {

/// The rectangle round the image of a body that no warp bends and no row turns: its bounds.
bool is_plain(const WarpChoice& choice) noexcept {
  return choice.kappa == 0.0 && choice.axis == glm::dvec2(0.0, 1.0) && choice.centre == 0.0 &&
         choice.row_a == glm::dvec2(1.0, 0.0) && choice.row_b == glm::dvec2(0.0, 1.0);
}

/// Sets the rectangle round the image, and what w depends on.
void enclose(std::span<const WarpInput::Point> body, PlaneMap& map) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const WarpChoice& choice = map.choice;
  const Pair axis_x(choice.axis.x), axis_y(choice.axis.y);
  Pair low(kInfinity), high(-kInfinity);
  for_each_two<PointPair>(body, [&](std::size_t, const PointPair& p) {
    const Pair u = p.x * axis_x + p.y * axis_y;
    low = min_of(low, u);
    high = max_of(high, u);
  });
  map.u_min = min_of(low.low(), low.high());
  map.length = max_of(high.low(), high.high()) - map.u_min;
  map.stretch = 1.0 + choice.kappa * map.length;
  const Pair one(1.0), kappa(choice.kappa), u_min(map.u_min), stretch(map.stretch), centre(choice.centre);
  const Pair a_x(choice.row_a.x), a_y(choice.row_a.y), b_x(choice.row_b.x), b_y(choice.row_b.y);
  Pair a_low(kInfinity), a_high(-kInfinity), b_low = a_low, b_high = a_high;
  for_each_two<PointPair>(body, [&](std::size_t, const PointPair& p) {
    const Pair u = p.x * axis_x + p.y * axis_y - u_min, inverse = one / (one + kappa * u);
    const Pair x = (p.x * axis_y - p.y * axis_x - centre) * inverse, y = u * stretch * inverse;
    const Pair a = a_x * x + a_y * y, b = b_x * x + b_y * y;
    a_low = min_of(a_low, a);
    a_high = max_of(a_high, a);
    b_low = min_of(b_low, b);
    b_high = max_of(b_high, b);
  });
  map.a_min = min_of(a_low.low(), a_low.high());
  map.a_max = max_of(a_high.low(), a_high.high());
  map.b_min = min_of(b_low.low(), b_low.high());
  map.b_max = max_of(b_high.low(), b_high.high());
}

}  // namespace

PlaneMap plane_map(std::span<const WarpInput::Point> body, const PointBounds& bounds,
                   const WarpChoice& choice) noexcept {
  PlaneMap map;
  map.choice = choice;
  if (is_plain(choice)) {
    map.u_min = bounds.y_min;
    map.length = bounds.y_max - bounds.y_min;
    map.stretch = 1.0;
    map.a_min = bounds.x_min;
    map.a_max = bounds.x_max;
    map.b_min = 0.0;
    map.b_max = map.length;
  } else {
    enclose(body, map);
  }
  const double extent =
      max_of(max_of(map.a_max - map.a_min, map.b_max - map.b_min), bounds.z_max - bounds.z_min);
  const double least = least_extent(extent, bounds.distance);
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
  glm::dvec3 row_x = edge_to_edge(across * row_a.x + along * row_a.y, map.a_min, map.a_max, border.x);
  const glm::dvec3 row_y = edge_to_edge(across * row_b.x + along * row_b.y, map.b_min, map.b_max, border.y);
  // Rows are found one by one, and may come as a mirror image: front faces would turn into back faces.
  if (row_a.x * row_b.y < row_a.y * row_b.x) row_x = -row_x;
  const double scale_z = 2.0 / depths.height;
  glm::dmat4 m;
  for (int column = 0; column < 2; ++column) m[column] = {row_x[column], row_y[column], w[column], w[column]};
  m[2] = {0.0, 0.0, -scale_z, 0.0};
  m[3] = {row_x.z, row_y.z, w.z + scale_z * depths.bottom, w.z};
  return m;
}

bool usable(std::span<const WarpInput::Point> body, const WarpChoice& choice, double most_stretch) noexcept {
  const PointBounds bounds = bounds_of(body);
  return usable(body, bounds, plane_map(body, bounds, choice), most_stretch);
}

bool usable(std::span<const WarpInput::Point> body, const PointBounds& bounds, const PlaneMap& map,
            double most_stretch) noexcept {
  // A body shorter along the axis than this much of its other extents, or of its distance, has its length
  // from rounding, and a warp's strength from it would be noise.
  constexpr double kShortest = 1e-6, kShortestOfDistance = 1e-9;
  double farthest = 0.0;
  for (const WarpInput::Point& p : body) {
    if (std::isfinite(p.depth)) farthest = max_of(farthest, p.depth);
  }
  const double extent = max_of(map.a_max - map.a_min, map.b_max - map.b_min);
  return map.length > kShortest * extent && map.length > kShortestOfDistance * farthest &&
         map.stretch <= most_stretch && map.choice.kappa * bounds.distance <= kMaxKappaDistance;
}

bool weaken(WarpChoice& choice, const PlaneMap& map, double most_stretch) noexcept {
  if (!(map.stretch > most_stretch)) return false;
  constexpr double kRounding = 1e-9;
  choice.kappa = (most_stretch - 1.0) * (1.0 - kRounding) / map.length;
  return true;
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
  WarpInput::Point nearest = body[0];
  if (choice.kappa == 0.0) {
    for (const WarpInput::Point& p : body) nearest.depth = min_of(nearest.depth, p.depth);
    body = {&nearest, 1};
  }
  const Pair one(1.0), axis_x(axis.x), axis_y(axis.y), kappa(choice.kappa), centre(choice.centre);
  const Pair u_min(plane.u_min), stretch(plane.stretch), side_a(side.x), side_b(side.y);
  Pair a_max(0.0), b_max(0.0);
  std::size_t at = 0;
  for_each_two<PointPair>(body, [&](std::size_t, const PointPair& p) {
    const Pair w = one + kappa * (p.x * axis_x + p.y * axis_y - u_min);
    const Pair lean = kappa * (p.x * axis_y - p.y * axis_x - centre) / w;
    const Pair along = w * w / stretch;  // of one unit of the image's Y
    // Extents of a step of the image at both points, over their depths.
    const auto extent = [&](const glm::dvec2& image, Pair& x, Pair& y) {
      const Pair u = along * Pair(image.y);
      x = (w * Pair(image.x) + lean * u) / p.depth;
      y = u / p.depth;
    };
    Pair a_x, a_y, b_x, b_y;
    extent(per_a, a_x, a_y);
    extent(per_b, b_x, b_y);
    a_max = max_of(a_max, a_x * a_x + a_y * a_y);
    b_max = max_of(b_max, b_x * b_x + b_y * b_y);
    a_x = a_x * side_a;
    a_y = a_y * side_a;
    b_x = b_x * side_b;
    b_y = b_y * side_b;
    TexelsNeeded::Vertex* const to = &needed.vertex[at];
    lows(a_x, a_y).to(&to[0].a.x);
    lows(b_x, b_y).to(&to[0].b.x);
    highs(a_x, a_y).to(&to[1].a.x);
    highs(b_x, b_y).to(&to[1].b.x);
    at += 2;
  });
  needed.count = static_cast<int>(body.size());
  needed.sides = {std::sqrt(max_of(a_max.low(), a_max.high())) * side.x,
                  std::sqrt(max_of(b_max.low(), b_max.high())) * side.y};
}

double TexelsNeeded::bound(const glm::dvec2& inside, double obliquity) const noexcept {
  const Pair half_of(0.5), inside_x(inside.x), inside_y(inside.y), zero(0.0);
  Pair longest(0.0);
  for (std::size_t i = 0, end = static_cast<std::size_t>(count); i < end; i += 2) {
    // Largest singular value of the texel's two sides.
    const Vertex &p = vertex[i], &q = vertex[i + 1 < end ? i + 1 : i];
    const Pair p_a = Pair::from(&p.a.x), q_a = Pair::from(&q.a.x);
    const Pair p_b = Pair::from(&p.b.x), q_b = Pair::from(&q.b.x);
    const Pair a_x = lows(p_a, q_a) / inside_x, a_y = highs(p_a, q_a) / inside_x;
    const Pair b_x = lows(p_b, q_b) / inside_y, b_y = highs(p_b, q_b) / inside_y;
    const Pair half = half_of * (a_x * a_x + a_y * a_y + (b_x * b_x + b_y * b_y));
    const Pair area = abs(a_x * b_y - a_y * b_x), spread = (half - area) * (half + area);
    longest = max_of(longest, half + sqrt(max_of(spread, zero)));
  }
  return std::sqrt(max_of(longest.low(), longest.high())) * obliquity;
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
