// The error of a projective map of the light plane, at points of the body.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, as a Jacobian.
#include "warp/plane_error.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "geometry/elementary.hpp"
#include "geometry/vector.hpp"
#include "geometry/wide.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {
namespace {

// Rays through the image for the even sampling, and points along all of them together.
constexpr int kRays = 100;
constexpr int kVisiblePoints = 160;
constexpr double kShareAbove95 = 0.05;

/// A face of the body as a bound on 1 / depth along the ray (x, y, 1) of the image: linear in x and y, so
/// that finding where a ray is inside the body takes no division.
struct InverseDepthBound {
  double at, per_x, per_y;
  [[nodiscard]] double on(double x, double y) const noexcept { return at + per_x * x + per_y * y; }
};

/// The bounds of all faces: `least` from those that have the eye inside, `most` from those that have it
/// outside. Faces through the eye are the image's own edges.
struct InverseDepthBounds {
  std::array<InverseDepthBound, kMaxFaces> least, most;
  std::size_t least_count = 0, most_count = 0;
};

InverseDepthBounds inverse_depth_bounds(const Polytope& body, const ViewInLight& view,
                                        double near_depth) noexcept {
  InverseDepthBounds bounds;
  for (int f = 0; f < body.face_count; ++f) {
    const Plane& plane = body.plane[static_cast<std::size_t>(f)];
    // Faces nearer to the eye than rounding can tell pass through it.
    constexpr double kThroughEye = 1e-9;
    if (std::abs(plane.offset) <= kThroughEye * near_depth) continue;
    const double inverse = -1.0 / plane.offset;
    const InverseDepthBound bound{glm::dot(plane.normal, view.forward) * inverse,
                                  glm::dot(plane.normal, view.right) * inverse,
                                  glm::dot(plane.normal, view.up) * inverse};
    if (plane.offset > 0.0) {
      bounds.least[bounds.least_count++] = bound;
    } else {
      bounds.most[bounds.most_count++] = bound;
    }
  }
  return bounds;
}

}  // namespace

BodyLanes::BodyLanes(const WarpInput& input) noexcept {
  for (const WarpInput::Point& p : input.body) {
    if (count == x.size()) break;
    x[count] = p.x;
    y[count++] = p.y;
  }
  const std::size_t filled = count;
  count = whole_lanes(filled);
  for (std::size_t i = filled; i < count; ++i) {
    x[i] = x[0];
    y[i] = y[0];
  }
}

PlaneError::PlaneError(const WarpInput& input, bool searched, int set) noexcept
    : input_(input), lanes_(kWarpLanes), body_(input) {
  double low = input.body.front().z, high = low;
  for (const WarpInput::Point& p : input.body) {
    low = min_of(low, p.z);
    high = max_of(high, p.z);
    distance_ = max_of(distance_, largest_component({p.x, p.y, p.z}));
  }
  height_range_ = high - low;
  Polytope counted, counted_focus;
  const Polytope &body = from_pseudo_near(*input.polytope, counted), *focus = input.focus;
  if (focus != nullptr) focus = &from_pseudo_near(*focus, counted_focus);
  // First, as there may be no room for all.
  const bool focused = focus != nullptr && !focus->empty();
  const double outside = focused ? input.focus_weight : 1.0;
  if (focused) add_corners(*focus, 1.0);
  add_corners(body, outside);
  corners_.fill_lanes();
  // Fewer samples make no percentile: the body shows in a few pixels only.
  constexpr std::size_t kTooFew = 20;
  if (input.objective == Objective::p95 && !input.orthographic) add_visible_points(set);
  share_ = kShareAbove95;
  if (sample_.count < kTooFew) {
    share_ = 0.0;
    sample_.count = 0;
    if (focused) add_edges(*focus, 1.0);
    add_edges(body, outside);
    // The worst texel may lie inside a face or the body where rays fan out: the eye's in a wide image, or the
    // light's, and with them the warp.
    constexpr double kWide = 3.5;  // of the slope: 120 degrees
    const ViewInLight& view = input.view;
    const double wider = max_of(view.image_right - view.image_left, view.image_top - view.image_bottom);
    // So do rays that come to meet the eye's: the half vector turns fast between them.
    constexpr double kOpposed = -0.5;
    const bool inside = searched && (input.light.perspective || wider > kWide || input.cos_gamma < kOpposed);
    if (input.light.perspective || inside) add_faces(body, outside);
    if (inside && !input.orthographic) add_visible_points(set);
  }
  all_ = sample_.count;
  sample_.fill_lanes();
}

