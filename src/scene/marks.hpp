// Which triangles stand for points and lines, which have no width of their own?
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace gnomon::detail {

struct Vertices;

/// An octahedron for each point, a closed bar of square section for each line.
inline constexpr std::uint64_t kPointTriangles = 8, kPointVertices = 6;
inline constexpr std::uint64_t kLineTriangles = 12, kLineVertices = 8;

/// Corner numbers, two for each line. `mode` is 1 (lines), 2 (loop) or 3 (strip).
[[nodiscard]] std::vector<std::uint32_t> line_list(int mode, std::span<const std::uint32_t> corners);

/// A width that shows such marks: half of the mean distance of points spread over a surface, at most a
/// fiftieth of their extent, and a 250th of it for lines. 0 where all of them are in one place.
[[nodiscard]] float guessed_width(std::span<const glm::vec3> positions,
                                  std::span<const std::uint32_t> corners, bool points);

/// Octahedra that are `width` across. Their vertices have the texture coordinates of their points.
[[nodiscard]] Vertices point_marks(const Vertices& of, std::span<const std::uint32_t> corners, float width,
                                   std::vector<std::uint32_t>& triangles);
/// Bars that are `width` thick, one for each pair of corners; none for a line without length.
[[nodiscard]] Vertices line_marks(const Vertices& of, std::span<const std::uint32_t> pairs, float width,
                                  std::vector<std::uint32_t>& triangles);

}  // namespace gnomon::detail
