// The part of a body between two parallel planes.
#pragma once

#include "gnomon/body.hpp"

namespace gnomon {

/// Keeps the part with `begin` <= dot(normal, p) <= `end`: as clip by one plane after the other, in less
/// time. Either end may be infinite; `normal` is a unit vector.
void clip_to_slab(Polytope& body, const glm::dvec3& normal, double begin, double end) noexcept;

}  // namespace gnomon
