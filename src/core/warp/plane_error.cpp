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

}  // namespace gnomon
