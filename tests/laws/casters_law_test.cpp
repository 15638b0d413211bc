// Is every caster that can shadow what the camera sees drawn, and inside the map's depth range?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// A ray that only grazes a box, by this much of the distance, may count either way: rounding of positions.
constexpr double kGraze = 1e-9;

// Texel sizes follow w: a kernel over which they differ by more than this is no longer a disc of one radius.
constexpr double kSteepestTap = 1.5;

Box shrunk(const Box& box, double by) {
  const glm::dvec3 inset = glm::min(glm::dvec3(by), 0.5 * (box.max - box.min));
  return {box.min + inset, box.max - inset};
}

/// Casters whose box the ray from `point` to the light passes through, with the passage's ends.
struct Blocker {
  std::uint32_t index;
  double enter, leave;
};
std::vector<Blocker> blockers(const Case& c, const glm::dvec3& point, const glm::dvec3& to_light) {
  std::vector<Blocker> found;
  for (std::size_t i = 0; i < c.casters.size(); ++i) {
    const double scale = glm::length(c.casters[i].min - c.camera.position) + c.camera.far_depth;
    const Crossing x = cross(shrunk(c.casters[i], kGraze * scale), point, to_light);
    if (x.hits) found.push_back({static_cast<std::uint32_t>(i), x.enter, x.leave});
  }
  return found;
}

std::vector<std::vector<std::uint32_t>> culled(const Case& c, const ShadowPlan& plan) {
  std::vector<std::vector<std::uint32_t>> lists;
  for (const ShadowMap& map : plan.maps()) {
    std::vector<std::uint32_t> list(c.casters.size());
    list.resize(cull_casters(map, c.casters, list));
    lists.push_back(list);
  }
  return lists;
}

void require_drawn(const ShadowMap& map, const std::vector<std::uint32_t>& list, const glm::dvec3& start,
                   const glm::dvec3& to_light, const Blocker& blocker) {
  require(std::binary_search(list.begin(), list.end(), blocker.index), "caster", blocker.index,
          "culled from cascade", map.cascade, map.warp->name, "shadows", start.x, start.y, start.z, "from",
          blocker.enter, "to", blocker.leave);
  for (const double t : {blocker.enter, blocker.leave}) {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(start + to_light * t, 1.0);
    require(clip.w > 0.0, "caster", blocker.index, "behind the map: w", clip.w, "cascade", map.cascade,
            map.warp->name, "kappa", map.kappa, "texel", map.texel_world.x, map.texel_world.y);
    const double z = clip.z / clip.w;
    require(std::abs(z) <= 1.0, "caster", blocker.index, "at depth", z, "cascade", map.cascade,
            map.warp->name);
  }
}

/// The move across the light that takes `p` by `texels` in the map.
glm::dvec3 kernel_tap(const ShadowMap& map, const glm::dvec3& p, const glm::dvec3& to_light,
                      const glm::dvec2& texels) {
  const glm::dmat4& m = map.clip_from_world;
  const glm::dvec4 clip = m * glm::dvec4(p, 1.0);
  const double x = clip.x / clip.w + 2.0 * texels.x / map.width;
  const double y = clip.y / clip.w + 2.0 * texels.y / map.height;
  const glm::dvec3 u = any_across(to_light), v = glm::cross(to_light, u);
  const glm::dmat4x3 rows = glm::dmat4x3(glm::transpose(m));
  const glm::dvec3 row_x = rows[0] - rows[3] * x, row_y = rows[1] - rows[3] * y;
  const glm::dmat2 a(glm::dot(row_x, u), glm::dot(row_y, u), glm::dot(row_x, v), glm::dot(row_y, v));
  const glm::dvec2 move =
      glm::inverse(a) * (glm::dvec2(2.0 * texels.x / map.width, 2.0 * texels.y / map.height) * clip.w);
  return u * move.x + v * move.y;
}

TEST(CastersLaw, every_caster_between_a_visible_receiver_and_the_light_is_drawn_within_the_depth_range) {
  std::uint64_t shadows = 0;
  for_all(2000, [&] {
    const Case c = draw_case();
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    const auto lists = culled(c, plan);
    const glm::dvec3 to_light = -glm::normalize(c.light);
    Random random(11);
    for (const glm::dvec3& p : visible_points(c, random, 6, 6)) {
      const ShadowMap* map = map_for(plan, depth_of(c.camera, p));
      if (map == nullptr) continue;
      for (const Blocker& blocker : blockers(c, p, to_light)) {
        ++shadows;
        require_drawn(*map, lists[static_cast<std::size_t>(map - plan.map.data())], p, to_light, blocker);
      }
    }
  });
  EXPECT_GT(shadows, of_all_draws(10000));
}

