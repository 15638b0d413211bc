// How keys and the mouse turn a camera in a window.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/scene/camera_path.hpp"

namespace gnomon::tool {

/// Turns the view by these angles, radians, short of straight up and down.
inline void turn(CameraKey& eye, double right, double up) {
  const glm::dvec3 look = eye.target - eye.position;
  const double length = glm::length(look), heading = std::atan2(look.x, -look.z) + right;
  constexpr double kSteepest = 1.55;
  const double pitch = std::clamp(std::atan2(look.y, std::hypot(look.x, look.z)) + up, -kSteepest, kSteepest);
  eye.target = eye.position + length * glm::dvec3(std::sin(heading) * std::cos(pitch), std::sin(pitch),
                                                  -std::cos(heading) * std::cos(pitch));
}

/// Moves the camera with what it looks at.
inline void move(CameraKey& eye, const glm::dvec3& step) {
  eye.position += step;
  eye.target += step;
}

}  // namespace gnomon::tool
