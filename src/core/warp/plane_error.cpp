// The error of a projective map of the light plane, at points of the body.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, as a Jacobian.
#include "warp/plane_error.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "lanes/wide.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {
namespace {

constexpr double kShareAbove95 = 0.05;

/// The part of a body whose error counts: all of it where nothing would be left. `counted`: room for it.
const Polytope& from_pseudo_near(const WarpInput& input, const Polytope& body, Polytope& counted) noexcept {
  if (!(input.pseudo_near > 0.0)) return body;
  counted = body;
  clip(counted, Plane{input.view.forward, -input.pseudo_near});
  return counted.empty() ? body : counted;
}

/// nullptr: there is none.
const Polytope* focus_of(const WarpInput& input) noexcept {
  return input.focus != nullptr && !input.focus->empty() ? input.focus : nullptr;
}

/// This and others are out of line: together they would take more stack than any of them.
[[gnu::noinline]] void add_clipped_vertices(const WarpInput& input, const Polytope& body, double size,
                                            PixelLanes& lanes) noexcept {
  Polytope counted;
  add_vertices(from_pseudo_near(input, body, counted), size, lanes);
}

void add_counted_vertices(const WarpInput& input, const Polytope& body, double size,
                          PixelLanes& lanes) noexcept {
  if (input.pseudo_near > 0.0) {
    add_clipped_vertices(input, body, size, lanes);
  } else {
    add_vertices(body, size, lanes);
  }
}

/// The focus's vertices first, as there may be no room for all.
void add_corners(const WarpInput& input, PixelLanes& lanes) noexcept {
  const Polytope* const focus = focus_of(input);
  if (focus != nullptr) add_counted_vertices(input, *focus, 1.0, lanes);
  add_counted_vertices(input, *input.polytope, focus != nullptr ? input.focus_weight : 1.0, lanes);
}

/// How many of the corners something is known of.
[[gnu::noinline]] std::size_t known_corners(const WarpInput& input) noexcept {
  PixelLanes corners;
  add_corners(input, corners);
  find_pixels(input, corners);
  return corners.count;
}

}  // namespace

BodyLanes::BodyLanes(const WarpInput& input) noexcept {
  for (const WarpInput::Point& p : input.body) {
    if (count == x.size()) break;
    x[count] = p.x;
    y[count++] = p.y;
  }
  points = count;
  count = whole_lanes(points);
  for (std::size_t i = points; i < count; ++i) {
    x[i] = x[0];
    y[i] = y[0];
  }
}

PlaneError::PlaneError(const WarpInput& input, bool searched, int set) noexcept
    : input_(input), lanes_(kDoubleLanes), body_(input) {
  double low = input.body.front().z, high = low;
  for (const WarpInput::Point& p : input.body) {
    low = min_of(low, p.z);
    high = max_of(high, p.z);
    if (std::isfinite(p.depth)) farthest_ = max_of(farthest_, p.depth);
    distance_ = max_of(distance_, largest_component({p.x, p.y, p.z}));
  }
  height_range_ = high - low;
  add_samples(searched, set);
  if (!corners_are_samples()) corner_count_ = known_corners(input);
  all_ = sample_.count;
  above_ = above(all_);
}

void PlaneError::take_set(int set) noexcept {
  sample_.count = 0;
  add_visible_points(input_, set, sample_);
  find_pixels(input_, sample_);
  all_ = sample_.count;
  above_ = above(all_);
}

std::size_t PlaneError::above(std::size_t samples) const noexcept {
  const auto wanted = static_cast<std::size_t>(share_ * static_cast<double>(samples));
  return wanted < kMaxAbove ? wanted : kMaxAbove;
}

void PlaneError::count_bound() noexcept {
  // No part of the points bounds a percentile, or a mean.
  if (share_ != 0.0 || mean_) return;
  sample_.count = all_ < corner_count_ ? all_ : corner_count_;
  above_ = above(sample_.count);
}

