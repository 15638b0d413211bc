// Where is the camera at a time of its flight?
// Based on: Catmull and Rom, A Class of Local Interpolating Splines (1974); knots as in Yuksel, Schaefer and
// Keyser, Parameterization and Applications of Catmull-Rom Curves (2011), alpha = 1/2; evaluated as by Barry
// and Goldman, A Recursive Evaluation Algorithm for a Class of Catmull-Rom Splines (1988).
#include "gnomon/scene/camera_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace gnomon {

Sight sight_from(const glm::dvec3& eye, std::span<const Box> boxes) noexcept {
  constexpr double kInside = 1e-4, kLeast = 1e-6;
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  bool inside = false;
  for (const Box& box : boxes) {
    if (box.empty()) continue;
    const glm::dvec3 below = box.min - eye, above = eye - box.max;
    farthest = std::max(farthest, glm::length(glm::max(glm::abs(below), glm::abs(above))));
    const double away = glm::length(glm::max(glm::max(below, above), glm::dvec3(0.0)));
    if (away > 0.0)
      nearest = std::min(nearest, away);
    else
      inside = true;
  }
  if (!(farthest > 0.0) || !std::isfinite(farthest)) return {};
  const double far_depth = std::exp2(std::floor(std::log2(farthest)) + 1.0);
  double near_depth = 0.5 * nearest;
  if (inside) near_depth = std::min(near_depth, kInside * far_depth);
  near_depth = std::clamp(near_depth, kLeast * far_depth, 0.5 * far_depth);
  return {std::exp2(std::floor(std::log2(near_depth))), far_depth};
}

void see_all(CameraPath& path, std::span<const Box> boxes) noexcept {
  constexpr double kBefore = 1.0 / 256.0;  // of the radius, so that the nearest corner is not cut
  Box all;
  for (const Box& box : boxes)
    if (!box.empty()) all.extend(box);
  if (all.empty()) return;
  const double radius = std::max(0.5 * glm::length(all.max - all.min), path.height_world * kBefore);
  path.near_depth = kBefore * radius;
  path.far_depth = 2.0 * radius * (1.0 + kBefore);
  for (CameraKey& key : path.keys) {
    const glm::dvec3 forward = glm::normalize(key.target - key.position);
    const double depth = glm::dot(forward, 0.5 * (all.min + all.max) - key.position);
    const glm::dvec3 shift = forward * (depth - radius * (1.0 + kBefore));
    key.position += shift;
    key.target = key.position + forward * radius;
  }
}

