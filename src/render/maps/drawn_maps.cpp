// Matrices from positions near the camera to the clip space that maps are drawn in.
#include "maps/drawn_maps.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "frame/frame_block.hpp"
#include "gnomon/shader.hpp"

namespace gnomon::render {

namespace {

/// Points of a parallel light's ray have one x, y and w. So 1 / w is a plane over ndc.
glm::vec3 inverse_w(const glm::dmat4& clip_from_position) noexcept {
  const glm::dmat4 rows = glm::transpose(clip_from_position);
  const glm::dvec3 x(rows[0]), y(rows[1]), w(rows[3]);
  // All three lie across the ray: c.x x + c.y y + c.z w = 0.
  const glm::dvec3 ray = glm::normalize(glm::cross(x, y));
  const auto area = [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(glm::cross(a, b), ray); };
  const glm::dvec3 c(area(y, w), area(w, x), area(x, y));
  return glm::vec3(c / glm::dot(c, glm::dvec3(rows[0].w, rows[1].w, rows[3].w)));
}

}  // namespace

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
    if (map.light_world.w == 0.0) drawn.map[i].inverse_w = inverse_w(drawn_from_plan * clip_from_position);
  }
  return drawn;
}

}  // namespace gnomon::render
