// Which casters a map needs.
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/plan.hpp"

namespace gnomon {

std::size_t cull_casters(const ShadowMap& map, std::span<const Box> casters,
                         std::span<std::uint32_t> out) noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const Box& box = casters[i];
    if (box.empty()) continue;
    bool reaches = true;
    for (int k = 0; k < map.cull_plane_count && reaches; ++k) {
      const glm::dvec4& plane = map.cull_planes[static_cast<std::size_t>(k)];
      const glm::dvec3 farthest{plane.x > 0.0 ? box.max.x : box.min.x, plane.y > 0.0 ? box.max.y : box.min.y,
                                plane.z > 0.0 ? box.max.z : box.min.z};
      reaches = glm::dot(glm::dvec3(plane), farthest) + plane.w >= 0.0;
    }
    if (!reaches) continue;
    if (count < out.size()) out[count] = static_cast<std::uint32_t>(i);
    ++count;
  }
  return count;
}

}  // namespace gnomon