[[gnu::noinline]] void PlaneError::add_samples(bool searched, int set) noexcept {
  Polytope counted, counted_focus;
  const Polytope &body = from_pseudo_near(input_, *input_.polytope, counted), *focus = focus_of(input_);
  if (focus != nullptr) focus = &from_pseudo_near(input_, *focus, counted_focus);
  // Fewer samples make no percentile: the body shows in a few pixels only.
  constexpr std::size_t kTooFew = 20;
  if (input_.objective == Objective::p95 && !input_.orthographic) {
    add_visible_points(input_, set, sample_);
    find_pixels(input_, sample_);
  }
  share_ = kShareAbove95;
  if (sample_.count >= kTooFew) return;
  share_ = 0.0;
  if (input_.objective == Objective::picture) {
    add_seen_points(input_, sample_);
    find_pixels(input_, sample_);
    mean_ = true;
    return;
  }
  sample_.count = 0;
  const double outside = focus != nullptr ? input_.focus_weight : 1.0;
  if (focus != nullptr) add_vertices(*focus, 1.0, sample_);
  add_vertices(body, outside, sample_);
  const std::size_t vertices = sample_.count;
  if (focus != nullptr) add_middles(*focus, 1.0, sample_);
  add_middles(body, outside, sample_);
  // The worst texel may lie inside a face or the body where rays fan out: the eye's in a wide image, or the
  // light's, and with them the warp.
  const ViewInLight& view = input_.view;
  const double wider = max_of(view.image_right - view.image_left, view.image_top - view.image_bottom);
  // So do rays that come to meet the eye's: the half vector turns fast between them.
  const bool inside =
      searched && (input_.light.perspective || wider > 2.0 * kWideSlope || input_.cos_gamma < kOpposedCosine);
  if (input_.light.perspective || inside) add_faces(body, outside, sample_);
  if (inside && !input_.orthographic) add_visible_points(input_, set, sample_);
  complete_ = find_pixels(input_, sample_) >= vertices;
  corner_count_ = vertices;
}

void PlaneError::find_corners(PixelLanes& corners) const noexcept {
  if (!corners_are_samples()) {
    add_corners(input_, corners);
    find_pixels(input_, corners);
    return;
  }
  corners.count = corner_count_;
  const std::size_t n = whole_lanes(corner_count_);
  const auto copy = [n](const auto& from, auto& to) { std::copy_n(from.begin(), n, to.begin()); };
  copy(sample_.x, corners.x);
  copy(sample_.y, corners.y);
  copy(sample_.xx, corners.xx);
  copy(sample_.xy, corners.xy);
  copy(sample_.yx, corners.yx);
  copy(sample_.yy, corners.yy);
  copy(sample_.inverse_determinant, corners.inverse_determinant);
}

void PlaneError::count_worst(const WarpChoice& choice) noexcept {
  const double rows = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  // Without an area there is no error.
  if (sample_.count == 0 || rows == 0.0 || choice.kappa * distance_ > kMaxKappaDistance) return;
  if (mean_) return;  // all of them count
  Rows of_map;
  // Of the squares. A percentile may come to rest farther below its first value.
  constexpr std::array<double, 4> kNearWorst = {0.6, 0.5, 0.65, 0.5};
  const bool storage = input_.objective == Objective::storage;
  const double near_worst = kNearWorst[static_cast<std::size_t>(input_.objective)];
  double most_x = 0.0, most_y = 0.0;
  if (storage) {
    find_rows(choice, of_map);
    const std::size_t n = whole_lanes(all_);
    most_x = lane_range(of_map.x.data(), n, lanes_).high;
    most_y = lane_range(of_map.y.data(), n, lanes_).high;
  } else {
    most_x = squared(choice, of_map);
    if (!(most_x < std::numeric_limits<double>::infinity())) return;
    for (std::size_t i = 0; i < all_; ++i) of_map.y[i] = 0.0;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all_; ++i) {
    if (!(of_map.x[i] > near_worst * most_x || of_map.y[i] > near_worst * most_y)) continue;
    for (auto* lane : {&sample_.x, &sample_.y, &sample_.xx, &sample_.xy, &sample_.yx, &sample_.yy,
                       &sample_.inverse_determinant})
      std::swap((*lane)[kept], (*lane)[i]);
    ++kept;
  }
  // The lanes past the last kept one hold points, too, and may as well count.
  if (kept > 0) sample_.count = kept;
}

double PlaneError::value(const WarpChoice& choice) const noexcept {
  Rows rows;
  return std::sqrt(squared(choice, rows));
}

/// The square of the value, infinite for one that is no number.
double PlaneError::squared(const WarpChoice& choice, Rows& of_map) const noexcept {
  // A body with corners of which nothing is known is no ground to choose a warp on.
  const double rows = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  if ((!complete_ && choice.kappa > 0.0) || sample_.count == 0 || body_.count == 0 || rows == 0.0 ||
      choice.kappa * distance_ > kMaxKappaDistance)
    return std::numeric_limits<double>::infinity();
  find_rows(choice, of_map);
  const double square =
      input_.objective == Objective::storage ? storage_squared(of_map) : worst_squared(of_map);
  return square < std::numeric_limits<double>::infinity() ? square : std::numeric_limits<double>::infinity();
}

