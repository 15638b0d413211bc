// Does the texel grid of a stable map stand still while the camera moves and turns?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// A whole texel to this: the invariant that keeps edges from crawling.
constexpr double kTexel = 1e-6;

glm::dvec2 texel_of(const ShadowMap& map, const glm::dvec3& p) {
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
  return {0.5 * map.width * clip.x / clip.w, 0.5 * map.height * clip.y / clip.w};
}
double from_whole(double v) {
  return std::abs(v - std::round(v));
}

/// A camera among boxes, with everything in reach, so that each cascade has receivers and casters.
Case draw_stable_case() {
  Case c = draw_case({.max_depth_ratio = 1e4, .max_boxes = 8});
  c.options.fit = Fit::stable;
  c.options.split.range = SplitRange::automatic;
  c.options.split.pseudo_near = 0.0;
  const double f = 4.0 * c.camera.far_depth;
  // One box, or the same in slabs: several boxes are bounded and culled one by one.
  Box rest{c.camera.position - glm::dvec3(f), c.camera.position + glm::dvec3(f)};
  const std::vector<Box> others = c.casters;
  c.receivers.clear();
  const int axis = pick(3);
  for (int slabs = pick(5); slabs > 0; --slabs) {
    Box slab = rest;
    slab.max[axis] = rest.min[axis] = rest.min[axis] + between(0.1, 0.6) * (rest.max[axis] - rest.min[axis]);
    c.receivers.push_back(slab);
  }
  c.receivers.push_back(rest);
  c.casters = c.receivers;
  c.casters.insert(c.casters.end(), others.begin(), others.end());
  return c;
}

/// Every map of `b` has the grid of the same cascade of `a`.
std::uint64_t require_same_grid(const Case& c, const ShadowPlan& a, const ShadowPlan& b) {
  std::uint64_t compared = 0;
  Random random(5);
  for (const ShadowMap& m : a.maps()) {
    for (const ShadowMap& n : b.maps()) {
      if (n.cascade != m.cascade) continue;
      for (int i = 0; i < 4; ++i) {
        const glm::dvec3 p = point_at(c.camera, random.between(-1, 1), random.between(-1, 1),
                                      random.between(m.depth_begin, m.depth_end));
        const glm::dvec2 moved = texel_of(n, p) - texel_of(m, p);
        require(from_whole(moved.x) <= kTexel && from_whole(moved.y) <= kTexel, "texels", moved.x, moved.y,
                "cascade", m.cascade);
        ++compared;
      }
    }
  }
  return compared;
}

TEST(StableLaw, snap_keeps_the_texel_grid_under_sub_texel_motion) {
  std::uint64_t compared = 0;
  for_all(500, [&] {
    Case c = draw_stable_case();
    const ShadowPlan before = c.plan();
    if (before.map_count == 0) return;
    const double texel = before.map[0].texel_world.x;
    RC_LOG() << c << "texel " << texel;
    Case moved = c;
    moved.camera.position += glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) * texel;
    compared += require_same_grid(c, before, moved.plan());
  });
  EXPECT_GT(compared, of_all_draws(2000));
}

TEST(StableLaw, the_grid_is_stable_under_any_motion_and_turn_of_the_camera) {
  std::uint64_t compared = 0;
  for_all(1000, [&] {
    Case c = draw_stable_case();
    RC_LOG() << c;
    const ShadowPlan before = c.plan();
    Case moved = c;
    moved.camera.position +=
        glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) * (0.5 * c.camera.far_depth);
    if (chance(0.7)) moved.camera.forward = {between(-1, 1), between(-1, 1), between(0.1, 1)};
    if (chance(0.3)) moved.camera.up = {between(-1, 1), between(0.1, 1), between(-1, 1)};
    compared += require_same_grid(c, before, moved.plan());
  });
  EXPECT_GT(compared, of_all_draws(4000));
}

TEST(StableLaw, equal_snap_keys_mean_the_same_matrix_to_the_last_bit) {
  std::uint64_t equal = 0;
  for_all(1000, [&] {
    Case c = draw_stable_case();
    const ShadowPlan before = c.plan();
    if (before.map_count == 0) return;
    RC_LOG() << c;
    Case moved = c;
    moved.camera.position += glm::dvec3(unit(), unit(), unit()) * (0.3 * before.map[0].texel_world.x);
    const ShadowPlan after = moved.plan();
    for (const ShadowMap& m : before.maps()) {
      for (const ShadowMap& n : after.maps()) {
        if (n.cascade != m.cascade || !(n.snap_key == m.snap_key)) continue;
        ++equal;
        require(m.clip_from_world == n.clip_from_world, "matrices of equal keys differ", m.cascade);
      }
    }
  });
  EXPECT_GT(equal, of_all_draws(300));
}

TEST(StableLaw, a_stable_map_is_never_warped_and_reports_an_ignored_warp) {
  std::uint64_t maps = 0, asked = 0;
  for_all(200, [&] {
    Case c = draw_stable_case();
    const ShadowPlan plan = c.plan();
    for (const ShadowMap& map : plan.maps()) {
      require(map.warp == &warps::none && map.kappa == 0.0, map.warp->name, map.kappa);
      // Square texels of one size over the whole map.
      require(std::abs(map.texel_world.x - map.texel_world.y) <= 1e-9 * map.texel_world.x, "texels",
              map.texel_world.x, map.texel_world.y);
      ++maps;
    }
    if (plan.status != PlanStatus::ok || c.options.warp.warp == nullptr ||
        c.options.warp.warp == &warps::none)
      return;
    bool told = false;
    for (const Omission& o : plan.omitted()) told = told || o.kind == OmissionKind::warp_in_stable_fit;
    require(told, "warp left out without a word");
    ++asked;
  });
  EXPECT_GT(maps, of_all_draws(400));
  EXPECT_GT(asked, of_all_draws(50));
}

}  // namespace
}  // namespace gnomon::test
