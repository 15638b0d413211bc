// What a map of a light with a position is judged by: the perspective error of any projective map of the
// light's slopes, at points of the body.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, as a Jacobian.
#include "slope_error.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "elementary.hpp"
#include "light_map.hpp"
#include "metric_kernel.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Rays across and down the image for the even sampling, and points along all of them together.
constexpr int kRaysPerSide = 10;
constexpr int kVisiblePoints = 120;
// Share of the samples that may exceed the value asked for.
constexpr double kShareBelow = 0.95;

}  // namespace

double LightFrustum::distance(const glm::dvec3& point) const noexcept {
  return glm::dot(frame.z, apex - point);
}

glm::dvec2 LightFrustum::slopes(const glm::dvec3& point) const noexcept {
  const glm::dvec3 q = point - apex;
  const double inverse = -1.0 / glm::dot(frame.z, q);
  return {glm::dot(frame.x, q) * inverse, glm::dot(frame.y, q) * inverse};
}

glm::dvec3 LightFrustum::ray(double x, double y) const noexcept {
  return frame.x * x + frame.y * y - frame.z;
}

SlopeError::SlopeError(const Camera& camera, const CameraAxes& axes, const LightFrustum& light,
                       const Polytope& body, Objective objective, double least_depth) noexcept
    : camera_(camera), axes_(axes), light_(light), objective_(objective), least_depth_(least_depth) {
  if (objective == Objective::p95 && !camera.orthographic) add_visible_points(body);
  // So few that the share below says nothing: the body shows in a few pixels only.
  constexpr int kTooFew = 20;
  if (count_ < kTooFew) {
    count_ = 0;
    if (objective_ == Objective::p95) objective_ = Objective::max;
    add_vertices_and_edges(body);
    // The worst texel may lie inside a face or the body: the light's rays fan out, and with them the warp.
    if (objective_ == Objective::max && !camera.orthographic) add_visible_points(body);
  }
}

void SlopeError::add(const glm::dvec3& point) noexcept {
  if (count_ == kMaxSamples) return;
  ViewPoint view = view_point(camera_, axes_, point);
  if (!camera_.orthographic) {
    // Nearer than the least depth that counts, a pixel is as wide as there.
    const double depth = glm::dot(axes_.forward, point);
    if (!(depth >= least_depth_)) {
      const double px = (camera_.right - camera_.left) / camera_.width;
      const double py = (camera_.top - camera_.bottom) / camera_.height;
      view.pixel_x = axes_.right * (px * least_depth_);
      view.pixel_y = axes_.up * (py * least_depth_);
    }
  }
  const double distance = light_.distance(point);
  if (!(distance > 0.0)) return;
  const glm::dvec2 at = light_.slopes(point);
  const TexelJacobian slopes{(light_.frame.x + light_.frame.z * at.x) / distance,
                             (light_.frame.y + light_.frame.z * at.y) / distance, at.x, at.y, 1.0};
  const Jacobian2 j =
      perspective_jacobian(slopes, view, safe_normalize(point - light_.apex, -light_.frame.z));
  const double determinant = j.xx * j.yy - j.xy * j.yx;
  if (determinant == 0.0) return;
  const auto i = static_cast<std::size_t>(count_++);
  x_[i] = at.x;
  y_[i] = at.y;
  xx_[i] = j.xx;
  xy_[i] = j.xy;
  yx_[i] = j.yx;
  yy_[i] = j.yy;
  inverse_determinant_[i] = 1.0 / determinant;
}

void SlopeError::add_vertices_and_edges(const Polytope& body) noexcept {
  std::array<glm::dvec3, kMaxFaces> sum{};
  std::array<int, kMaxFaces> corners{};
  for (int i = 0; i < body.vertex_count; ++i) {
    const Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    add(v.position);
    for (const std::uint8_t f : v.face) {
      sum[f] += v.position;
      ++corners[f];
    }
    for (const std::uint8_t other : v.neighbour) {
      if (other > i) add((v.position + body.vertex[other].position) * 0.5);
    }
  }
  for (std::size_t f = 0; f < sum.size(); ++f) {
    if (corners[f] > 0) add(sum[f] / static_cast<double>(corners[f]));
  }
}

