// How long may pages keep the direction of a sun that turns? Until the shadow edges of visible points lie
// further from their true place, in screen pixels, than a bound.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "gnomon/pages.hpp"

namespace gnomon {
namespace {

/// Where a camera shows a point.
struct Screen {
  Camera camera;
  CameraAxes axes;

  explicit Screen(const Camera& c) noexcept : camera(c), axes(camera_axes(c)) {}
  /// Pixels; not a number behind the eye.
  [[nodiscard]] glm::dvec2 pixel(const glm::dvec3& point) const noexcept {
    const glm::dvec3 from_eye = point - camera.position;
    const double depth = glm::dot(from_eye, axes.forward);
    if (!camera.orthographic && !(depth > 0.0)) return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    const double scale = camera.orthographic ? 1.0 : 1.0 / depth;
    return {glm::dot(from_eye, axes.right) * scale / (camera.right - camera.left) * camera.width,
            glm::dot(from_eye, axes.up) * scale / (camera.top - camera.bottom) * camera.height};
  }
  [[nodiscard]] glm::dvec3 to_eye(const glm::dvec3& point) const noexcept {
    return camera.orthographic ? -axes.forward : glm::normalize(camera.position - point);
  }
};

/// How far the farthest place in the box lies along a ray, or 0 where the ray misses it.
double farthest_along(const Box& box, const glm::dvec3& from, const glm::dvec3& direction) noexcept {
  double begin = 0.0, end = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (from[axis] < box.min[axis] || from[axis] > box.max[axis]) return 0.0;
      continue;
    }
    const double a = (box.min[axis] - from[axis]) / direction[axis];
    const double b = (box.max[axis] - from[axis]) / direction[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end ? end : 0.0;
}

}  // namespace

HeldSun hold_sun(const View& view, const glm::dvec3& held, const glm::dvec3& sun, const Box& casters,
                 double most_pixels, double least_light_sine) noexcept {
  HeldSun result{sun, 0.0, 0.0, 0};
  const glm::dvec3 was = glm::normalize(held), is = glm::normalize(sun);
  // False of what is not a number, and of a direction without length.
  const bool has_bounds =
      casters.min.x <= casters.max.x && casters.min.y <= casters.max.y && casters.min.z <= casters.max.z;
  const bool usable = has_bounds && glm::dot(was, is) > 0.0 && most_pixels > 0.0 &&
                      (view.normals_world.empty() || view.normals_world.size() == view.points_world.size());
  if (!usable || view.points_world.empty()) return result;
  const Screen screen(view.camera);
  for (std::size_t i = 0; i < view.points_world.size(); ++i) {
    const glm::dvec3& point = view.points_world[i];
    const glm::dvec3 normal =
        view.normals_world.empty() ? glm::normalize(screen.to_eye(point) - was) : view.normals_world[i];
    const double before = -glm::dot(normal, was), after = -glm::dot(normal, is);
    if (before < least_light_sine || after < least_light_sine) {
      ++result.points_capped;
      continue;
    }
    const double distance = farthest_along(casters, point, -was);
    // What shadows the point from there is shadowed here now, on the surface's plane.
    const glm::dvec3 moved = point + distance * (is * (before / after) - was);
    const double error = glm::distance(screen.pixel(moved), screen.pixel(point));
    if (!(error <= most_pixels)) {
      result.turned_pixels = error;
      return result;
    }
    result.error_pixels = std::max(result.error_pixels, error);
  }
  result.direction = held;
  return result;
}

}  // namespace gnomon
