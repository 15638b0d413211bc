// Which part of the scene's boxes a convex region holds.
#pragma once

#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/extend/body.hpp"

namespace gnomon {

[[nodiscard]] inline Box relative_to(const Box& box, const glm::dvec3& origin) noexcept {
  return {box.min - origin, box.max - origin};
}

/// The smallest box round the parts of `boxes` (world space) inside `region`; `region` and the result are
/// relative to `origin`. A single box that holds anything is returned whole: the caller clips by it anyway.
[[nodiscard]] Box visible_bounds(const Polytope& region, const Boxes& boxes,
                                 const glm::dvec3& origin) noexcept;

/// Whether more than one box holds anything.
[[nodiscard]] bool several(const Boxes& boxes) noexcept;

/// For a part of a region that visible_bounds has clipped: clips it by the bounds of what it holds itself,
/// which are smaller where there are several boxes.
void clip_part(Polytope& part, const Boxes& boxes, const glm::dvec3& origin) noexcept;

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

/// The view depth that no box lies beyond, however the camera turns: the distance of the farthest corner of
/// their bounds, rounded up as with_finite_far says. `aside`: how far an eye may be off the camera's.
[[nodiscard]] double depth_in_reach(const Camera& camera, const Boxes& boxes, double aside = 0.0) noexcept;

/// Whether any box holds the point, both in world space.
[[nodiscard]] bool in_some_box(const Boxes& boxes, const glm::dvec3& point_world) noexcept;

/// How near to a local light boxes come.
struct NearBoxes {
  double nearest;  ///< distance along the light's axis; infinity where there is no box
  int too_near =
      0;  ///< boxes nearer than the least distance asked for, which do not count: the light is at them
};
/// Least dot(toward, apex - p) over the parts of the boxes inside the planes (at most 32) that is at least
/// `least`; the planes hold `body`, the light, and little more. Exact but where more than 64 boxes have a
/// corner nearer than that: then not more than it.
[[nodiscard]] NearBoxes nearest_inside(std::span<const Plane> planes, const Polytope& body,
                                       const Boxes& boxes, const glm::dvec3& origin, const glm::dvec3& toward,
                                       const glm::dvec3& apex, double least) noexcept;

}  // namespace gnomon
