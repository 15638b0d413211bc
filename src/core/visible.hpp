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
[[nodiscard]] Box visible_bounds(const Polytope& region, const Boxes& boxes,
                                 const glm::dvec3& origin) noexcept;

/// What of the casters reaches a region: the smallest box round those that do, and how far towards `up` they
/// go.
struct CasterReach {
  Box bounds;  ///< relative to the origin
  double top;  ///< largest dot(up, p) of any of them; -infinity where there are none
  bool any;
};
/// At most 32 planes. Without planes, of all casters.
[[nodiscard]] CasterReach casters_inside(std::span<const Plane> planes, const Boxes& casters,
                                         const glm::dvec3& origin, const glm::dvec3& up) noexcept;

/// Whether any box holds the point, both in world space.
[[nodiscard]] bool in_some_box(const Boxes& boxes, const glm::dvec3& point_world) noexcept;

/// Least dot(toward, apex - p) over the parts of the casters inside the planes (at most 32); infinity where
/// there are none. Exact but where more than 64 casters have a corner nearer than that: then not more than
/// it.
[[nodiscard]] double nearest_inside(std::span<const Plane> planes, const Boxes& casters,
                                    const glm::dvec3& origin, const glm::dvec3& toward,
                                    const glm::dvec3& apex) noexcept;

}  // namespace gnomon
