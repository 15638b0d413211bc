// Light space as matrices.
#include "gnomon/light_space.hpp"

#include <glm/geometric.hpp>

namespace gnomon {

glm::dmat4 LightSpace::light_from_relative() const noexcept {
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i] = {frame.x[i], frame.y[i], frame.z[i], 0.0};
  if (!perspective) return m;
  for (int i = 0; i < 3; ++i) m[i] = {frame.x[i], frame.y[i], 0.0, -frame.z[i]};
  m[3] = {-apex.x, -apex.y, 1.0, apex.z};
  return m;
}

glm::dmat4 LightSpace::relative_from_light() const noexcept {
  const glm::dvec4 x(frame.x, 0.0), y(frame.y, 0.0), z(frame.z, 0.0);
  if (!perspective) return {x, y, z, glm::dvec4(0.0, 0.0, 0.0, 1.0)};
  const glm::dvec3 position = frame.x * apex.x + frame.y * apex.y + frame.z * apex.z;
  return {x, y, glm::dvec4(position, 1.0), -z};
}

}  // namespace gnomon
