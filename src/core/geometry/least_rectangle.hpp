// Which way to turn a rectangle so that it is the smallest round some points.
#pragma once

#include <glm/vec2.hpp>
#include <span>

namespace gnomon {

/// The unit direction of the side nearest to x of the least-area rectangle round at most kMaxVertices points;
/// (1, 0) for points on a line along it, for a single point and for none.
[[nodiscard]] glm::dvec2 least_rectangle_side(std::span<const glm::dvec2> points) noexcept;

}  // namespace gnomon