TEST(CastersLaw, the_finest_map_that_holds_a_receiver_has_every_caster_of_it_within_its_depth_range) {
  std::uint64_t shadows = 0, elsewhere = 0;
  for_all(1500, [&] {
    Case c = draw_case();
    c.options.split.selection = MapSelection::finest;
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    const auto lists = culled(c, plan);
    const glm::dvec3 to_light = -glm::normalize(c.light);
    Random random(11);
    for (const glm::dvec3& p : visible_points(c, random, 6, 6)) {
      const double depth = depth_of(c.camera, p);
      const int serving = map_serving(plan, p, depth);
      const ShadowMap* const own = map_for(plan, depth);
      require(serving >= 0 || own == nullptr, "no map holds a receiver of cascade", own ? own->cascade : -1);
      for (const Blocker& blocker : blockers(c, p, to_light)) {
        require(serving >= 0, "no map for a receiver in the shadow of caster", blocker.index);
        const auto at = static_cast<std::size_t>(serving);
        ++shadows;
        elsewhere += &plan.map[at] != own ? 1 : 0;
        require_drawn(plan.map[at], lists[at], p, to_light, blocker);
      }
    }
  });
  EXPECT_GT(shadows, of_all_draws(10000));
  EXPECT_GT(elsewhere, of_all_draws(1000));
}

TEST(CastersLaw, a_visible_receiver_without_a_map_has_no_caster_between_it_and_the_light) {
  std::uint64_t unmapped = 0;
  for_all(2000, [&] {
    Case c = draw_case();
    // Few casters, so that cascades without any occur.
    if (c.casters.size() > 2) c.casters.resize(1 + c.casters.size() % 2);
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    const glm::dvec3 to_light = -glm::normalize(c.light);
    Random random(13);
    for (const glm::dvec3& p : visible_points(c, random, 6, 6)) {
      const double depth = depth_of(c.camera, p);
      // Between two cascades a rounding decides.
      if (map_for(plan, depth) != nullptr || map_for(plan, depth * (1 - 1e-9)) != nullptr ||
          map_for(plan, depth * (1 + 1e-9)) != nullptr)
        continue;
      ++unmapped;
      const auto found = blockers(c, p, to_light);
      require(found.empty(), "status", to_string(plan.status), "no map at depth", depth, "but caster",
              found.empty() ? 0 : found.front().index);
    }
  });
  EXPECT_GT(unmapped, of_all_draws(1000));
}

TEST(CastersLaw, a_caster_that_only_the_filter_kernel_reaches_is_drawn_too) {
  std::uint64_t shadows = 0;
  for_all(1000, [&] {
    Case c = draw_case();
    if (c.options.filter.texels < 1.0) c.options.filter.texels = 1.0 + pick(4);
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    const auto lists = culled(c, plan);
    const glm::dvec3 to_light = -glm::normalize(c.light);
    Random random(17);
    for (const glm::dvec3& p : visible_points(c, random, 4, 4)) {
      const ShadowMap* map = map_for(plan, depth_of(c.camera, p));
      if (map == nullptr) continue;
      const double radius = c.options.filter.texels;
      const glm::dvec3 start =
          p +
          kernel_tap(*map, p, to_light, {random.between(-radius, radius), random.between(-radius, radius)});
      // Under a strong warp the far rim nears the horizon, where a texel stands for an unbounded piece of the
      // world; past it there is nothing to draw.
      const double w_point = (map->clip_from_world * glm::dvec4(p, 1.0)).w;
      const double w_tap = (map->clip_from_world * glm::dvec4(start, 1.0)).w;
      if (!(w_tap > w_point / kSteepestTap && w_tap < w_point * kSteepestTap)) continue;
      for (const Blocker& blocker : blockers(c, start, to_light)) {
        ++shadows;
        require_drawn(*map, lists[static_cast<std::size_t>(map - plan.map.data())], start, to_light, blocker);
      }
    }
  });
  EXPECT_GT(shadows, of_all_draws(2000));
}

TEST(CastersLaw, culling_counts_all_and_writes_no_more_than_there_is_room_for) {
  for_all(200, [&] {
    const Case c = draw_case();
    const ShadowPlan plan = c.plan();
    for (const ShadowMap& map : plan.maps()) {
      std::vector<std::uint32_t> all(c.casters.size());
      const std::size_t count = cull_casters(map, c.casters, all);
      require(count <= all.size() && count > 0, "count", count);
      std::vector<std::uint32_t> one(1, 99999u);
      require(cull_casters(map, c.casters, one) == count && one[0] == all[0], "with room for one");
      require(cull_casters(map, c.casters, {}) == count, "with no room");
      require(std::is_sorted(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)), "order");
    }
  });
}

}  // namespace
}  // namespace gnomon::test
