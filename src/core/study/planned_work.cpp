// What is there to draw in the maps, or the pages, of a plan?
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "gnomon/study/technique.hpp"
#include "lanes/casters.hpp"

namespace gnomon {
namespace {

constexpr double kMega = 1e6, kKilo = 1e3;

/// Calls `use` with the index and the box of each caster that the map needs.
template <typename Use>
void for_each_caster(const ShadowMap& map, const Boxes& casters, Use&& use) noexcept {
  if (const CasterSet* set = casters.set(); set != nullptr && set->size() > 0) {
    for (std::size_t begin = 0; begin < set->size(); begin += kLanes) {
      const CasterBlock& block = set->block(0, begin / kLanes);
      std::uint32_t kept = block.occupied;
      for (int k = 0; k < map.cull_plane_count && kept != 0; ++k)
        kept &= ~lanes<Ask::outside>(map.cull_planes[static_cast<std::size_t>(k)], block);
      for_each_bit(kept, [&](std::size_t lane) {
        use(set->index(begin + lane), Box{{block.min[0][lane], block.min[1][lane], block.min[2][lane]},
                                          {block.max[0][lane], block.max[1][lane], block.max[2][lane]}});
      });
    }
  }
  constexpr std::size_t kBlock = 256;
  std::array<std::uint32_t, kBlock> kept;
  const std::span<const Box> list = casters.list();
  for (std::size_t begin = 0; begin < list.size(); begin += kBlock) {
    const std::size_t size = std::min(kBlock, list.size() - begin);
    const std::size_t count = cull_casters(map, list.subspan(begin, size), kept);
    for (std::size_t i = 0; i < count; ++i) use(begin + kept[i], list[begin + kept[i]]);
  }
}

/// Texels of the map that the box's rectangle meets, and the share that they are of the rectangle. The whole
/// map where a corner has no place in it.
struct Met {
  double texels, share;
};
Met met_by(const ShadowMap& map, const Box& box) noexcept {
  const glm::dvec2 size(map.width, map.height);
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                            (i & 4) != 0 ? box.max.z : box.min.z);
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(corner, 1.0);
    if (!(clip.w > 0.0)) return {size.x * size.y, 1.0};
    const glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size;
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const glm::dvec2 whole = high - low, met = glm::min(high, size) - glm::max(low, glm::dvec2(0.0));
  if (!(met.x > 0.0 && met.y > 0.0)) return {0.0, 0.0};
  return {met.x * met.y, met.x * met.y / (whole.x * whole.y)};
}

/// What of a box lies across a direction: an area times the direction's length.
double area_across(const glm::dvec3& direction, const glm::dvec3& side) noexcept {
  return std::abs(direction.x) * side.y * side.z + std::abs(direction.y) * side.z * side.x +
         std::abs(direction.z) * side.x * side.y;
}

/// Texels of the map that a caster covers, each as often as it is covered.
double covered_texels(const ShadowMap& map, const Box& box, double area_world) noexcept {
  const glm::dvec3 middle = 0.5 * (box.min + box.max), side = box.max - box.min;
  const glm::dvec3 to_light = glm::dvec3(map.light_world) - map.light_world.w * middle;
  // What light sees of the box, in world units and in texels.
  const double outline_world = area_across(safe_normalize(to_light, glm::dvec3(0.0, 1.0, 0.0)), side);
  if (!(outline_world > 0.0)) return 0.0;
  const double layers = area_world > 0.0 ? 0.5 * area_world / outline_world : 1.0;
  const Met met = met_by(map, box);
  double outline = met.texels;
  if (w_at(map.clip_from_world, middle) > 0.0) {
    const TexelJacobian texel = texel_jacobian(map.clip_from_world, map.texels(), middle);
    outline = area_across(glm::cross(texel.x, texel.y), side);
  }
  const double covered = layers * std::min(outline * met.share, met.texels);
  return std::isfinite(covered) ? covered : 0.0;
}

/// Adds the work of drawing one map, or page.
void add_work(const ShadowMap& map, const SceneBounds& bounds, std::span<const CasterWork> casters,
              PlanWork& work) noexcept {
  work.maps += 1.0;
  work.megatexels += static_cast<double>(map.width) * map.height / kMega;
  for_each_caster(map, bounds.casters, [&](std::size_t index, const Box& box) {
    work.kilodraws += 1.0 / kKilo;
    if (index >= casters.size()) return;
    const CasterWork& caster = casters[index];
    work.megatriangles += caster.triangles / kMega;
    (caster.alpha_tested ? work.megatexels_tested : work.megatexels_covered) +=
        covered_texels(map, box, caster.area_world) / kMega;
  });
}

}  // namespace

PlanWork planned_work(const ShadowPlan& plan, const SceneBounds& bounds,
                      std::span<const CasterWork> casters) noexcept {
  PlanWork work;
  for (const ShadowMap& map : plan.maps()) add_work(map, bounds, casters, work);
  return work;
}

PlanWork planned_work(const PagePlan& plan, const SceneBounds& bounds,
                      std::span<const CasterWork> casters) noexcept {
  PlanWork work;
  for (const Page& page : plan.pages) add_work(page_map(plan, page), bounds, casters, work);
  return work;
}

}  // namespace gnomon
