// Where does the eye stand to see one object?
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/bounds.hpp"
#include "gnomon/scene/camera_path.hpp"

namespace gnomon::tool::view {

/// Comes so near to an object, along the present view, that it fills the image; `half_angle`: the image's
/// smaller one, radians. An object that surrounds the eye, or is far larger than its distance, is a place to
/// come to: half of the way to `point` on it.
inline void frame(CameraKey& eye, const Box& object, const glm::dvec3& point, double half_angle) {
  constexpr double kLarge = 4.0, kRoom = 1.1;
  const glm::dvec3 forward = glm::normalize(eye.target - eye.position);
  const glm::dvec3 middle = (object.min + object.max) * 0.5;
  const double radius = 0.5 * glm::length(object.max - object.min), away = glm::length(point - eye.position);
  const bool surrounds = glm::length(middle - eye.position) < radius;
  if (surrounds || radius > kLarge * away || !(radius > 0.0)) {
    eye = {point - forward * (0.5 * away), point};
    return;
  }
  eye = {middle - forward * (kRoom * radius / std::sin(half_angle)), middle};
}

/// By how much an orthographic picture grows so that an object fills it; `half_edge`: half of its smaller
/// edge, world units. It shrinks by half at an object that is larger.
[[nodiscard]] inline double framed_share(const Box& object, double half_edge) {
  constexpr double kRoom = 1.1, kNearer = 0.5;
  const double share = kRoom * 0.5 * glm::length(object.max - object.min) / half_edge;
  return share > 0.0 && share < 1.0 ? share : kNearer;
}

}  // namespace gnomon::tool::view