GNOMON_WIDE void PlaneError::find_rows(const WarpChoice& choice, Rows& of_map) const noexcept {
  Rows& __restrict rows = of_map;
  const double axis_x = choice.axis.x, axis_y = choice.axis.y;
  const double a_x = choice.row_a.x, a_y = choice.row_a.y, b_x = choice.row_b.x, b_y = choice.row_b.y;
  const double kappa = choice.kappa, centre = choice.centre;
  // The body's image, as plane_map has it.
  std::array<double, kMaxSamples>&along = rows.x, &a = rows.y, &b = rows.inverse;
  const std::size_t corners = body_.count;
  for (std::size_t i = 0; i < corners; ++i) along[i] = body_.x[i] * axis_x + body_.y[i] * axis_y;
  const LaneRange u_range = lane_range(along.data(), corners, lanes_);
  const double u_min = u_range.low, map_stretch = 1.0 + kappa * (u_range.high - u_min);
  for (std::size_t i = 0; i < corners; ++i) {
    const double u = along[i] - u_min, s = body_.x[i] * axis_y - body_.y[i] * axis_x - centre;
    const double inverse = 1.0 / (1.0 + kappa * u);
    const double x = s * inverse, y = u * map_stretch * inverse;
    a[i] = a_x * x + a_y * y;
    b[i] = b_x * x + b_y * y;
  }
  const LaneRange range_a = lane_range(a.data(), corners, lanes_),
                  range_b = lane_range(b.data(), corners, lanes_);
  const double least = least_extent(
      max_of(max_of(range_a.high - range_a.low, range_b.high - range_b.low), height_range_), distance_);
  const double side_a = max_of(range_a.high - range_a.low, least);
  const double side_b = max_of(range_b.high - range_b.low, least);
  const double scale_a = 1.0 / side_a, scale_b = 1.0 / side_b;
  // The determinant of the map's Jacobian is scale_a scale_b stretch / w^3 times that of its rows; the
  // samples' own are known.
  const double inverse_area = side_a * side_b / (map_stretch * (a_x * b_y - a_y * b_x));
  const std::size_t n = whole_lanes(sample_.count);
  for (std::size_t i = 0; i < n; ++i) {
    const double s = sample_.x[i] * axis_y - sample_.y[i] * axis_x - centre;
    const double u = sample_.x[i] * axis_x + sample_.y[i] * axis_y - u_min;
    const double w = 1.0 + kappa * u, inverse = 1.0 / w;
    const double shear = s * kappa * inverse, stretch = map_stretch * inverse;
    // Gradients over the light plane of the projected coordinates, turned to the map's axes, along s and u.
    const double a_s = a_x * inverse, a_u = (a_y * stretch - a_x * shear) * inverse;
    const double b_s = b_x * inverse, b_u = (b_y * stretch - b_x * shear) * inverse;
    const double ax = (a_s * axis_y + a_u * axis_x) * scale_a, ay = (a_u * axis_y - a_s * axis_x) * scale_a;
    const double bx = (b_s * axis_y + b_u * axis_x) * scale_b, by = (b_u * axis_y - b_s * axis_x) * scale_b;
    const double jxx = ax * sample_.xx[i] + ay * sample_.yx[i], jxy = ax * sample_.xy[i] + ay * sample_.yy[i];
    const double jyx = bx * sample_.xx[i] + by * sample_.yx[i], jyy = bx * sample_.xy[i] + by * sample_.yy[i];
    const double inverse_determinant = w * w * w * inverse_area * sample_.inverse_determinant[i];
    const double square = inverse_determinant * inverse_determinant;
    rows.x[i] = (jxx * jxx + jxy * jxy) * square;
    rows.y[i] = (jyx * jyx + jyy * jyy) * square;
    rows.inverse[i] = std::abs(inverse_determinant);
  }
}

double PlaneError::storage_squared(const Rows& rows) const noexcept {
  const std::size_t n = whole_lanes(sample_.count);
  return lane_range(rows.x.data(), n, lanes_).high * lane_range(rows.y.data(), n, lanes_).high;
}

