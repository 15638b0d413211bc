// Rows of a matrix, and a matrix for points that count from another origin.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gnomon {

[[nodiscard]] inline glm::dvec4 row_of(const glm::dmat4& m, int row) noexcept {
  return {m[0][row], m[1][row], m[2][row], m[3][row]};
}

/// What `m` does to a point, as a matrix over the point less `origin`.
[[nodiscard]] inline glm::dmat4 counted_from(const glm::dmat4& m, const glm::dvec3& origin) noexcept {
  glm::dmat4 moved = m;
  moved[3] = m * glm::dvec4(origin, 1.0);
  return moved;
}

}  // namespace gnomon
