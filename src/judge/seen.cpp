// Which surfaces does the camera see? What a capture knows of them, or the first hits of rays on boxes.
#include "judge/seen.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gnomon::judge {
namespace {

/// Where a ray enters a box, or leaves it where it begins inside; infinite where it misses.
struct BoxHit {
  double t = std::numeric_limits<double>::infinity();
  glm::dvec3 normal{0.0};
};

BoxHit hit_of(const Box& box, const glm::dvec3& origin, const glm::dvec3& ray, double least, double most) {
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  glm::dvec3 enter_normal(0.0), leave_normal(0.0);
  for (int i = 0; i < 3; ++i) {
    if (ray[i] == 0.0) {
      if (origin[i] < box.min[i] || origin[i] > box.max[i]) return {};
      continue;
    }
    const double a = (box.min[i] - origin[i]) / ray[i], b = (box.max[i] - origin[i]) / ray[i];
    glm::dvec3 normal(0.0);
    normal[i] = ray[i] > 0.0 ? -1.0 : 1.0;
    if (std::min(a, b) > enter) {
      enter = std::min(a, b);
      enter_normal = normal;
    }
    if (std::max(a, b) < leave) {
      leave = std::max(a, b);
      leave_normal = normal;
    }
  }
  if (!(enter <= leave)) return {};
  if (enter >= least && enter <= most) return {enter, enter_normal};
  // From the inside of a room its walls are seen.
  if (enter < least && leave >= least && leave <= most) return {leave, leave_normal};
  return {};
}

SeenSurfaces first_hits(const CapturedFrame& frame, const CapturedScene& scene) {
  SeenSurfaces seen;
  seen.guessed = true;
  const Camera& camera = frame.camera;
  const CameraAxes axes = camera_axes(camera);
  for (int row = 0; row < kRayRows; ++row) {
    for (int column = 0; column < kRayColumns; ++column) {
      const double across = (column + 0.5) / kRayColumns, down = (row + 0.5) / kRayRows;
      const glm::dvec3 aside = axes.right * (camera.left + (camera.right - camera.left) * across) +
                               axes.up * (camera.top + (camera.bottom - camera.top) * down);
      const glm::dvec3 origin = camera.orthographic ? camera.position + aside : camera.position;
      // Its length is that of one unit of depth.
      const glm::dvec3 ray = camera.orthographic ? axes.forward : axes.forward + aside;
      BoxHit nearest;
      for (const Box& box : scene.receivers) {
        if (box.empty()) continue;
        const BoxHit hit = hit_of(box, origin, ray, camera.near_depth, camera.far_depth);
        if (hit.t < nearest.t) nearest = hit;
      }
      if (!std::isfinite(nearest.t)) continue;
      seen.points.push_back(origin + ray * nearest.t);
      seen.normals.push_back(nearest.normal);
      seen.depths.push_back(nearest.t);
      seen.pixels.emplace_back(across * camera.width, down * camera.height);
    }
  }
  return seen;
}

}  // namespace

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
  return first_hits(frame, scene);
}

}  // namespace gnomon::judge
