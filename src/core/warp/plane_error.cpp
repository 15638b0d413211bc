// The error of a projective map of the light plane, at points of the body.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, as a Jacobian.
#include "warp/plane_error.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

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

PlaneError::PlaneError(const WarpInput& input) noexcept : input_(input) {
  // Fewer samples make no percentile: the body shows in a few pixels only.
  constexpr int kTooFew = 20;
  if (input.objective == Objective::p95 && !input.orthographic) add_visible_points();
  share_ = kShareAbove95;
  if (count_ >= kTooFew) return;
  count_ = 0;
  share_ = 0.0;
  // First, as there may be no room for all.
  const bool focused = input.focus != nullptr && !input.focus->empty();
  const double outside = focused ? input.focus_weight : 1.0;
  if (focused) add_vertices_and_edges(*input.focus, 1.0);
  add_vertices_and_edges(*input.polytope, outside);
  if (!input.light.perspective) return;
  // The worst texel may lie inside a face or the body: the light's rays fan out, and with them the warp.
  add_faces(*input.polytope, outside);
  if (!input.orthographic) add_visible_points();
}

bool PlaneError::add(const glm::dvec3& p, double pixels) noexcept {
  const double distance = input_.light.distance(p);
  if (count_ == kMaxSamples) return true;
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
  const auto index = static_cast<std::size_t>(count_);
  const auto turned = [&](const glm::dvec3& pixel, double& x, double& y) {
    const glm::dvec3 across = pixel - eye_ray * glm::dot(eye_ray, pixel);
    const glm::dvec2 move = input_.light.jacobian(p, across - sum * (twice * glm::dot(sum, across)));
    x = move.x;
    y = move.y;
  };
  turned(view.right * (view.pixel_x * scale), xx_[index], yx_[index]);
  turned(view.up * (view.pixel_y * scale), xy_[index], yy_[index]);
  const double determinant = xx_[index] * yy_[index] - xy_[index] * yx_[index];
  // Of a pixel that rounding leaves no area, beside the eye or at the edge of a field of view near pi,
  // nothing is known.
  constexpr double kLeastArea = 1e-30;
  const double unit = scale / distance;
  if (!(std::abs(determinant) > kLeastArea * (view.pixel_x * unit) * (view.pixel_y * unit))) return false;
  ++count_;
  inverse_determinant_[index] = 1.0 / determinant;
  const glm::dvec3 at = input_.light.project(p);
  x_[index] = at.x;
  y_[index] = at.y;
  return true;
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

void PlaneError::add_vertices_and_edges(const Polytope& body, double pixels) noexcept {
  for (std::size_t i = 0; i < body.vertices().size(); ++i) {
    const Polytope::Vertex& v = body.vertex[i];
    complete_ = add(v.position, pixels) && complete_;
    for (const std::uint8_t other : v.neighbour) {
      if (other > i) add((v.position + body.vertex[other].position) * 0.5, pixels);
    }
  }
}

void PlaneError::add_visible_points() noexcept {
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
    const double along_x = 0.5 + 0.7548776662466927 * i, along_y = 0.5 + 0.5698402909980532 * i;
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

GNOMON_WIDE double PlaneError::value(const WarpChoice& choice) noexcept {
  // A body with corners of which nothing is known is no ground to choose a warp on.
  if (!complete_ && choice.kappa > 0.0) return std::numeric_limits<double>::infinity();
  const PlaneMap map = plane_map(input_.body, choice);
  const auto n = static_cast<std::size_t>(count_);
  const double axis_x = choice.axis.x, axis_y = choice.axis.y;
  const double a_x = choice.row_a.x, a_y = choice.row_a.y, b_x = choice.row_b.x, b_y = choice.row_b.y;
  const double kappa = choice.kappa, centre = choice.centre, u_min = map.u_min, map_stretch = map.stretch;
  const double scale_a = 1.0 / (map.a_max - map.a_min), scale_b = 1.0 / (map.b_max - map.b_min);
  // The determinant of the map's Jacobian is scale_a scale_b stretch / w^3 times that of its rows; the
  // samples' own are known.
  const double inverse_area = 1.0 / (scale_a * scale_b * map_stretch * (a_x * b_y - a_y * b_x));
  for (std::size_t i = 0; i < n; ++i) {
    const double s = x_[i] * axis_y - y_[i] * axis_x - centre;
    const double u = x_[i] * axis_x + y_[i] * axis_y - u_min;
    const double w = 1.0 + kappa * u, inverse = 1.0 / w;
    const double shear = s * kappa * inverse, stretch = map_stretch * inverse;
    // Gradients over the light plane of the projected coordinates, turned to the map's axes, along s and u.
    const double a_s = a_x * inverse, a_u = (a_y * stretch - a_x * shear) * inverse;
    const double b_s = b_x * inverse, b_u = (b_y * stretch - b_x * shear) * inverse;
    const double ax = (a_s * axis_y + a_u * axis_x) * scale_a, ay = (a_u * axis_y - a_s * axis_x) * scale_a;
    const double bx = (b_s * axis_y + b_u * axis_x) * scale_b, by = (b_u * axis_y - b_s * axis_x) * scale_b;
    const double jxx = ax * xx_[i] + ay * yx_[i], jxy = ax * xy_[i] + ay * yy_[i];
    const double jyx = bx * xx_[i] + by * yx_[i], jyy = bx * xy_[i] + by * yy_[i];
    row_x_[i] = jxx * jxx + jxy * jxy;
    row_y_[i] = jyx * jyx + jyy * jyy;
    inverse_[i] = w * w * w * inverse_area * inverse_determinant_[i];
  }
  const double squared = input_.objective == Objective::storage ? storage_squared() : worst_squared();
  return squared < std::numeric_limits<double>::infinity() ? std::sqrt(squared)
                                                           : std::numeric_limits<double>::infinity();
}

double PlaneError::storage_squared() const noexcept {
  double s = 0.0, t = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
    const double inverse_square = inverse_[i] * inverse_[i];
    s = max_of(s, row_y_[i] * inverse_square);
    t = max_of(t, row_x_[i] * inverse_square);
  }
  return s * t;
}

GNOMON_WIDE double PlaneError::worst_squared() noexcept {
  const auto n = static_cast<std::size_t>(count_);
  for (std::size_t i = 0; i < n; ++i) {
    const double half = 0.5 * (row_x_[i] + row_y_[i]), determinant = 1.0 / std::abs(inverse_[i]);
    const double spread = (half - determinant) * (half + determinant);
    row_x_[i] = (half + std::sqrt(spread > 0.0 ? spread : 0.0)) * inverse_[i] * inverse_[i];
  }
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
