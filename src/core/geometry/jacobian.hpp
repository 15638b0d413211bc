// Derivatives of the map: texels per world unit at a point.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gnomon {

/// d(texel)/d(world) at a point: gradients of the texel's x and y, and the point's clip coordinates.
struct TexelJacobian {
  glm::dvec3 x, y;
  double ndc_x, ndc_y, w;
};

[[nodiscard]] inline TexelJacobian texel_jacobian(const glm::dmat4& m, int width, int height,
                                                  const glm::dvec3& p) noexcept {
  const double w = m[0][3] * p.x + m[1][3] * p.y + m[2][3] * p.z + m[3][3];
  const double inverse = 1.0 / w;
  const double x = (m[0][0] * p.x + m[1][0] * p.y + m[2][0] * p.z + m[3][0]) * inverse;
  const double y = (m[0][1] * p.x + m[1][1] * p.y + m[2][1] * p.z + m[3][1]) * inverse;
  const double sx = 0.5 * width * inverse, sy = 0.5 * height * inverse;
  return {{(m[0][0] - x * m[0][3]) * sx, (m[1][0] - x * m[1][3]) * sx, (m[2][0] - x * m[2][3]) * sx},
          {(m[0][1] - y * m[0][3]) * sy, (m[1][1] - y * m[1][3]) * sy, (m[2][1] - y * m[2][3]) * sy},
          x,
          y,
          w};
}

}  // namespace gnomon
