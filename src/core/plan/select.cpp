// Which map serves a point.
#include "plan/select.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/jacobian.hpp"
#include "geometry/vector.hpp"

namespace gnomon {

bool inside_select_planes(const ShadowMap& map, const glm::dvec3& point) noexcept {
  for (int i = 0; i < map.select_plane_count; ++i) {
    const glm::dvec4& plane = map.select_planes[static_cast<std::size_t>(i)];
    if (!(glm::dot(glm::dvec3(plane), point) + plane.w >= 0.0)) return false;
  }
  return true;
}

bool map_holds(const ShadowPlan& plan, const ShadowMap& map, const glm::dvec3& point) noexcept {
  if (!inside_select_planes(map, point)) return false;
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(point, 1.0);
  const double lowest = plan.clip_space.ndc_depth == NdcDepth::zero_to_one ? 0.0 : -1.0;
  // Far outside is outside of every shape, and a quotient might overflow there.
  if (!(clip.w > 0.0 && clip.z >= lowest * clip.w && clip.z <= clip.w) || std::abs(clip.x) > 2.0 * clip.w ||
      std::abs(clip.y) > 2.0 * clip.w)
    return false;
  // A quarter texel of the border is left to rounding; no kernel tells it apart.
  constexpr double kRounding = 0.25;
  const double border = map.filter_margin_texels - kRounding;
  const glm::dvec2 texel = map.texels().place(glm::dvec2(clip) / clip.w).texel;
  return texel.x >= border && texel.y >= border && texel.x <= map.width - border &&
         texel.y <= map.height - border;
}

namespace {

/// Of the maps that hold the point, the one with the most texels per area across the light.
int finest_map(const ShadowPlan& plan, const glm::dvec3& point) noexcept {
  int finest = -1;
  double most = 0.0;
  for (int i = 0; i < plan.map_count; ++i) {
    const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    if (!map_holds(plan, map, point)) continue;
    const TexelJacobian texel = texel_jacobian(map.clip_from_world, map.texels(), point);
    // Both gradients lie across the light's ray, so that this has its direction.
    const double density = glm::length(glm::cross(texel.x, texel.y));
    if (finest >= 0 && !(density > most)) continue;
    finest = i;
    most = density;
  }
  return finest;
}

}  // namespace

int map_serving(const ShadowPlan& plan, const glm::dvec3& point, double depth) noexcept {
  if (plan.select_finest) return finest_map(plan, point);
  if (plan.select_by_map) {
    for (int i = 0; i < plan.map_count; ++i) {
      if (map_holds(plan, plan.map[static_cast<std::size_t>(i)], point)) return i;
    }
    return -1;
  }
  for (int i = 0; i < plan.map_count; ++i) {
    const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    if (depth >= map.depth_begin && depth <= map.depth_end) return i;
  }
  // Who computes the depth of a corner on the last map's end gets there but for rounding: of the depth
  // itself, and of the position it was computed from.
  constexpr double kDepthRounding = 1e-12, kPositionRounding = 4e-13;
  const double slack =
      kDepthRounding * std::abs(depth) +
      kPositionRounding * max_of(largest_component(point), largest_component(plan.origin_world));
  for (int i = 0; i < plan.map_count; ++i) {
    const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    if (depth >= map.depth_begin - slack && depth <= map.depth_end + slack) return i;
  }
  return -1;
}

}  // namespace gnomon
