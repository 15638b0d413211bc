// Matrices from positions near the camera to the clip space that maps are drawn in.
#include "maps/drawn_maps.hpp"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "frame/frame_block.hpp"
#include "gnomon/shader.hpp"

namespace gnomon::render {

bool is_mirrored(const glm::mat4& clip_from_position) noexcept {
  return glm::determinant(glm::dmat4(clip_from_position)) > 0.0;
}

DrawnMaps drawn_maps(const ShadowPlan& plan, const glm::dvec3& camera_world, double step) noexcept {
  DrawnMaps drawn;
  drawn.origin_world = glm::round(camera_world / step) * step;
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const ShadowMap& map = plan.map[i];
    glm::dmat4 clip_from_position = map.clip_from_world;
    clip_from_position[3] = map.clip_from_world * glm::dvec4(drawn.origin_world, 1.0);
    drawn.map[i] = {glm::mat4(drawn_from_plan * clip_from_position), map.width, map.height,
                    shader_shape(map, drawn_from_plan), !map.shape->affine};
  }
  return drawn;
}

}  // namespace gnomon::render
