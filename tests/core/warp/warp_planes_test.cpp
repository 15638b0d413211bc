// Do chosen planes get a map whose texels are pixels, and does every other receiver keep its map?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr WarpPlane kFloor{{3, 0, -5}, {0, 2, 0}, 0.05};
constexpr WarpPlane kWall{{-10, 1, 0}, {1, 0, 0}, 0.05};

/// A hall: its floor and a wall of it, and a table between them.
Case hall() {
  Case c;
  c.camera = perspective_camera({0, 4, 0}, {-0.1, -0.25, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 200.0, 960, 600);
  c.light = {0.5, -1.0, 0.3};
  c.receivers = {
      {{-10, -0.01, -60}, {10, 0.01, -3}}, {{-10.01, 0, -60}, {-9.99, 8, -3}}, {{2, 1, -12}, {4, 2, -9}}};
  c.casters = c.receivers;
  c.casters.push_back({{-20, 12, -60}, {20, 12.1, 30}});
  c.options.cascades = 3;
  c.options.split.scheme = SplitScheme::practical;
  c.options.warp.warp = &warps::none;
  return c;
}

bool has(const ShadowPlan& plan, OmissionKind kind, double a) {
  const auto omitted = plan.omitted();
  return std::any_of(omitted.begin(), omitted.end(),
                     [&](const Omission& o) { return o.kind == kind && o.a == a; });
}

bool ignored(const ShadowPlan& plan, IgnoredOption option) {
  return has(plan, OmissionKind::option_ignored, static_cast<double>(option));
}

TEST(WarpPlanes, every_texel_on_the_plane_is_one_pixel) {
  for (const double height : {4.0, 1.7, 0.3}) {
    Case c = hall();
    c.camera.position.y = height;
    c.options.warp.planes[0] = kFloor;
    const ShadowPlan plan = c.plan();
    const ShadowMap& map = plan.map[0];
    ASSERT_EQ(map.cascade, 3);
    EXPECT_EQ(map.warp, &warps::plane_optimal);
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (double x = -9; x <= 9; x += 1.5)
      for (double z = -55; z <= -8; z += 1.0) {
        const glm::dvec3 p{x, 0.0, z};
        if (map_serving(plan, p, depth_of(c.camera, p)) != 0) continue;
        const PointAliasing m = measure_point(map, c.camera, p, {0, 1, 0});
        least = std::min(least, m.m_max);
        most = std::max(most, m.m_max);
      }
    EXPECT_GT(most, 0.0);
    EXPECT_LT(most, 1.02 * least) << height;
  }
}

TEST(WarpPlanes, a_body_that_reaches_behind_the_eye_along_the_light_keeps_its_warp) {
  // The light comes from ahead and low: at the thickness of a metre, rays through the nearest points meet the
  // floor behind the camera.
  Case c = hall();
  c.camera.position.y = 1.2;
  c.light = {0.0, -0.35, 1.0};
  c.receivers[0] = {{-10, -0.01, -60}, {10, 1.0, -0.6}};
  c.casters[0] = c.receivers[0];
  c.options.warp.planes[0] = {{0, 0, 0}, {0, 1, 0}, 1.01};
  const ShadowPlan plan = c.plan();
  ASSERT_EQ(plan.map[0].cascade, 3);
  EXPECT_EQ(plan.map[0].warp, &warps::plane_optimal);
  EXPECT_GT(plan.map[0].kappa, 0.0);
  const glm::dvec3 on_floor{0, 0, -30}, high_and_near{0, 0.95, -1.0};
  EXPECT_EQ(map_serving(plan, on_floor, depth_of(c.camera, on_floor)), 0);
  EXPECT_GT(map_serving(plan, high_and_near, depth_of(c.camera, high_and_near)), 0);
}

TEST(WarpPlanes, each_receiver_takes_the_map_of_its_plane_and_all_others_the_cascades) {
  Case c = hall();
  c.options.warp.planes[0] = kFloor;
  c.options.warp.planes[2] = kWall;
  const ShadowPlan plan = c.plan();
  ASSERT_EQ(plan.map_count, 5);
  EXPECT_NE(plan.selection, MapSelection::view_depth);
  EXPECT_EQ(plan.map[0].cascade, 3);
  EXPECT_EQ(plan.map[1].cascade, 5);
  const auto cascade_at = [&](const glm::dvec3& p) {
    const int map = map_serving(plan, p, depth_of(c.camera, p));
    return map < 0 ? -1 : plan.map[static_cast<std::size_t>(map)].cascade;
  };
  EXPECT_EQ(cascade_at({2, 0, -20}), 3);
  EXPECT_EQ(cascade_at({-10, 3, -20}), 5);
  const glm::dvec3 on_table{3, 2, -10};
  const int cascade = cascade_at(on_table);
  ASSERT_GE(cascade, 0);
  ASSERT_LT(cascade, 3);
  c.options.warp.planes = {};
  const ShadowPlan without = c.plan();
  EXPECT_EQ(map_for(without, depth_of(c.camera, on_table))->cascade, cascade);
}

TEST(WarpPlanes, cascades_beside_planes_keep_their_bits_and_part_at_their_depths) {
  Case c = hall();
  const ShadowPlan without = c.plan();
  c.options.warp.planes[0] = kFloor;
  const ShadowPlan plan = c.plan();
  ASSERT_EQ(plan.map_count, without.map_count + 1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(without.map_count); ++i)
    EXPECT_EQ(plan.map[i + 1].clip_from_world, without.map[i].clip_from_world);
  // Over the table's top, along the view: each point has the cascade of its depth.
  for (double depth = 4.0; depth < 50.0; depth += 0.25) {
    const glm::dvec3 p = point_at(c.camera, 0.1, -0.05, depth);
    const int map = map_serving(plan, p, depth);
    const ShadowMap* const by_depth = map_for(without, depth);
    if (map < 0 || by_depth == nullptr || plan.map[static_cast<std::size_t>(map)].cascade == 3) continue;
    EXPECT_EQ(plan.map[static_cast<std::size_t>(map)].cascade, by_depth->cascade) << depth;
  }
}

TEST(WarpPlanes, cascades_with_nothing_beside_the_planes_are_omitted) {
  Case c = hall();
  c.receivers.resize(1);
  c.options.warp.planes[0] = kFloor;
  const ShadowPlan plan = c.plan();
  EXPECT_EQ(plan.map_count, 1);
  EXPECT_EQ(plan.status, PlanStatus::ok);
  const auto omitted = plan.omitted();
  EXPECT_EQ(std::count_if(omitted.begin(), omitted.end(),
                          [](const Omission& o) { return o.kind == OmissionKind::cascade_on_planes; }),
            3);
  c.options.prune = kPruneNothing;
  EXPECT_EQ(c.plan().map_count, 4);
}

TEST(WarpPlanes, planes_without_receiver_caster_or_light_get_no_map) {
  Case c = hall();
  const ShadowPlan without = c.plan();
  c.options.warp.planes[0] = {{0, -50, 0}, {0, 1, 0}, 0.1};
  ShadowPlan plan = c.plan();
  EXPECT_TRUE(has(plan, OmissionKind::plane_without_receiver, 0.0));
  EXPECT_EQ(plan.map_count, without.map_count);
  EXPECT_EQ(plan.selection, MapSelection::view_depth);
  c.options.warp.planes[0] = kFloor;
  c.light = {1, 0, 0};
  EXPECT_TRUE(has(c.plan(), OmissionKind::plane_without_receiver, 0.0));
  c = hall();
  c.options.warp.planes[1] = kFloor;
  c.casters = {{{2, -30, -12}, {4, -29, -9}}};  // below everything
  EXPECT_EQ(c.plan().status, PlanStatus::no_caster);
  EXPECT_TRUE(has(c.plan(), OmissionKind::plane_without_caster, 1.0));
}

TEST(WarpPlanes, broken_planes_and_too_many_maps_are_refused_by_name) {
  const double nan = std::nan("");
  for (const WarpPlane& broken :
       {WarpPlane{{nan, 0, 0}, {0, 1, 0}, 1.0}, WarpPlane{{0, 0, 0}, {0, 0, 0}, 1.0},
        WarpPlane{{0, 0, 0}, {0, 1, nan}, 1.0}, WarpPlane{{0, 0, 0}, {0, 1, 0}, -1.0},
        WarpPlane{{0, 0, 0}, {0, 1, 0}, nan}}) {
    Case c = hall();
    c.options.warp.planes[1] = broken;
    EXPECT_EQ(c.plan().invalid_field, "options.warp.planes");
  }
  Case c = hall();
  c.options.cascades = kMaxMaps - 1;
  c.options.warp.planes[0] = kFloor;
  EXPECT_EQ(c.plan().invalid_field, "");
  c.options.warp.planes[1] = kWall;
  EXPECT_EQ(c.plan().invalid_field, "options.warp.planes");
}

TEST(WarpPlanes, plans_that_have_no_place_for_them_say_so) {
  const auto plan_with = [](auto change) {
    Case c = hall();
    c.options.warp.planes[0] = kFloor;
    change(c.options);
    return c.plan();
  };
  for (const Fit fit : {Fit::stable, Fit::warped_stable})
    EXPECT_TRUE(ignored(plan_with([&](PlanOptions& o) { o.fit = fit; }), IgnoredOption::planes));
  EXPECT_TRUE(ignored(plan_with([](PlanOptions& o) { o.split.partition = Partition::frustum_faces; }),
                      IgnoredOption::planes));
  EXPECT_TRUE(
      ignored(plan_with([](PlanOptions& o) { o.resolution.texel_budget = 1 << 22; }), IgnoredOption::planes));
  EXPECT_FALSE(ignored(plan_with([](PlanOptions&) {}), IgnoredOption::planes));
  const ShadowPlan overlapping = plan_with([](PlanOptions& o) { o.split.overlap = 0.5; });
  EXPECT_TRUE(ignored(overlapping, IgnoredOption::split_overlap));
  for (const ShadowMap& map : overlapping.maps()) EXPECT_EQ(map.overlap, 0.0);
  Case c = hall();
  c.options.warp.planes[0] = kFloor;
  const ShadowPlan local =
      make_plan(c.camera, SpotLight{{0, 9, -10}, {0, -1, 0}, 0.7, 100.0}, c.bounds(), c.options);
  EXPECT_TRUE(ignored(local, IgnoredOption::planes));
}

TEST(WarpPlanes, everything_in_view_has_a_map_that_shows_its_casters) {
  std::uint64_t on_planes = 0, on_cascades = 0;
  for_all(400, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 6});
    c.options.fit = chance(0.5) ? Fit::tight : Fit::rotated;
    c.options.split.partition = Partition::view_depth;
    c.options.split.overlap = 0.0;
    c.options.cascades = 1 + static_cast<int>(between(0.0, 4.99));
    const Box& near = c.receivers.front();
    const double size = std::max(glm::length(near.max - near.min), 1e-3 * glm::length(near.max));
    c.options.warp.planes[0] = {near.min, {between(-1, 1), 1.0, between(-1, 1)}, size * between(0.001, 0.5)};
    c.options.warp.planes[1] = {near.max, {1.0, between(-1, 1), between(-1, 1)}, size * between(0.001, 0.5)};
    const ShadowPlan plan = c.plan();
    c.options.warp.planes = {};
    const ShadowPlan without = c.plan();
    RC_LOG() << c;
    Random random(3);
    for (const glm::dvec3& p : visible_points(c, random, 4, 4)) {
      const double depth = depth_of(c.camera, p);
      const int before = map_serving(without, p, depth);
      if (before < 0) continue;
      const int now = map_serving(plan, p, depth);
      // A plane without casters of its own leaves its receivers to the cascades, and those to being lit.
      require(now >= 0, "no map", depth, without.map[static_cast<std::size_t>(before)].cascade);
      const ShadowMap& map = plan.map[static_cast<std::size_t>(now)];
      (map.cascade >= c.options.cascades ? on_planes : on_cascades) += 1;
      const glm::dvec3 towards_light = -glm::normalize(c.light);
      for (const Box& caster : c.casters) {
        const Crossing ray = cross(caster, p, towards_light);
        if (!ray.hits || !(ray.enter > 1e-6 * depth)) continue;
        std::uint32_t one = 0;
        require(cull_casters(map, {&caster, 1}, {&one, 1}) == 1, "caster left out", map.cascade, depth);
      }
    }
  });
  EXPECT_GT(on_planes, 200u);
  EXPECT_GT(on_cascades, 500u);
}

}  // namespace
}  // namespace gnomon::test
