// The error of a projective map of the light plane, at points of the body.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, as a Jacobian.
#include "light_plane_error.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "light_map.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

// Rays through the image for the even sampling, and points along all of them together.
constexpr int kColumns = 6, kRows = 6;
constexpr int kVisiblePoints = 96;
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

LightPlaneError::LightPlaneError(const WarpInput& input) noexcept : input_(input) {
  if (input.objective == Objective::p95) add_visible_points();
  share_ = kShareAbove95;
  if (count_ == 0) {
    share_ = 0.0;
    add_vertices_and_edges();
  }
}

void LightPlaneError::add(const glm::dvec3& p) noexcept {
  if (count_ == kMaxSamples) return;
  const ViewInLight& view = input_.view;
  const double depth = glm::dot(view.forward, p);
  const glm::dvec3 eye_ray =
      p * (1.0 / std::sqrt(max_of(glm::dot(p, p), std::numeric_limits<double>::min())));
  // Light travels along -z. The half vector's mirror as in metric_kernel.hpp; where it vanishes, so does its
  // effect.
  const glm::dvec3 sum{eye_ray.x, eye_ray.y, eye_ray.z - 1.0};
  const double twice = 2.0 / max_of(glm::dot(sum, sum), std::numeric_limits<double>::min());
  const double scale = max_of(depth, input_.depth_begin);
  const auto index = static_cast<std::size_t>(count_++);
  const auto turned = [&](const glm::dvec3& pixel, double& x, double& y) {
    const glm::dvec3 across = pixel - eye_ray * glm::dot(eye_ray, pixel);
    const double along = twice * glm::dot(sum, across);
    x = across.x - sum.x * along;
    y = across.y - sum.y * along;
  };
  turned(view.right * (view.pixel_x * scale), xx_[index], yx_[index]);
  turned(view.up * (view.pixel_y * scale), xy_[index], yy_[index]);
  x_[index] = p.x;
  y_[index] = p.y;
}

void LightPlaneError::add_vertices_and_edges() noexcept {
  const Polytope& body = *input_.polytope;
  for (std::size_t i = 0; i < body.vertices().size(); ++i) {
    const Polytope::Vertex& v = body.vertex[i];
    add(v.position);
    for (const std::uint8_t other : v.neighbour) {
      if (other > i) add((v.position + body.vertex[other].position) * 0.5);
    }
  }
}

void LightPlaneError::add_visible_points() noexcept {
  const ViewInLight& view = input_.view;
  const InverseDepthBounds bounds = inverse_depth_bounds(*input_.polytope, view, input_.depth_begin);
  struct Ray {
    glm::dvec3 step;
    double begin, length;  // depth where it enters the body; logarithm of the ratio to where it leaves
  };
  std::array<Ray, kColumns * kRows> rays;
  std::size_t ray_count = 0;
  double total = 0.0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x = view.image_left + (view.image_right - view.image_left) * (column + 0.5) / kColumns;
      const double y = view.image_bottom + (view.image_top - view.image_bottom) * (row + 0.5) / kRows;
      double least = 0.0, most = 1.0 / input_.depth_begin;
      for (std::size_t i = 0; i < bounds.least_count; ++i) least = max_of(least, bounds.least[i].on(x, y));
      for (std::size_t i = 0; i < bounds.most_count; ++i) most = min_of(most, bounds.most[i].on(x, y));
      if (!(least > 0.0 && least < most)) continue;
      const Ray ray{view.forward + view.right * x + view.up * y, 1.0 / most, std::log(most / least)};
      total += ray.length;
      rays[ray_count++] = ray;
    }
  }
  if (!(total > 0.0)) return;
  // Evenly spaced in the total length of all rays: each point stands for an equal share of what is seen.
  const double spacing = total / kVisiblePoints, ratio = std::exp(spacing);
  double next = 0.5 * spacing;
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Ray& ray = rays[i];
    double depth = next < ray.length ? ray.begin * std::exp(next) : 0.0;
    for (; next < ray.length; next += spacing, depth *= ratio) add(ray.step * depth);
    next -= ray.length;
  }
}

double LightPlaneError::value(const WarpChoice& choice) noexcept {
  const PlaneMap map = plane_map(input_.body, choice);
  const auto n = static_cast<std::size_t>(count_);
  const double scale_a = 1.0 / (map.a_max - map.a_min), scale_b = 1.0 / (map.b_max - map.b_min);
  for (std::size_t i = 0; i < n; ++i) {
    const double s = x_[i] * choice.axis.y - y_[i] * choice.axis.x - choice.centre;
    const double u = x_[i] * choice.axis.x + y_[i] * choice.axis.y - map.u_min;
    const double inverse = 1.0 / (1.0 + choice.kappa * u);
    const double shear = s * choice.kappa * inverse, stretch = map.stretch * inverse;
    // Gradients over the light plane of the projected coordinates, then turned and scaled to the map.
    const double gx_x = (choice.axis.y - shear * choice.axis.x) * inverse;
    const double gx_y = (-choice.axis.x - shear * choice.axis.y) * inverse;
    const double gy_x = stretch * choice.axis.x * inverse, gy_y = stretch * choice.axis.y * inverse;
    const double ax = (choice.turn.x * gx_x + choice.turn.y * gy_x) * scale_a;
    const double ay = (choice.turn.x * gx_y + choice.turn.y * gy_y) * scale_a;
    const double bx = (choice.turn.x * gy_x - choice.turn.y * gx_x) * scale_b;
    const double by = (choice.turn.x * gy_y - choice.turn.y * gx_y) * scale_b;
    const double jxx = ax * xx_[i] + ay * yx_[i], jxy = ax * xy_[i] + ay * yy_[i];
    const double jyx = bx * xx_[i] + by * yx_[i], jyy = bx * xy_[i] + by * yy_[i];
    const double row_x = jxx * jxx + jxy * jxy, row_y = jyx * jyx + jyy * jyy;
    const double determinant = jxx * jyy - jxy * jyx;
    const double half = 0.5 * (row_x + row_y), square = determinant * determinant;
    const double area = std::abs(determinant);
    const double spread = (half - area) * (half + area);
    const double inverse_square = 1.0 / square;
    longest_[i] = (half + std::sqrt(spread > 0.0 ? spread : 0.0)) * inverse_square;
    across_s_[i] = (jyy * jyy + jyx * jyx) * inverse_square;
    across_t_[i] = (jxx * jxx + jxy * jxy) * inverse_square;
  }
  const auto largest = [n](const std::array<double, kMaxSamples>& values) {
    double m = 0.0;
    for (std::size_t i = 0; i < n; ++i) m = max_of(m, values[i]);
    return m;
  };
  double squared = 0.0;
  if (input_.objective == Objective::storage) {
    squared = largest(across_s_) * largest(across_t_);
  } else {
    const auto above = static_cast<std::size_t>(share_ * static_cast<double>(n));
    if (above == 0) {
      squared = largest(longest_);
    } else {
      const auto kth = longest_.begin() + static_cast<std::ptrdiff_t>(n - 1 - above);
      std::nth_element(longest_.begin(), kth, longest_.begin() + static_cast<std::ptrdiff_t>(n));
      squared = *kth;
    }
  }
  return squared < std::numeric_limits<double>::infinity() ? std::sqrt(squared)
                                                           : std::numeric_limits<double>::infinity();
}

}  // namespace gnomon
