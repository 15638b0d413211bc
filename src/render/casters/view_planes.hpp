// Which boxes lie beside a camera's view?
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"

namespace gnomon::render {

struct ViewPlane {
  glm::dvec3 normal;
  double offset;
};

inline constexpr std::size_t kViewSides = 4;  ///< of view_planes(), which come first

/// The camera's side planes and its near and far plane, relative to its position, pointing inward.
[[nodiscard]] inline std::array<ViewPlane, 6> view_planes(const Camera& camera,
                                                          const CameraAxes& axes) noexcept {
  const auto side = [&](const glm::dvec3& axis, double edge, double sign) {
    return camera.orthographic ? ViewPlane{sign * axis, -sign * edge}
                               : ViewPlane{sign * (axis - edge * axes.forward), 0.0};
  };
  return {side(axes.right, camera.left, 1.0),          side(axes.right, camera.right, -1.0),
          side(axes.up, camera.bottom, 1.0),           side(axes.up, camera.top, -1.0),
          ViewPlane{axes.forward, -camera.near_depth}, ViewPlane{-axes.forward, camera.far_depth}};
}

/// `origin`: the camera's position.
[[nodiscard]] inline bool wholly_outside(const Box& box, const glm::dvec3& origin,
                                         const ViewPlane& plane) noexcept {
  double reach = plane.offset;
  for (int c = 0; c < 3; ++c) {
    const double low = box.min[c] - origin[c], high = box.max[c] - origin[c];
    reach += std::max(plane.normal[c] * low, plane.normal[c] * high);
  }
  return reach < 0.0;
}

}  // namespace gnomon::render
