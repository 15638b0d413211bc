// Which part of the scene's boxes a convex region holds.
#include "geometry/visible.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

bool contains(const Box& outer, const Box& inner) noexcept {
  return outer.min.x <= inner.min.x && outer.min.y <= inner.min.y && outer.min.z <= inner.min.z &&
         outer.max.x >= inner.max.x && outer.max.y >= inner.max.y && outer.max.z >= inner.max.z;
}

/// Largest dot(direction, p) over the box.
double reach(const Box& box, const glm::dvec3& direction) noexcept {
  return (direction.x > 0.0 ? box.max.x : box.min.x) * direction.x +
         (direction.y > 0.0 ? box.max.y : box.min.y) * direction.y +
         (direction.z > 0.0 ? box.max.z : box.min.z) * direction.z;
}

}  // namespace

Side side_of(const Plane& plane, const Box& box) noexcept {
  // A box that touches is across: rounding must not lose a flat receiver that lies in the plane.
  constexpr double kTouching = 1e-12;
  const double inward = reach(box, plane.normal), outward = reach(box, -plane.normal);
  if (inward + plane.offset < -kTouching * (std::abs(inward) + std::abs(plane.offset))) return Side::outside;
  return plane.offset - outward >= 0.0 ? Side::inside : Side::across;
}

Box visible_bounds(const Polytope& region, std::span<const Box> boxes, const glm::dvec3& origin) noexcept {
  Box all;
  if (boxes.size() == 1) return boxes[0].empty() ? all : relative_to(boxes[0], origin);
  for (const Box& world : boxes) {
    if (world.empty()) continue;
    const Box box = relative_to(world, origin);
    if (!all.empty() && contains(all, box)) continue;
    Side side = Side::inside;
    for (int f = 0; f < region.face_count && side != Side::outside; ++f) {
      const Side here = side_of(region.plane[static_cast<std::size_t>(f)], box);
      if (here != Side::inside) side = here;
    }
    if (side == Side::inside) {
      all.extend(box);
    } else if (side == Side::across) {
      Polytope part = region;
      clip(part, box);
      all.extend(bounds_of(part));
    }
  }
  return all;
}

CasterReach casters_inside(std::span<const Plane> planes, std::span<const Box> casters,
                           const glm::dvec3& origin, const glm::dvec3& up) noexcept {
  CasterReach result{{}, -std::numeric_limits<double>::infinity(), 0};
  for (const Box& world : casters) {
    if (world.empty()) continue;
    const Box box = relative_to(world, origin);
    bool reaches = true;
    for (std::size_t i = 0; i < planes.size() && reaches; ++i)
      reaches = side_of(planes[i], box) != Side::outside;
    if (!reaches) continue;
    ++result.count;
    result.bounds.extend(box);
    result.top = max_of(result.top, reach(box, up));
  }
  return result;
}

}  // namespace gnomon
