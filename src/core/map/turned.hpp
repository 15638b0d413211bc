// Which way to turn a map's rectangle so that it is the smallest round its body.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "gnomon/extend/warp.hpp"

namespace gnomon {

/// The choice with its rectangle turned to the least area, where that lowers the objective.
[[nodiscard]] WarpChoice turned_to_least_area(const WarpInput& in, const WarpChoice& choice) noexcept;

/// The unit direction of the side nearest to x of the least-area rectangle round at most kMaxVertices points;
/// (1, 0) for points on a line along it, for a single point and for none.
[[nodiscard]] glm::dvec2 least_rectangle_side(std::span<const glm::dvec2> points) noexcept;

}  // namespace gnomon
