// Which casters can shadow a body: the body swept towards the light, and the casters inside.
#pragma once

#include <array>

#include "geometry/visible.hpp"
#include "gnomon/body.hpp"

namespace gnomon {

/// Planes round everything between the light and a body, relative to the camera.
struct SweptBody {
  std::array<Plane, kMaxCullPlanes> plane;
  int plane_count = 0;
  [[nodiscard]] std::span<const Plane> planes() const noexcept {
    return {plane.data(), static_cast<std::size_t>(plane_count)};
  }
};
/// `light`: relative to the camera, w = 0 for the direction towards parallel light. All planes are moved out
/// by `margin_world`, so that casters which only a filter's kernel reaches are kept, and by the rounding of
/// positions this far from the world's origin.
[[nodiscard]] SweptBody sweep(const Polytope& body, const glm::dvec4& light, double margin_world,
                              const glm::dvec3& eye_world) noexcept;

/// How near to a local light boxes come inside a region.
struct NearBoxes {
  int count = 0;     ///< boxes that reach the region
  double nearest;    ///< distance along the axis of the nearest one; infinity where there is none
  int too_near = 0;  ///< boxes that reach nearer than `least`: the light is in or at them
};
/// `axis`: unit, relative to the world, the way distance grows; `apex` relative to `origin`. Boxes nearer
/// than `least` count with `stand_in`.
[[nodiscard]] NearBoxes nearest_boxes(std::span<const Plane> planes, std::span<const Box> boxes,
                                      const glm::dvec3& origin, const glm::dvec3& apex,
                                      const glm::dvec3& axis, double least, double stand_in) noexcept;

}  // namespace gnomon
