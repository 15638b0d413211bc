// Axes across the light: along the view where a warp wants them, fixed where a grid must not move.
#include "geometry/light_axes.hpp"
#include "gnomon/extend/light_space.hpp"

#include <cstddef>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

constexpr double kParallelSine = 1e-3;

LightFrame frame_from(const glm::dvec3& light_direction, const glm::dvec3& along) noexcept {
  LightFrame frame;
  frame.z = -light_direction;
  frame.y =
      safe_normalize(along - light_direction * glm::dot(along, light_direction), least_aligned_axis(frame.z));
  frame.x = safe_normalize(glm::cross(frame.y, frame.z), {1.0, 0.0, 0.0});
  frame.y = glm::cross(frame.z, frame.x);
  return frame;
}

}  // namespace

LightFrame frame_along(const glm::dvec3& light_direction, const glm::dvec3& along) noexcept {
  return frame_from(light_direction, along);
}

LightFrame view_aligned_frame(const glm::dvec3& light_direction, const CameraAxes& axes) noexcept {
  const glm::dvec3 across = glm::cross(axes.forward, light_direction);
  const bool parallel = glm::dot(across, across) < kParallelSine * kParallelSine;
  return frame_from(light_direction, parallel ? axes.up : axes.forward);
}

LightFrame fixed_frame(const glm::dvec3& light_direction) noexcept {
  return frame_from(light_direction, least_aligned_axis(light_direction));
}

LightFrame grid_frame(const glm::dvec3& light_direction) noexcept {
  const LightFrame along = fixed_frame(light_direction);
  // Of the flights of bindings/js/test/flights.js, 14 degrees leave 4 to 7 % fewer misclassified pixels in
  // the street, and 32 degrees 14 to 18 % fewer under the low sun.
  constexpr double kCosine = 0.92387953251128674, kSine = 0.38268343236508977;
  // Of a mirrored world the other way round, so that its texels are the same: not at all where the light lies
  // across an axis, and is its own mirror image.
  const glm::dvec3& d = light_direction;
  if (d.x == 0.0 || d.y == 0.0 || d.z == 0.0) return along;
  const bool even = ((d.x < 0.0) != (d.y < 0.0)) == (d.z < 0.0);
  const double sine = even ? kSine : -kSine;
  return {along.x * kCosine + along.y * sine, along.y * kCosine - along.x * sine, along.z};
}

LightFrame face_frame(const LightFrame& cube, int face) noexcept {
  const glm::dvec3 axis[3] = {cube.x, cube.y, cube.z};
  const auto k = static_cast<std::size_t>(face / 2);
  const glm::dvec3 z = axis[k] * (face % 2 == 0 ? -1.0 : 1.0), y = axis[(k + 2) % 3];
  return {glm::cross(y, z), y, z};
}

glm::dmat4 LightSpace::light_from_relative() const noexcept {
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i] = {frame.x[i], frame.y[i], frame.z[i], 0.0};
  if (!perspective) return m;
  for (int i = 0; i < 3; ++i) m[i] = {frame.x[i], frame.y[i], 0.0, -frame.z[i]};
  m[3] = {-apex.x, -apex.y, 1.0, apex.z};
  return m;
}

glm::dmat4 LightSpace::relative_from_light() const noexcept {
  const glm::dvec4 x(frame.x, 0.0), y(frame.y, 0.0), z(frame.z, 0.0);
  if (!perspective) return {x, y, z, glm::dvec4(0.0, 0.0, 0.0, 1.0)};
  const glm::dvec3 position = frame.x * apex.x + frame.y * apex.y + frame.z * apex.z;
  return {x, y, glm::dvec4(position, 1.0), -z};
}

}  // namespace gnomon
