// Which part of the scene's boxes a convex region holds.
#pragma once

#include <span>

#include "gnomon/body.hpp"
#include "gnomon/bounds.hpp"

namespace gnomon {

[[nodiscard]] inline Box relative_to(const Box& box, const glm::dvec3& origin) noexcept {
  return {box.min - origin, box.max - origin};
}

/// How a box lies to a plane.
enum class Side : std::uint8_t { outside, across, inside };
[[nodiscard]] Side side_of(const Plane& plane, const Box& box) noexcept;

/// The smallest box round the parts of `boxes` (world space) inside `region`; `region` and the result are
/// relative to `origin`. A single box is returned whole: the caller clips by it anyway.
[[nodiscard]] Box visible_bounds(const Polytope& region, std::span<const Box> boxes,
                                 const glm::dvec3& origin) noexcept;

/// What of the casters reaches a region: the smallest box round those that do, and how far towards `up` they
/// go.
struct CasterReach {
  Box bounds;  ///< relative to the origin
  double top;  ///< largest dot(up, p) of any of them; -infinity where there are none
  int count;
};
[[nodiscard]] CasterReach casters_inside(std::span<const Plane> planes, std::span<const Box> casters,
                                         const glm::dvec3& origin, const glm::dvec3& up) noexcept;

}  // namespace gnomon
