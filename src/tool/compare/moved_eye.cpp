// The shadow of one frame looked up at the points of the next.
#include "moved_eye.hpp"

#include <glm/geometric.hpp>

#include "gnomon/motion.hpp"

namespace gnomon::tool {

ShadowPlan moved_eye(ShadowPlan plan, const Camera& before, const Camera& after) noexcept {
  const double moved = glm::dot(after.position - before.position, camera_axes(after).forward);
  plan.origin_world = after.position;
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    ShadowMap& map = plan.map[i];
    map = rebased(map, after.position);
    map.depth_begin -= moved;
    map.depth_end -= moved;
  }
  return plan;
}

}  // namespace gnomon::tool