/// Half the sum of both squared extents, and their product's root: the larger of the two squares.
GNOMON_WIDE void PlaneError::find_larger(Rows& rows) const noexcept {
  const std::size_t whole = whole_lanes(sample_.count);
  for (std::size_t i = 0; i < whole; ++i) {
    const double half = 0.5 * (rows.x[i] + rows.y[i]), area = rows.inverse[i];
    const double spread = (half - area) * (half + area);
    rows.x[i] = half + std::sqrt(spread > 0.0 ? spread : 0.0);
  }
}

double PlaneError::worst_squared(Rows& rows) const noexcept {
  const std::size_t n = sample_.count, whole = whole_lanes(n);
  if (mean_) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += std::sqrt(0.5 * (rows.x[i] + rows.y[i]));
    const double mean = sum / static_cast<double>(n);
    return mean * mean;
  }
  find_larger(rows);
  if (share_ == 0.0) return lane_range(rows.x.data(), whole, lanes_).high;
  // The largest few, smallest of them first: as many as may exceed the value, and the value itself.
  const std::size_t wanted = above_ + 1;
  std::array<double, kMaxAbove + 1> top{};
  for (std::size_t i = 0; i < n; ++i) {
    const double value = rows.x[i];
    if (!(value > top[0])) continue;
    std::size_t k = 0;
    for (; k + 1 < wanted && top[k + 1] < value; ++k) top[k] = top[k + 1];
    top[k] = value;
  }
  return top[0];
}

void ChoiceLanes::set(std::size_t lane, const WarpChoice& choice) noexcept {
  axis_x[lane] = choice.axis.x;
  axis_y[lane] = choice.axis.y;
  kappa[lane] = choice.kappa;
  centre[lane] = choice.centre;
  a_x[lane] = choice.row_a.x;
  a_y[lane] = choice.row_a.y;
  b_x[lane] = choice.row_b.x;
  b_y[lane] = choice.row_b.y;
}

/// A map for each choice: its w, linear over the light plane, and the gradients of its coordinates A and B
/// times w^2, which are (turn y + x, y - turn x); scaled so that a texel's extents need no other factor.
struct PlaneError::MapLanes {
  alignas(64) DoubleLanes a_turn, a_x, a_y, b_turn, b_x, b_y, w_x, w_y, w_1;
  alignas(64) DoubleLanes area;   // of the rectangle's cell in the light plane where w is 1
  alignas(64) DoubleLanes known;  // 1; 0 where no map can be made with the choice
};

/// Of the body: along each choice's axis, and along both of its rows in the image.
struct PlaneError::ExtentLanes {
  alignas(64) DoubleLanes u_min, u_max, stretch, a_min, a_max, b_min, b_max;
};

GNOMON_WIDE void PlaneError::find_extents(const ChoiceLanes& c, ExtentLanes& extents) const noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t lanes = lanes_;
  auto& [u_min, u_max, stretch, a_min, a_max, b_min, b_max] = extents;
  for (std::size_t l = 0; l < lanes; ++l) {
    u_min[l] = a_min[l] = b_min[l] = kInfinity;
    u_max[l] = a_max[l] = b_max[l] = -kInfinity;
  }
  for (std::size_t i = 0; i < body_.points; ++i) {
    const double x = body_.x[i], y = body_.y[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      const double u = x * c.axis_x[l] + y * c.axis_y[l];
      u_min[l] = min_of(u_min[l], u);
      u_max[l] = max_of(u_max[l], u);
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) stretch[l] = 1.0 + c.kappa[l] * (u_max[l] - u_min[l]);
  for (std::size_t i = 0; i < body_.points; ++i) {
    const double x = body_.x[i], y = body_.y[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      const double u = x * c.axis_x[l] + y * c.axis_y[l] - u_min[l];
      const double s = x * c.axis_y[l] - y * c.axis_x[l] - c.centre[l];
      const double inverse = 1.0 / (1.0 + c.kappa[l] * u), v = u * stretch[l];
      const double a = (c.a_x[l] * s + c.a_y[l] * v) * inverse, b = (c.b_x[l] * s + c.b_y[l] * v) * inverse;
      a_min[l] = min_of(a_min[l], a);
      a_max[l] = max_of(a_max[l], a);
      b_min[l] = min_of(b_min[l], b);
      b_max[l] = max_of(b_max[l], b);
    }
  }
}

