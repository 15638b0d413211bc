// Which matrix are a translation, a rotation and a scale?
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gnomon::detail {

/// Scaled first, then turned, then moved. A rotation of no length, or of one that is not finite, is no turn.
[[nodiscard]] inline glm::dmat4 composed(const glm::dvec3& translation, const glm::dquat& q,
                                         const glm::dvec3& scale) noexcept {
  glm::dmat4 out(1.0);
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (length > 0.0 && std::isfinite(length)) out = glm::mat4_cast(q / length);
  for (int c = 0; c < 3; ++c) out[c] *= scale[c];
  out[3] = glm::dvec4(translation, 1.0);
  return out;
}

}  // namespace gnomon::detail
