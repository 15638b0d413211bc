// Which map serves a point.
#include "plan/select.hpp"
#include "gnomon/extend/shape.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "lanes/lanes.hpp"

namespace gnomon {

namespace {

// Of the sum that a clip coordinate is: of its products, of the matrix's last column, which is such a sum
// itself, and of the point.
constexpr double kRounding = 64.0 * 0x1p-53;

/// The sums of absolute values that the clip coordinates of a point are made of, and those of its planes.
struct Sizes {
  glm::dvec3 of_point;
  [[nodiscard]] double row(const glm::dmat4& m, int i) const noexcept {
    return std::abs(m[0][i]) * of_point.x + std::abs(m[1][i]) * of_point.y + std::abs(m[2][i]) * of_point.z +
           std::abs(m[3][i]);
  }
  [[nodiscard]] double plane(const glm::dvec4& p) const noexcept {
    return std::abs(p.x) * of_point.x + std::abs(p.y) * of_point.y + std::abs(p.z) * of_point.z +
           std::abs(p.w);
  }
};

}  // namespace

bool inside_select_planes(const ShadowMap& map, const glm::dvec3& point,
                          const glm::dvec3& origin_world) noexcept {
  const Sizes sizes{glm::abs(point) + glm::abs(origin_world)};
  for (int i = 0; i < map.select_plane_count; ++i) {
    const glm::dvec4& plane = map.select_planes[static_cast<std::size_t>(i)];
    if (!(glm::dot(glm::dvec3(plane), point) + plane.w >= -kRounding * sizes.plane(plane))) return false;
  }
  return true;
}

bool map_holds(const ShadowPlan& plan, const ShadowMap& map, const glm::dvec3& point) noexcept {
  if (!inside_select_planes(map, point, plan.origin_world)) return false;
  const Sizes sizes{glm::abs(point) + glm::abs(plan.origin_world)};
  const glm::dmat4& m = map.clip_from_world;
  const glm::dvec4 clip = m * glm::dvec4(point, 1.0);
  if (!(clip.w > 0.0)) return false;
  const double lowest = plan.clip_space.ndc_depth == NdcDepth::zero_to_one ? 0.0 : -1.0;
  // Of the depths: what shaders, which compute in floats, leave to rounding as well.
  constexpr double kDepthSlack = 1e-5;
  const double off_w = kRounding * sizes.row(m, 3);
  const double deep = kDepthSlack * (1.0 - lowest) * clip.w + kRounding * sizes.row(m, 2) + off_w;
  // Far outside is outside of every shape, and a quotient might overflow there.
  if (!(clip.z >= lowest * clip.w - deep && clip.z <= clip.w + deep) || std::abs(clip.x) > 2.0 * clip.w ||
      std::abs(clip.y) > 2.0 * clip.w)
    return false;
  // Compilers divide before they choose: w = 0 must be none here, and no quotient of coordinates too large.
  constexpr double kLeastW = 1e-200;
  const double w = divisor(clip.w, kLeastW);
  const glm::dvec2 ndc = glm::dvec2(clip) / w;
  // A quarter texel of the border is left to rounding; no kernel tells it apart. More where a texel is less
  // than the rounding of positions.
  constexpr double kQuarter = 0.25;
  const auto border = [&](int axis, int side) {
    const double off = (kRounding * sizes.row(m, axis) + std::abs(ndc[axis]) * off_w) / w;
    return map.filter_margin_texels - max_of(kQuarter, 0.5 * off * side);
  };
  const glm::dvec2 texel = map.texels().place(ndc).texel;
  const glm::dvec2 least{border(0, map.width), border(1, map.height)};
  return texel.x >= least.x && texel.y >= least.y && texel.x <= map.width - least.x &&
         texel.y <= map.height - least.y;
}

namespace {

/// Of the maps that hold the point, the one with the most texels per area across the light.
int finest_map(const ShadowPlan& plan, const glm::dvec3& point) noexcept {
  int finest = -1;
  double most = 0.0;
  for (int i = 0; i < plan.map_count; ++i) {
    const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    // Where w is rounding alone, map_holds() has another one.
    if (!map_holds(plan, map, point) || !(w_at(map.clip_from_world, point) > 0.0)) continue;
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
  if (plan.selection == MapSelection::finest) return finest_map(plan, point);
  if (plan.selection != MapSelection::view_depth) {
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
