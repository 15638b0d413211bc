// Do receivers without any thickness, or with little, count where errors are measured, and where pages are
// planned?
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/pages.hpp"

namespace gnomon::test {
namespace {

const DirectionalLight kSun{{0.3, -1, 0.2}};

Camera over_the_floor(double near_depth = 0.1) {
  return perspective_camera({0, 6, 14}, {0, -0.45, -1}, {0, 1, 0}, 1.0, 1.6, near_depth, 100.0, 640, 400);
}
const Box kFloor{{-20, 0, -20}, {20, 0, 20}};

AliasingStats measured(const std::vector<Box>& receivers, const Camera& camera,
                       const MeasureOptions& options = {}) {
  const SceneBounds bounds{receivers, receivers};
  return measure(make_plan(camera, kSun, bounds), camera, bounds, options);
}

TEST(FlatReceivers, count_once_on_each_ray_that_meets_them) {
  const Camera camera = over_the_floor();
  const CameraAxes axes = camera_axes(camera);
  std::uint64_t met = 0;
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 64; ++column) {
      const double x = camera.left + (camera.right - camera.left) * (column + 0.5) / 64;
      const double y = camera.bottom + (camera.top - camera.bottom) * (row + 0.5) / 64;
      const glm::dvec3 ray = axes.forward + axes.right * x + axes.up * y;
      const double depth = -camera.position.y / ray.y;
      const glm::dvec3 p = camera.position + ray * depth;
      met += depth > camera.near_depth && std::abs(p.x) <= 20.0 && std::abs(p.z) <= 20.0;
    }
  }
  const AliasingStats stats = measured({kFloor}, camera);
  EXPECT_EQ(stats.samples, met);
  EXPECT_GT(met, 1500u);
  EXPECT_EQ(stats.outside, 0u);
  EXPECT_GT(stats.p50, 0.0);
  // As at points of the floor that a caller gives.
  std::vector<glm::dvec3> points;
  for (int x = -9; x <= 9; ++x)
    for (int z = -15; z <= 3; ++z) points.push_back({x, 0.0, z});
  const std::vector<Box> receivers = {kFloor};
  const SceneBounds bounds{receivers, receivers};
  View view{camera};
  const ShadowPlan plan = make_plan(view, kSun, bounds);
  view.points_world = points;
  const AliasingStats given = measure(plan, view, bounds);
  EXPECT_LT(given.p50, 2.0 * stats.p50);
  EXPECT_GT(given.p50, 0.5 * stats.p50);
}

TEST(FlatReceivers, count_across_the_view_and_in_front_of_others) {
  // Every ray meets both walls between two of the grid's depths: the nearer one counts.
  const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100.0, 640, 400);
  const Box wall{{-50, -50, -10.1}, {50, 50, -10.1}}, behind{{-50, -50, -30.3}, {50, 50, -30.3}};
  EXPECT_EQ(measured({wall}, camera).samples, 64u * 64u);
  EXPECT_EQ(measured({behind, wall}, camera).samples, 64u * 64u);
  MeasureOptions deep;
  deep.depths = 700;  // several tables
  EXPECT_EQ(measured({wall}, camera, deep).samples, 64u * 64u);
  EXPECT_EQ(measured({{{-50, -50, 10}, {50, 50, 10}}}, camera).samples, 0u) << "behind the eye";
  EXPECT_EQ(measured({{{-50, -50, -1000}, {50, 50, -1000}}}, camera).samples, 0u) << "beyond the far plane";
}

TEST(FlatReceivers, thin_ones_count_where_rays_enter_them) {
  // The grid's depths are a tenth apart: a wall of two parts in a hundred is between two of them, or holds
  // one.
  const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100.0, 640, 400);
  for (double depth = 8.0; depth < 11.0; depth += 0.1) {
    const Box wall{{-50, -50, -1.02 * depth}, {50, 50, -depth}};
    EXPECT_EQ(measured({wall}, camera).samples, 64u * 64u) << depth;
    MeasureOptions tables;
    tables.depths = 300;
    EXPECT_GE(measured({wall}, camera, tables).samples, 64u * 64u) << depth;
  }
  // The nearest corner of a slab has its error, but for half a pixel of the grid's.
  const Camera over =
      perspective_camera({0, 25, 0}, {0, -0.4, -1}, {0, 1, 0}, 1.0, 1.5, 0.05, 500.0, 640, 400);
  const Box slab{{-300, -0.2, -300}, {300, 0, 300}};
  const std::vector<Box> receivers = {slab};
  const SceneBounds bounds{receivers, receivers};
  const ShadowPlan plan = make_plan(over, kSun, bounds);
  MeasureOptions fine;
  fine.depths = 2000;
  const AliasingStats coarse = measure(plan, over, bounds), exact = measure(plan, over, bounds, fine);
  EXPECT_GT(coarse.samples, 3000u);
  EXPECT_NEAR(coarse.max / exact.max, 1.0, 0.01);
}

TEST(FlatReceivers, change_nothing_of_what_has_room) {
  const Box room{{-3, 0, -9}, {3, 4, -2}};
  const Camera camera = over_the_floor();
  const AliasingStats alone = measured({room}, camera);
  const std::vector<Box> both = {room, {{400, 0, 0}, {410, 0, 5}}};
  const AliasingStats beside = measured(both, camera);
  EXPECT_EQ(alone.samples, beside.samples);
  EXPECT_EQ(alone.p95, beside.p95);
}

TEST(FlatReceivers, are_found_in_a_set_as_in_a_list) {
  std::vector<Box> tiles;
  for (int i = 0; i < 400; ++i) {
    const double x = -20.0 + 2.0 * (i % 20), z = -20.0 + 2.0 * (i / 20);
    tiles.push_back({{x, 0, z}, {x + 1.5, 0, z + 1.5}});
  }
  std::vector<CasterBlock> blocks(CasterSet::block_count(tiles.size()));
  std::vector<std::uint32_t> indices(CasterSet::index_count(tiles.size()));
  const CasterSet set(tiles, blocks, indices);
  const Camera camera = over_the_floor();
  const ShadowPlan plan = make_plan(camera, kSun, {tiles, tiles});
  const AliasingStats list = measure(plan, camera, {tiles, tiles}), tree = measure(plan, camera, {set, set});
  EXPECT_GT(list.samples, 700u);
  EXPECT_EQ(list.samples, tree.samples);
  EXPECT_EQ(list.mean, tree.mean);
}

TEST(FlatReceivers, get_pages_without_points) {
  const std::vector<Box> receivers = {kFloor};
  const SceneBounds bounds{receivers, receivers};
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = plan_pages(over_the_floor(), kSun, bounds, {}, memory);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_GT(plan.pages.size(), 20u);
  const AliasingStats m = measure(plan, over_the_floor(), bounds).m;
  EXPECT_GT(m.samples, 1500u);
  EXPECT_GT(m.p95, 0.0);
}

}  // namespace
}  // namespace gnomon::test