namespace {

// Knots nearer together than this part of a unit span would divide by nothing; keys may well repeat.
constexpr double kLeastSpan = 1e-6;
// Axes of files are of single precision: smaller sines are none.
constexpr double kSingleSine = 1e-6;

double span_between(const CameraKey& a, const CameraKey& b) noexcept {
  const glm::dvec3 p = b.position - a.position, t = b.target - a.target;
  return std::sqrt(std::sqrt(glm::dot(p, p) + glm::dot(t, t)));  // alpha = 1/2 of the distance in both
}

CameraKey mix(const CameraKey& a, const CameraKey& b, double t) noexcept {
  return {a.position + (b.position - a.position) * t, a.target + (b.target - a.target) * t,
          a.up + (b.up - a.up) * t};
}

// The keys around one segment, at `knots`; the curve between the middle two.
struct Segment {
  std::array<CameraKey, 4> keys;
  std::array<double, 4> knots;
};

CameraKey evaluate(const Segment& s, double u) noexcept {
  std::array<CameraKey, 4> level = s.keys;
  const auto lerp = [&](std::size_t i, std::size_t first, std::size_t last) {
    const double t = (u - s.knots[first]) / (s.knots[last] - s.knots[first]);
    level[i] = mix(level[i], level[i + 1], t);
  };
  for (std::size_t i = 0; i < 3; ++i) lerp(i, i, i + 1);
  for (std::size_t i = 0; i < 2; ++i) lerp(i, i, i + 2);
  lerp(0, 1, 2);
  return level[0];
}

// Key `i` of a path, where the ends of an open one go on as their own mirror images.
CameraKey key_at(const CameraPath& path, std::ptrdiff_t i) noexcept {
  const auto count = static_cast<std::ptrdiff_t>(path.keys.size());
  if (path.closed) return path.keys[static_cast<std::size_t>((i % count + count) % count)];
  if (i < 0) return mix(path.keys[0], path.keys[1], -1.0);
  if (i >= count) return mix(path.keys[path.keys.size() - 1], path.keys[path.keys.size() - 2], -1.0);
  return path.keys[static_cast<std::size_t>(i)];
}

CameraKey key_in_flight(const CameraPath& path, double t) noexcept {
  const auto count = static_cast<std::ptrdiff_t>(path.keys.size());
  const std::ptrdiff_t segments = path.closed ? count : count - 1;
  double widest = 0.0, length = 0.0;
  for (std::ptrdiff_t i = 0; i < segments; ++i) {
    widest = std::max(widest, span_between(key_at(path, i), key_at(path, i + 1)));
  }
  const double least = widest > 0.0 ? widest * kLeastSpan : 1.0;
  const auto span = [&](std::ptrdiff_t i) {
    return std::max(span_between(key_at(path, i), key_at(path, i + 1)), least);
  };
  for (std::ptrdiff_t i = 0; i < segments; ++i) length += span(i);

  const double goal = t * length;
  double begin = 0.0;
  std::ptrdiff_t i = 0;
  while (i + 1 < segments && begin + span(i) < goal) begin += span(i++);
  Segment s;
  for (std::size_t k = 0; k < 4; ++k) s.keys[k] = key_at(path, i - 1 + static_cast<std::ptrdiff_t>(k));
  s.knots[1] = 0.0;
  s.knots[0] = -span(i - 1);
  s.knots[2] = span(i);
  s.knots[3] = s.knots[2] + span(i + 1);
  return evaluate(s, std::min(goal - begin, s.knots[2]));
}

bool is_vertical(const glm::dvec3& v) noexcept {
  return std::hypot(v.x, v.z) <= kSingleSine * std::abs(v.y);
}

}  // namespace

CameraKey camera_key(const glm::dvec3& position, const glm::dvec3& forward, const glm::dvec3& up) noexcept {
  CameraKey key{position, position + forward};
  const CameraAxes upright = camera_axes(CameraPath{.keys = {key}}.at(0.0, 1, 1));
  if (std::abs(glm::dot(up, upright.right)) > kSingleSine || glm::dot(up, upright.up) < 0.0) key.up = up;
  return key;
}

Camera CameraPath::at(double t, int width, int height) const noexcept {
  CameraKey key;
  if (keys.size() == 1) key = keys.front();
  if (keys.size() > 1) key = key_in_flight(*this, t >= 0.0 ? std::min(t, 1.0) : 0.0);
  glm::dvec3 forward = key.target - key.position;
  // Two keys that look at each other meet in the middle; a camera must still look somewhere.
  if (!(glm::dot(forward, forward) > 0.0)) forward = {0.0, 0.0, -1.0};
  // A camera that looks straight down has north (-Z) at its top, as maps do.
  const glm::dvec3 up = is_vertical(forward) && is_vertical(key.up)
                            ? glm::dvec3(0.0, 0.0, forward.y < 0.0 ? -1.0 : 1.0)
                            : key.up;
  const double aspect = height > 0 ? static_cast<double>(width) / static_cast<double>(height) : 1.0;
  if (height_world > 0.0)
    return orthographic_camera(key.position, forward, up, height_world, aspect, near_depth, far_depth, width,
                               height);
  return perspective_camera(key.position, forward, up, fov_y_radians, aspect, near_depth, far_depth, width,
                            height);
}

}  // namespace gnomon
