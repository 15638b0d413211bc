// Rows of a matrix, a matrix for points that count from another origin, and a map's texels per world unit.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gnomon/extend/shape.hpp"

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

/// d(texel)/d(world) at a point: gradients of the texel's x and y, and the point's clip coordinates.
struct TexelJacobian {
  glm::dvec3 x, y;
  double ndc_x, ndc_y, w;
};

/// w of a point; another order of the sum may give 0 where this is not.
[[nodiscard]] inline double w_at(const glm::dmat4& m, const glm::dvec3& p) noexcept {
  return m[0][3] * p.x + m[1][3] * p.y + m[2][3] * p.z + m[3][3];
}

[[nodiscard]] inline TexelJacobian texel_jacobian(const glm::dmat4& m, const TexelGrid& grid,
                                                  const glm::dvec3& p) noexcept {
  const double w = w_at(m, p);
  const double inverse = 1.0 / w;
  const double x = (m[0][0] * p.x + m[1][0] * p.y + m[2][0] * p.z + m[3][0]) * inverse;
  const double y = (m[0][1] * p.x + m[1][1] * p.y + m[2][1] * p.z + m[3][1]) * inverse;
  const glm::dmat2 d = grid.place({x, y}).texel_from_ndc * inverse;
  const glm::dvec3 over_x{m[0][0] - x * m[0][3], m[1][0] - x * m[1][3], m[2][0] - x * m[2][3]};
  const glm::dvec3 over_y{m[0][1] - y * m[0][3], m[1][1] - y * m[1][3], m[2][1] - y * m[2][3]};
  return {over_x * d[0][0] + over_y * d[1][0], over_x * d[0][1] + over_y * d[1][1], x, y, w};
}

}  // namespace gnomon