void PlaneError::count_worst(const WarpChoice& choice) noexcept {
  const double rows = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  // A percentile is of all points, and without an area there is no error.
  if (share_ > 0.0 || sample_.count == 0 || rows == 0.0) return;
  find_rows(choice);
  constexpr double kNearWorst = 0.25;  // of the square: half the error
  const bool storage = input_.objective == Objective::storage;
  double most_x = 0.0, most_y = 0.0;
  for (std::size_t i = 0; i < sample_.count; ++i) {
    if (!storage) row_x_[i] = row_y_[i] = row_x_[i] + row_y_[i];
    most_x = max_of(most_x, row_x_[i]);
    most_y = max_of(most_y, row_y_[i]);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all_; ++i) {
    if (!(row_x_[i] > kNearWorst * most_x || row_y_[i] > kNearWorst * most_y)) continue;
    for (auto* lane : {&sample_.x, &sample_.y, &sample_.xx, &sample_.xy, &sample_.yx, &sample_.yy,
                       &sample_.inverse_determinant})
      std::swap((*lane)[kept], (*lane)[i]);
    ++kept;
  }
  // The lanes past the last kept one hold points, too, and may as well count.
  if (kept > 0) sample_.count = whole_lanes(kept) < all_ ? whole_lanes(kept) : all_;
}

/// The part of the body whose error counts: all of it where nothing would be left.
const Polytope& PlaneError::from_pseudo_near(const Polytope& body, Polytope& counted) const noexcept {
  if (!(input_.pseudo_near > 0.0)) return body;
  counted = body;
  clip(counted, Plane{input_.view.forward, -input_.pseudo_near});
  return counted.empty() ? body : counted;
}

bool PlaneError::pixel_at(const glm::dvec3& p, double pixels, Pixel& pixel) const noexcept {
  const double distance = input_.light.distance(p);
  if (!(distance > 0.0)) return false;
  const ViewInLight& view = input_.view;
  const double depth = glm::dot(view.forward, p);
  const glm::dvec3 eye_ray =
      input_.orthographic ? view.forward
                          : p * (1.0 / std::sqrt(max_of(glm::dot(p, p), std::numeric_limits<double>::min())));
  // The half vector's mirror as in pixel_footprint.hpp; where it vanishes, so does its effect.
  const glm::dvec3 light = input_.light.perspective ? safe_normalize(input_.light.ray(p), {0.0, 0.0, -1.0})
                                                    : glm::dvec3(0.0, 0.0, -1.0);
  const glm::dvec3 sum = eye_ray + light;
  const double twice = 2.0 / max_of(glm::dot(sum, sum), std::numeric_limits<double>::min());
  const double scale = (input_.orthographic ? 1.0 : max_of(depth, input_.depth_begin)) * pixels;
  const auto turned = [&](const glm::dvec3& step) {
    const glm::dvec3 across = step - eye_ray * glm::dot(eye_ray, step);
    return input_.light.jacobian(p, across - sum * (twice * glm::dot(sum, across)));
  };
  const glm::dvec2 right = turned(view.right * (view.pixel_x * scale));
  const glm::dvec2 up = turned(view.up * (view.pixel_y * scale));
  const double determinant = right.x * up.y - up.x * right.y;
  // Of a pixel that rounding leaves no area, beside the eye or at the edge of a field of view near pi,
  // nothing is known.
  constexpr double kLeastArea = 1e-30;
  const double unit = scale / distance;
  if (!(std::abs(determinant) > kLeastArea * (view.pixel_x * unit) * (view.pixel_y * unit))) return false;
  const glm::dvec3 at = input_.light.project(p);
  pixel = {at.x, at.y, right.x, up.x, right.y, up.y, determinant};
  return true;
}

