// How do strips, fans and plain lists become triangles, and what normals do triangles have that name none?
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace gnomon::detail {

/// Corner numbers, three per triangle, wound as glTF winds them. `mode` is 4 (list), 5 (strip) or 6 (fan).
/// Triangles of a strip or fan that name a corner twice are left out: they only stitch strips together.
[[nodiscard]] std::vector<std::uint32_t> triangle_list(int mode, std::vector<std::uint32_t> corners);

/// The unit normal of a counter-clockwise triangle; +Y for one without area.
[[nodiscard]] glm::vec3 face_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Makes every normal unit length. One that is zero or not finite becomes the area-weighted mean of its
/// triangles, whose corners count from `first`. Returns how many were repaired.
std::size_t repair_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles,
                           std::span<glm::vec3> normals, std::uint32_t first = 0);

}  // namespace gnomon::detail