GNOMON_WIDE void PlaneError::fit(const ChoiceLanes& choices, const ExtentLanes& extents,
                                 MapLanes& map) const noexcept {
  const std::size_t lanes = lanes_;
  // Copies, which the compiler knows that nothing below writes to.
  const ChoiceLanes c = choices;
  const ExtentLanes of = extents;
  const double distance = distance_, height = height_range_, least_of_all = least_extent(0.0, distance_),
               farthest = farthest_;
  const double most_stretch = input_.most_stretch;
  const double warped_known = complete_ ? 1.0 : 0.0;
  for (std::size_t l = 0; l < lanes; ++l) {
    const double a = of.a_max[l] - of.a_min[l], b = of.b_max[l] - of.b_min[l], extent = max_of(a, b);
    // As least_extent and usable have it.
    const double least = max_of(1e-6 * max_of(extent, height), least_of_all);
    const double side_a = divisor(a, least), side_b = divisor(b, least);
    const double turn = c.a_x[l] * c.b_y[l] - c.a_y[l] * c.b_x[l];
    const double length = of.u_max[l] - of.u_min[l];
    const double shortest = max_of(1e-6 * max_of(side_a, side_b), 1e-9 * farthest);
    const double warped =
        length > shortest && of.stretch[l] <= most_stretch && turn != 0.0 ? warped_known : 0.0;
    const double kept = c.kappa[l] * distance <= kMaxKappaDistance ? warped : 0.0;
    map.known[l] = c.kappa[l] == 0.0 ? 1.0 : kept;
    // The determinant of the map's Jacobian is stretch turn / (side_a side_b w^3). Rows come out multiplied
    // with the area of a cell, and so as extents of texels.
    const double area = side_a * side_b / of.stretch[l] * inverse_or_0(turn), scale_a = area / side_a,
                 scale_b = area / side_b;
    const double ax = c.axis_x[l], ay = c.axis_y[l];
    // Of one that is not usable w might be 0 at a sample.
    const double kappa = map.known[l] != 0.0 ? c.kappa[l] : 0.0;
    const double along_a = c.a_y[l] * of.stretch[l], along_b = c.b_y[l] * of.stretch[l];
    const double w_x = kappa * ax, w_y = kappa * ay, w_1 = 1.0 - kappa * of.u_min[l];
    const double a_x = (c.a_x[l] * ay + along_a * ax) * scale_a,
                 a_y = (along_a * ay - c.a_x[l] * ax) * scale_a;
    const double a_1 = -(c.a_x[l] * c.centre[l] + along_a * of.u_min[l]) * scale_a;
    const double b_x = (c.b_x[l] * ay + along_b * ax) * scale_b,
                 b_y = (along_b * ay - c.b_x[l] * ax) * scale_b;
    const double b_1 = -(c.b_x[l] * c.centre[l] + along_b * of.u_min[l]) * scale_b;
    map.a_turn[l] = a_x * w_y - a_y * w_x;
    map.a_x[l] = a_x * w_1 - a_1 * w_x;
    map.a_y[l] = a_y * w_1 - a_1 * w_y;
    map.b_turn[l] = b_x * w_y - b_y * w_x;
    map.b_x[l] = b_x * w_1 - b_1 * w_x;
    map.b_y[l] = b_y * w_1 - b_1 * w_y;
    map.w_x[l] = w_x;
    map.w_y[l] = w_y;
    map.w_1[l] = w_1;
    map.area[l] = std::abs(area);
  }
}

// For one sample and choice: squared lengths of the rows of d(texel)/d(pixel) over its determinant. The
// gradient of A = S / w is (w grad S - S grad w) / w^2, whose numerator is linear over the plane, and the
// determinant goes by w^-3: no sample takes a division.
#define GNOMON_ROWS                                                                        \
  const double w = map.w_x[l] * x + map.w_y[l] * y + map.w_1[l];                           \
  const double a_x = map.a_turn[l] * y + map.a_x[l], a_y = map.a_y[l] - map.a_turn[l] * x; \
  const double b_x = map.b_turn[l] * y + map.b_x[l], b_y = map.b_y[l] - map.b_turn[l] * x; \
  const double ax = a_x * xx + a_y * yx, ay = a_x * xy + a_y * yy;                         \
  const double bx = b_x * xx + b_y * yx, by = b_x * xy + b_y * yy;                         \
  const double f = w * id, f2 = f * f;                                                     \
  const double row_a = (ax * ax + ay * ay) * f2, row_b = (bx * bx + by * by) * f2