namespace {

template <std::size_t Most, typename Pixel>
void append(PixelLanes<Most>& lanes, const Pixel& p) noexcept {
  if (lanes.count == Most) return;
  const std::size_t i = lanes.count++;
  lanes.x[i] = p.x;
  lanes.y[i] = p.y;
  lanes.xx[i] = p.xx;
  lanes.xy[i] = p.xy;
  lanes.yx[i] = p.yx;
  lanes.yy[i] = p.yy;
  lanes.inverse_determinant[i] = 1.0 / p.determinant;
}

}  // namespace

bool PlaneError::add(const glm::dvec3& p, double pixels) noexcept {
  Pixel pixel;
  if (!pixel_at(p, pixels, pixel)) return false;
  append(sample_, pixel);
  return true;
}

void PlaneError::add_corners(const Polytope& body, double pixels) noexcept {
  for (const Polytope::Vertex& v : body.vertices()) {
    Pixel pixel;
    if (pixel_at(v.position, pixels, pixel)) append(corners_, pixel);
  }
}

void PlaneError::add_faces(const Polytope& body, double pixels) noexcept {
  std::array<glm::dvec3, kMaxFaces> sum{};
  std::array<int, kMaxFaces> corners{};
  for (const Polytope::Vertex& v : body.vertices()) {
    for (const std::uint8_t f : v.face) {
      sum[f] += v.position;
      ++corners[f];
    }
  }
  for (std::size_t f = 0; f < sum.size(); ++f) {
    if (corners[f] > 0) add(sum[f] / static_cast<double>(corners[f]), pixels);
  }
}

/// Vertices and the middles of edges.
void PlaneError::add_edges(const Polytope& body, double pixels) noexcept {
  for (std::size_t i = 0; i < body.vertices().size(); ++i) {
    const Polytope::Vertex& v = body.vertex[i];
    complete_ = add(v.position, pixels) && complete_;
    for (const std::uint8_t other : v.neighbour) {
      if (other > i) add((v.position + body.vertex[other].position) * 0.5, pixels);
    }
  }
}

void PlaneError::add_visible_points(int set) noexcept {
  const ViewInLight& view = input_.view;
  const Polytope* const focus = input_.focus;
  const auto weight_at = [&](const glm::dvec3& p) {
    if (focus == nullptr || focus->empty()) return 1.0;
    for (int f = 0; f < focus->face_count; ++f) {
      const Plane& plane = focus->plane[static_cast<std::size_t>(f)];
      if (glm::dot(plane.normal, p) + plane.offset < 0.0) return input_.focus_weight;
    }
    return 1.0;
  };
  const InverseDepthBounds bounds = inverse_depth_bounds(*input_.polytope, view, input_.depth_begin);
  // Where the image shows the body at all.
  double left = view.image_right, right = view.image_left, bottom = view.image_top, top = view.image_bottom;
  for (const Polytope::Vertex& v : input_.polytope->vertices()) {
    const double depth = max_of(glm::dot(view.forward, v.position), input_.depth_begin);
    const double x = glm::dot(view.right, v.position) / depth, y = glm::dot(view.up, v.position) / depth;
    left = min_of(left, x);
    right = max_of(right, x);
    bottom = min_of(bottom, y);
    top = max_of(top, y);
  }
  left = max_of(left, view.image_left);
  right = min_of(right, view.image_right);
  bottom = max_of(bottom, view.image_bottom);
  top = min_of(top, view.image_top);
  struct Ray {
    glm::dvec3 step;
    double begin, length;  // depth where it enters the body; logarithm of the ratio to where it leaves
  };
  std::array<Ray, kRays> rays;
  std::size_t ray_count = 0;
  double total = 0.0;
  for (int i = 0; i < kRays; ++i) {
    // Roberts' R2 sequence: even over the image without the aliasing of a grid against the body's edges.
    const int number = i + set * kRays;
    const double along_x = 0.5 + 0.7548776662466927 * number, along_y = 0.5 + 0.5698402909980532 * number;
    const double x = left + (right - left) * (along_x - std::floor(along_x));
    const double y = bottom + (top - bottom) * (along_y - std::floor(along_y));
    double least = 0.0, most = 1.0 / input_.depth_begin;
    for (std::size_t k = 0; k < bounds.least_count; ++k) least = max_of(least, bounds.least[k].on(x, y));
    for (std::size_t k = 0; k < bounds.most_count; ++k) most = min_of(most, bounds.most[k].on(x, y));
    if (!(least > 0.0 && least < most)) continue;
    const Ray ray{view.forward + view.right * x + view.up * y, 1.0 / most, elementary::log(most / least)};
    total += ray.length;
    rays[ray_count++] = ray;
  }
  if (!(total > 0.0)) return;
  // Evenly spaced in the total length of all rays: each point stands for an equal share of what is seen.
  const double spacing = total / kVisiblePoints, ratio = elementary::exp(spacing);
  double next = 0.5 * spacing;
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Ray& ray = rays[i];
    double depth = next < ray.length ? ray.begin * elementary::exp(next) : 0.0;
    for (; next < ray.length; next += spacing, depth *= ratio)
      add(ray.step * depth, weight_at(ray.step * depth));
    next -= ray.length;
  }
}