void SlopeError::add_visible_points(const Polytope& body) noexcept {
  struct Ray {
    glm::dvec3 step;
    double begin, length;
  };
  std::array<Ray, kRaysPerSide * kRaysPerSide> rays;
  std::size_t count = 0;
  // Where the image shows the body at all.
  double left = kInfinite, right = -kInfinite, bottom = kInfinite, top = -kInfinite;
  for (const Polytope::Vertex& v : body.vertices()) {
    const double depth = max_of(glm::dot(axes_.forward, v.position), camera_.near_depth);
    const double x = glm::dot(axes_.right, v.position) / depth, y = glm::dot(axes_.up, v.position) / depth;
    left = min_of(left, x);
    right = max_of(right, x);
    bottom = min_of(bottom, y);
    top = max_of(top, y);
  }
  double total = 0.0;
  for (int i = 0; i < kRaysPerSide * kRaysPerSide; ++i) {
    const double x = left + (right - left) * (i % kRaysPerSide + 0.5) / kRaysPerSide;
    const double y = bottom + (top - bottom) * (i / kRaysPerSide + 0.5) / kRaysPerSide;
    const glm::dvec3 step = axes_.forward + axes_.right * x + axes_.up * y;
    double begin = camera_.near_depth, end = camera_.far_depth;
    for (int f = 0; f < body.face_count; ++f) {
      const Plane& plane = body.plane[static_cast<std::size_t>(f)];
      const double along = glm::dot(plane.normal, step);
      if (along > 0.0) begin = max_of(begin, -plane.offset / along);
      if (along < 0.0) end = min_of(end, -plane.offset / along);
    }
    if (!(begin < end)) continue;
    const double length = elementary::log(end / begin);
    rays[count++] = {step, begin, length};
    total += length;
  }
  const double spacing = total / kVisiblePoints;
  if (!(spacing > 0.0)) return;
  const double ratio = elementary::exp(spacing);
  double next = 0.5 * spacing;
  for (std::size_t i = 0; i < count; ++i) {
    double depth = next < rays[i].length ? rays[i].begin * elementary::exp(next) : 0.0;
    for (; next < rays[i].length; next += spacing, depth *= ratio) add(rays[i].step * depth);
    next -= rays[i].length;
  }
}

double SlopeError::value(const WarpChoice& choice, std::span<const WarpInput::Point> body) noexcept {
  const PlaneMap plane = plane_map(body, choice);
  const glm::dmat4 m = clip_from_light(plane, {0.0, 1.0}, 0.0);
  const double m00 = m[0][0], m01 = m[1][0], m02 = m[3][0], m10 = m[0][1], m11 = m[1][1], m12 = m[3][1];
  const double w0 = m[0][3], w1 = m[1][3], w2 = m[3][3];
  // A projective map's Jacobian has the determinant of its matrix over w^3. Half of clip space is half a
  // texel.
  const double determinant =
      m00 * (m11 * w2 - m12 * w1) - m01 * (m10 * w2 - m12 * w0) + m02 * (m10 * w1 - m11 * w0);
  const double inverse_area = 4.0 / determinant;
  const auto n = static_cast<std::size_t>(count_);
  double least_w = kInfinite, s_squared = 0.0, t_squared = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = w0 * x_[i] + w1 * y_[i] + w2, inverse = 1.0 / w, half = 0.5 * inverse;
    const double x = (m00 * x_[i] + m01 * y_[i] + m02) * inverse;
    const double y = (m10 * x_[i] + m11 * y_[i] + m12) * inverse;
    const double ax = (m00 - x * w0) * half, ay = (m01 - x * w1) * half;
    const double bx = (m10 - y * w0) * half, by = (m11 - y * w1) * half;
    const double jxx = ax * xx_[i] + ay * yx_[i], jxy = ax * xy_[i] + ay * yy_[i];
    const double jyx = bx * xx_[i] + by * yx_[i], jyy = bx * xy_[i] + by * yy_[i];
    const double inverse_det = w * w * w * inverse_area * inverse_determinant_[i];
    const double square = inverse_det * inverse_det;
    s_squared_[i] = (jyx * jyx + jyy * jyy) * square;
    t_squared_[i] = (jxx * jxx + jxy * jxy) * square;
    // The product of both singular values of the inverse.
    longest_squared_[i] = std::abs(inverse_det);
    least_w = min_of(least_w, w);
    s_squared = max_of(s_squared, s_squared_[i]);
    t_squared = max_of(t_squared, t_squared_[i]);
  }
  if (!(least_w > 0.0)) return kInfinite;
  s_ = std::sqrt(s_squared);
  t_ = std::sqrt(t_squared);
  return objective_ == Objective::storage ? s_ * t_ : longest_of_samples();
}

double SlopeError::longest_of_samples() noexcept {
  const auto n = static_cast<std::size_t>(count_);
  double worst = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double half = 0.5 * (s_squared_[i] + t_squared_[i]), product = longest_squared_[i];
    const double spread = (half - product) * (half + product);
    longest_squared_[i] = half + std::sqrt(spread > 0.0 ? spread : 0.0);
    worst = max_of(worst, longest_squared_[i]);
  }
  if (objective_ == Objective::max) return std::sqrt(worst);
  const auto middle = static_cast<std::ptrdiff_t>(kShareBelow * count_);
  std::nth_element(longest_squared_.begin(), longest_squared_.begin() + middle,
                   longest_squared_.begin() + count_);
  return std::sqrt(longest_squared_[static_cast<std::size_t>(middle)]);
}

}  // namespace gnomon
