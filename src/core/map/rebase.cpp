// A kept map's matrix for another eye.
#include <glm/matrix.hpp>

#include "gnomon/reuse.hpp"

namespace gnomon {

ShadowMap rebased(const ShadowMap& map, const glm::dvec3& new_origin) noexcept {
  ShadowMap moved = map;
  glm::dmat4 from_relative = map.clip_from_world;
  from_relative[3] = map.clip_from_world * glm::dvec4(new_origin, 1.0);
  moved.clip_from_camera_relative = glm::mat4(from_relative);
  return moved;
}

}  // namespace gnomon
