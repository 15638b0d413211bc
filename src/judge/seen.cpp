// Which surfaces does the camera see? What a capture knows of them, or the first hits of rays on boxes.
#include "judge/seen.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gnomon::judge {
namespace {

/// A view depth on a box, and the side there.
struct BoxHit {
  double depth = std::numeric_limits<double>::infinity();
  glm::dvec3 normal{0.0};
};

BoxHit hit_of(const Box& box, const glm::dvec3& origin, const glm::dvec3& ray, const Camera& camera) {
  const auto [enter, leave, enter_normal, leave_normal] = crossing_of(box, origin, ray);
  if (!(enter <= leave)) return {};
  if (enter >= camera.near_depth && enter <= camera.far_depth) return {enter, enter_normal};
  // From the inside of a room its walls are seen.
  if (enter < camera.near_depth && leave >= camera.near_depth && leave <= camera.far_depth)
    return {leave, leave_normal};
  return {};
}

SeenSurfaces first_hits(const Camera& camera, const std::vector<Box>& receivers) {
  SeenSurfaces seen;
  seen.guessed = true;
  for_each_ray(camera, [&](const glm::dvec2& pixel, const glm::dvec3& origin, const glm::dvec3& ray) {
    BoxHit nearest;
    for (const Box& box : receivers) {
      const BoxHit hit = hit_of(box, origin, ray, camera);
      if (hit.depth < nearest.depth) nearest = hit;
    }
    if (!std::isfinite(nearest.depth)) return;
    seen.points.push_back(origin + ray * nearest.depth);
    seen.normals.push_back(nearest.normal);
    seen.depths.push_back(nearest.depth);
    seen.pixels.push_back(pixel);
  });
  return seen;
}

}  // namespace

BoxCrossing crossing_of(const Box& box, const glm::dvec3& origin, const glm::dvec3& ray) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  BoxCrossing crossing{-kInfinity, kInfinity};
  for (int i = 0; i < 3; ++i) {
    if (ray[i] == 0.0) {
      if (origin[i] < box.min[i] || origin[i] > box.max[i]) return {kInfinity, -kInfinity};
      continue;
    }
    const double a = (box.min[i] - origin[i]) / ray[i], b = (box.max[i] - origin[i]) / ray[i];
    glm::dvec3 normal(0.0);
    normal[i] = ray[i] > 0.0 ? -1.0 : 1.0;
    if (std::min(a, b) > crossing.enter) {
      crossing.enter = std::min(a, b);
      crossing.enter_normal = normal;
    }
    if (std::max(a, b) < crossing.leave) {
      crossing.leave = std::max(a, b);
      crossing.leave_normal = normal;
    }
  }
  return crossing;
}

SeenSurfaces seen_surfaces(const Camera& camera, const std::vector<glm::dvec3>& points,
                           const std::vector<glm::dvec3>& normals) {
  SeenSurfaces seen;
  const CameraAxes axes = camera_axes(camera);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 offset = points[i] - camera.position;
    const double depth = glm::dot(offset, axes.forward), scale = camera.orthographic ? 1.0 : 1.0 / depth;
    if (!(depth >= camera.near_depth && depth <= camera.far_depth)) continue;
    const double across = (glm::dot(offset, axes.right) * scale - camera.left) / (camera.right - camera.left);
    const double down = (camera.top - glm::dot(offset, axes.up) * scale) / (camera.top - camera.bottom);
    if (!(across >= 0.0 && across <= 1.0 && down >= 0.0 && down <= 1.0)) continue;
    seen.points.push_back(points[i]);
    seen.depths.push_back(depth);
    seen.pixels.emplace_back(across * camera.width, down * camera.height);
    if (normals.empty()) continue;
    const bool away = glm::dot(normals[i], camera.orthographic ? axes.forward : offset) > 0.0;
    seen.normals.push_back(away ? -normals[i] : normals[i]);
  }
  return seen;
}

SeenSurfaces seen_surfaces(const CapturedFrame& frame, const CapturedScene& scene) {
  if (!scene.points.empty()) return seen_surfaces(frame.camera, scene.points, scene.normals);
  return first_hits(frame.camera, scene.receivers);
}

}  // namespace gnomon::judge