GNOMON_WIDE void PlaneError::find_storage(const MapLanes& map, DoubleLanes& value) const noexcept {
  const std::size_t lanes = lanes_, n = sample_.count;
  alignas(64) DoubleLanes most_a{}, most_b{};
  for (std::size_t i = 0; i < n; ++i) {
    const double x = sample_.x[i], y = sample_.y[i], xx = sample_.xx[i], xy = sample_.xy[i];
    const double yx = sample_.yx[i], yy = sample_.yy[i], id = sample_.inverse_determinant[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_ROWS;
      most_a[l] = max_of(most_a[l], row_a);
      most_b[l] = max_of(most_b[l], row_b);
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) value[l] = most_a[l] * most_b[l];
}

GNOMON_WIDE void PlaneError::find_mean(const MapLanes& map, DoubleLanes& value) const noexcept {
  const std::size_t lanes = lanes_, n = sample_.count;
  alignas(64) DoubleLanes sum{};
  for (std::size_t i = 0; i < n; ++i) {
    const double x = sample_.x[i], y = sample_.y[i], xx = sample_.xx[i], xy = sample_.xy[i];
    const double yx = sample_.yx[i], yy = sample_.yy[i], id = sample_.inverse_determinant[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_ROWS;
      sum[l] += std::sqrt(0.5 * (row_a + row_b));
    }
  }
  const double share = n > 0 ? 1.0 / static_cast<double>(n) : 0.0;
  for (std::size_t l = 0; l < lanes; ++l) value[l] = sum[l] * share;
}

// A texel's squares are the roots of x^2 - 2 half x + area^2, half the sum of both squared extents and the
// product of both: the larger one is above `square` where half is, or where the quadratic is negative there.
GNOMON_WIDE void PlaneError::count_above(const MapLanes& map, double square,
                                         DoubleLanes& count) const noexcept {
  const std::size_t lanes = lanes_, n = sample_.count;
  const double inverse = inverse_or_0(square), enough = static_cast<double>(above_) + 0.5;
  alignas(64) DoubleLanes above;
  for (std::size_t l = 0; l < lanes; ++l) above[l] = map.known[l] != 0.0 ? 0.0 : enough + 0.5;
  // Asked now and then whether all have enough.
  constexpr std::size_t kBetween = 16;
  for (std::size_t begin = 0; begin < n; begin += kBetween) {
    const std::size_t end = begin + kBetween < n ? begin + kBetween : n;
    for (std::size_t i = begin; i < end; ++i) {
      const double x = sample_.x[i], y = sample_.y[i], xx = sample_.xx[i], xy = sample_.xy[i];
      const double yx = sample_.yx[i], yy = sample_.yy[i], id = sample_.inverse_determinant[i];
      for (std::size_t l = 0; l < lanes; ++l) {
        GNOMON_ROWS;
        const double twice = row_a + row_b, area = f * w * w * map.area[l];
        const double beyond = max_of(0.5 * twice - square, (twice - square) - area * (area * inverse));
        // What is no number counts as nothing.
        above[l] += beyond >= 0.0 ? 1.0 : 0.0;
      }
    }
    double least = above[0];
    for (std::size_t l = 1; l < lanes; ++l) least = min_of(least, above[l]);
    if (least > enough) break;
  }
  for (std::size_t l = 0; l < lanes; ++l) count[l] = above[l];
}
#undef GNOMON_ROWS

void PlaneError::below(const ChoiceLanes& choices, double value, LaneAnswers& is_below) noexcept {
  is_below.fill(false);
  const double square = value * value;
  if (sample_.count == 0 || body_.points == 0 || !(square > 0.0)) return;
  ExtentLanes extents;
  MapLanes map;
  find_extents(choices, extents);
  fit(choices, extents, map);
  DoubleLanes found;
  if (!(square < std::numeric_limits<double>::infinity())) {
    for (std::size_t l = 0; l < kDoubleLanes; ++l) is_below[l] = map.known[l] != 0.0;
  } else if (input_.objective == Objective::storage) {
    find_storage(map, found);
    for (std::size_t l = 0; l < kDoubleLanes; ++l)
      is_below[l] = map.known[l] != 0.0 && std::sqrt(found[l]) < value;
  } else if (mean_) {
    find_mean(map, found);
    for (std::size_t l = 0; l < kDoubleLanes; ++l) is_below[l] = map.known[l] != 0.0 && found[l] < value;
  } else {
    count_above(map, square, found);
    for (std::size_t l = 0; l < kDoubleLanes; ++l) is_below[l] = found[l] <= static_cast<double>(above_);
  }
}

}  // namespace gnomon
