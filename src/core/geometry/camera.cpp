// How a camera's numbers become axes and matrices.
#include "gnomon/camera.hpp"

#include "gnomon/view.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {

Camera::operator View() const noexcept {
  return {.camera = *this};
}

Camera perspective_camera(const glm::dvec3& position, const glm::dvec3& forward, const glm::dvec3& up,
                          double fov_y_radians, double aspect, double near_depth, double far_depth, int width,
                          int height) noexcept {
  constexpr double kPi = 3.141592653589793;
  const bool is_angle = fov_y_radians > 0.0 && fov_y_radians < kPi;
  const double tan_y =
      is_angle ? elementary::tan(0.5 * fov_y_radians) : std::numeric_limits<double>::quiet_NaN();
  const double tan_x = tan_y * aspect;
  return {position, forward, up, false, -tan_x, tan_x, -tan_y, tan_y, near_depth, far_depth, width, height};
}

Camera orthographic_camera(const glm::dvec3& position, const glm::dvec3& forward, const glm::dvec3& up,
                           double height_world, double aspect, double near_depth, double far_depth, int width,
                           int height) noexcept {
  const double y = 0.5 * height_world;
  const double x = y * aspect;
  return {position, forward, up, true, -x, x, -y, y, near_depth, far_depth, width, height};
}

CameraAxes camera_axes(const Camera& camera) noexcept {
  const glm::dvec3 forward = safe_normalize(camera.forward, {0.0, 0.0, -1.0});
  const glm::dvec3 up_hint = safe_normalize(camera.up, {0.0, 1.0, 0.0});
  glm::dvec3 right = glm::cross(forward, up_hint);
  // Below this sine the hint's own rounding turns the image; a fixed axis does not.
  constexpr double kParallelSine = 1e-9;
  if (!(glm::dot(right, right) > kParallelSine * kParallelSine))
    right = glm::cross(forward, least_aligned_axis(forward));
  right = safe_normalize(right, {1.0, 0.0, 0.0});
  return {right, glm::cross(right, forward), forward};
}

Camera with_finite_far(const Camera& camera, const Boxes& boxes) noexcept {
  Camera finite = camera;
  if (camera.far_depth > std::numeric_limits<double>::max()) finite.far_depth = depth_in_reach(camera, boxes);
  return finite;
}

glm::dmat4 view_from_world(const Camera& camera) noexcept {
  const CameraAxes axes = camera_axes(camera);
  glm::dmat4 m(1.0);
  const glm::dvec3 rows[3] = {axes.right, axes.up, -axes.forward};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) m[column][row] = rows[row][column];
    m[3][row] = -glm::dot(rows[row], camera.position);
  }
  return m;
}

glm::dmat4 clip_from_view(const Camera& camera) noexcept {
  const double n = camera.near_depth, f = camera.far_depth;
  const double width = camera.right - camera.left, height = camera.top - camera.bottom;
  const bool endless = std::isinf(f);
  const double sum_ratio = endless ? 1.0 : (f + n) / (f - n);
  glm::dmat4 m(0.0);
  m[0][0] = 2.0 / width;
  m[1][1] = 2.0 / height;
  if (camera.orthographic) {
    m[2][2] = -2.0 / (f - n);
    m[3] = {-(camera.right + camera.left) / width, -(camera.top + camera.bottom) / height, -sum_ratio, 1.0};
  } else {
    m[2] = {(camera.right + camera.left) / width, (camera.top + camera.bottom) / height, -sum_ratio, -1.0};
    m[3][2] = -2.0 * (endless ? 1.0 : f / (f - n)) * n;
  }
  return m;
}

}  // namespace gnomon
