// Which casters can shadow a body: the body swept towards the light.
#pragma once

#include <array>

#include "geometry/visible.hpp"
#include "gnomon/extend/body.hpp"

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
void sweep(const Polytope& body, const glm::dvec4& light, double margin_world, const glm::dvec3& eye_world,
           SweptBody& swept) noexcept;

}  // namespace gnomon
