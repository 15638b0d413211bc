// Which casters a map needs.
// Based on: Assarsson, Moeller, "Optimized View Frustum Culling Algorithms for Bounding Boxes", 2000 (the
// plane that the last boxes were outside of is asked first).
#include <algorithm>
#include <utility>

#include "gnomon/plan.hpp"
#include "lanes/casters.hpp"

namespace gnomon {

std::size_t cull_casters(const ShadowMap& map, std::span<const Box> casters,
                         std::span<std::uint32_t> out) noexcept {
  // A copy, since the order changes: what eight boxes were outside of, the next in the list often are, too.
  std::array<glm::dvec4, kMaxCullPlanes> planes = map.cull_planes;
  const auto plane_count = static_cast<std::size_t>(map.cull_plane_count);
  CasterBlock block;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < casters.size(); begin += kLanes) {
    const std::size_t filled = std::min(kLanes, casters.size() - begin);
    block.occupied = 0;
    for (std::size_t lane = 0; lane < filled; ++lane) set_lane(block, lane, casters[begin + lane]);
    std::uint32_t kept = block.occupied;
    for (std::size_t k = 0; k < plane_count && kept != 0; ++k) {
      kept &= ~lanes<Ask::outside>(planes[k], block);
      if (kept == 0) std::swap(planes[k], planes[0]);
    }
    for_each_bit(kept, [&](std::size_t lane) {
      if (count < out.size()) out[count] = static_cast<std::uint32_t>(begin + lane);
      ++count;
    });
  }
  return count;
}

}  // namespace gnomon