double PlaneError::value(const WarpChoice& choice) noexcept {
  // A body with corners of which nothing is known is no ground to choose a warp on.
  const double rows = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  if ((!complete_ && choice.kappa > 0.0) || sample_.count == 0 || body_.count == 0 || rows == 0.0)
    return std::numeric_limits<double>::infinity();
  find_rows(choice);
  const double squared = input_.objective == Objective::storage ? storage_squared() : worst_squared();
  return squared < std::numeric_limits<double>::infinity() ? std::sqrt(squared)
                                                           : std::numeric_limits<double>::infinity();
}

GNOMON_WIDE void PlaneError::find_rows(const WarpChoice& choice) noexcept {
  const double axis_x = choice.axis.x, axis_y = choice.axis.y;
  const double a_x = choice.row_a.x, a_y = choice.row_a.y, b_x = choice.row_b.x, b_y = choice.row_b.y;
  const double kappa = choice.kappa, centre = choice.centre;
  // The body's image, as plane_map has it.
  std::array<double, kMaxSamples>&along = row_x_, &a = row_y_, &b = inverse_;
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
    row_x_[i] = (jxx * jxx + jxy * jxy) * square;
    row_y_[i] = (jyx * jyx + jyy * jyy) * square;
    inverse_[i] = std::abs(inverse_determinant);
  }
}

double PlaneError::storage_squared() const noexcept {
  const std::size_t n = whole_lanes(sample_.count);
  return lane_range(row_x_.data(), n, lanes_).high * lane_range(row_y_.data(), n, lanes_).high;
}

GNOMON_WIDE double PlaneError::worst_squared() noexcept {
  const std::size_t n = sample_.count, whole = whole_lanes(n);
  // Half the sum of both squared extents, and their product's root: the larger of the two squares.
  for (std::size_t i = 0; i < whole; ++i) {
    const double half = 0.5 * (row_x_[i] + row_y_[i]), area = inverse_[i];
    const double spread = (half - area) * (half + area);
    row_x_[i] = half + std::sqrt(spread > 0.0 ? spread : 0.0);
  }
  if (share_ == 0.0) return lane_range(row_x_.data(), whole, lanes_).high;
  // The largest few, smallest of them first: as many as may exceed the value, and the value itself.
  constexpr std::size_t kMost = kMaxSamples / 16;
  const auto wanted = static_cast<std::size_t>(share_ * static_cast<double>(n)) + 1;
  std::array<double, kMost + 1> top{};
  for (std::size_t i = 0; i < n; ++i) {
    const double value = row_x_[i];
    if (!(value > top[0])) continue;
    std::size_t k = 0;
    for (; k + 1 < wanted && top[k + 1] < value; ++k) top[k] = top[k + 1];
    top[k] = value;
  }
  return top[0];
}

}  // namespace gnomon
