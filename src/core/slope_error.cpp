// What a map of a light with a position is judged by: the perspective error of any projective map of the
// light's slopes, at points of the body.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, as a Jacobian.
#include "slope_error.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

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
  sample_[static_cast<std::size_t>(count_++)] = {at.x, at.y, j.xx, j.xy, j.yx, j.yy};
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
    const double length = std::log(end / begin);
    rays[count++] = {step, begin, length};
    total += length;
  }
  const double spacing = total / kVisiblePoints;
  if (!(spacing > 0.0)) return;
  const double ratio = std::exp(spacing);
  double next = 0.5 * spacing;
  for (std::size_t i = 0; i < count; ++i) {
    double depth = next < rays[i].length ? rays[i].begin * std::exp(next) : 0.0;
    for (; next < rays[i].length; next += spacing, depth *= ratio) add(rays[i].step * depth);
    next -= rays[i].length;
  }
}

double SlopeError::value(const WarpChoice& choice, std::span<const WarpInput::Point> body) noexcept {
  const PlaneMap plane = plane_map(body, choice);
  const glm::dmat4 m = clip_from_light(plane, {0.0, 1.0}, 0.0);
  s_ = t_ = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
    const Sample& p = sample_[i];
    const double inverse = 1.0 / (m[0][3] * p.x + m[1][3] * p.y + m[3][3]);
    if (!(inverse > 0.0)) return kInfinite;
    const double x = (m[0][0] * p.x + m[1][0] * p.y + m[3][0]) * inverse;
    const double y = (m[0][1] * p.x + m[1][1] * p.y + m[3][1]) * inverse;
    // Half of the clip space's width is one texel here.
    const double half = 0.5 * inverse;
    const double xx = (m[0][0] - x * m[0][3]) * half, xy = (m[1][0] - x * m[1][3]) * half;
    const double yx = (m[0][1] - y * m[0][3]) * half, yy = (m[1][1] - y * m[1][3]) * half;
    const Extents e =
        extents({xx * p.xx + xy * p.yx, xx * p.xy + xy * p.yy, yx * p.xx + yy * p.yx, yx * p.xy + yy * p.yy});
    s_ = max_of(s_, e.s);
    t_ = max_of(t_, e.t);
    worst = max_of(worst, e.longest);
    longest_[i] = e.longest;
  }
  if (objective_ == Objective::storage) return s_ * t_;
  if (objective_ == Objective::max) return worst;
  const auto middle = static_cast<std::ptrdiff_t>(kShareBelow * count_);
  std::nth_element(longest_.begin(), longest_.begin() + middle, longest_.begin() + count_);
  return longest_[static_cast<std::size_t>(middle)];
}

}  // namespace gnomon
