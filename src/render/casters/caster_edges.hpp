// Which edges of a caster can be its outline in a shadow map?
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace gnomon::render {

/// The edges of some triangles, four indices each: the corner opposite of one triangle, both ends, and the
/// corner opposite of the other triangle. Corners at one position are one corner. An edge of one triangle
/// alone has that triangle's corner twice, and so has one of three and more: it counts as an outline from
/// everywhere. Triangles without area have no edges. Indices beyond `positions` are not allowed.
[[nodiscard]] std::vector<std::uint32_t> caster_edges(std::span<const glm::vec3> positions,
                                                      std::span<const std::uint32_t> triangles);

}  // namespace gnomon::render
