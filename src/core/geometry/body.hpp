// The part of a body between two parallel planes, or inside one that cuts it.
#pragma once

#include <glm/geometric.hpp>

#include "gnomon/extend/body.hpp"

namespace gnomon {

/// Distance at which a whole body beyond a plane may be its rounding, by that of its planes: clip keeps it.
/// World units.
[[nodiscard]] double clip_rounding(const Polytope& body) noexcept;

/// Keeps the part with `begin` <= dot(normal, p) <= `end`: as clip by one plane after the other, in less
/// time. Either end may be infinite; `normal` is a unit vector.
void clip_to_slab(Polytope& body, const glm::dvec3& normal, double begin, double end) noexcept;

/// The part of `body` inside `plane` where a vertex lies outside; empty where none does.
[[nodiscard]] inline Polytope part_inside(const Polytope& body, const Plane& plane) noexcept {
  Polytope part;
  for (const Polytope::Vertex& v : body.vertices()) {
    if (!(glm::dot(plane.normal, v.position) + plane.offset < 0.0)) continue;
    part = body;
    clip(part, plane);
    break;
  }
  return part;
}

}  // namespace gnomon
