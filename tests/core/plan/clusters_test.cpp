// Do groups of receivers with room between them get maps of their own, and only where that saves texels?
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

/// A camera that looks along z under a slanting sun.
struct Scene {
  Camera camera = perspective_camera({0, 5, 0}, {0, 0, 1}, {0, 1, 0}, 0.76, 2.0, 1.0, 300.0, 1280, 640);
  DirectionalLight sun{{0.4, -1.0, 0.3}};
  std::vector<Box> boxes;
  PlanOptions options;
  explicit Scene(std::vector<Box> receivers) : boxes(std::move(receivers)) {
    options.split.partition = Partition::receiver_clusters;
    options.warp.warp = &warps::none;
    options.cascades = 2;
  }
  [[nodiscard]] ShadowPlan plan() const { return make_plan(camera, sun, {boxes, boxes}, options); }
  [[nodiscard]] ShadowPlan cascades() const {
    Scene other = *this;
    other.options.split.partition = Partition::view_depth;
    return other.plan();
  }
  [[nodiscard]] double storage(const ShadowPlan& plan) const {
    return measure(plan, camera, {boxes, boxes}, {48, 48, 512}).storage;
  }
};

/// Two islands at the same depth, far apart to either side.
std::vector<Box> two_islands() {
  return {{{-60, 0, 90}, {-50, 4, 100}}, {{50, 0, 90}, {60, 4, 100}}};
}

std::size_t count_of(const ShadowPlan& plan, OmissionKind kind) {
  const auto list = plan.omitted();
  return static_cast<std::size_t>(
      std::count_if(list.begin(), list.end(), [kind](const Omission& o) { return o.kind == kind; }));
}

TEST(ReceiverClusters, give_islands_side_by_side_a_map_each_which_cascades_cannot) {
  const Scene scene(two_islands());
  const ShadowPlan plan = scene.plan(), cascades = scene.cascades();
  ASSERT_EQ(plan.map_count, 2);
  EXPECT_NE(plan.selection, MapSelection::view_depth);
  EXPECT_EQ(count_of(plan, OmissionKind::partition_without_gain), 0u);
  EXPECT_LT(scene.storage(plan), 0.1 * scene.storage(cascades));
  // Each serves its own island.
  const glm::dvec3 left{-55, 4, 95}, right{55, 4, 95};
  EXPECT_NE(map_serving(plan, left, 95.0), map_serving(plan, right, 95.0));
  EXPECT_GE(map_serving(plan, left, 95.0), 0);
  EXPECT_GE(map_serving(plan, right, 95.0), 0);
}

TEST(ReceiverClusters, hold_every_island_in_as_many_maps_as_were_requested) {
  std::vector<Box> boxes;
  for (int i = 0; i < 20; ++i) {
    const double z = 20.0 + 13.0 * i, x = (i % 5 - 2) * 0.35 * z;
    boxes.push_back({{x - 3, 0, z - 3}, {x + 3, 3, z + 3}});
  }
  for (const int cascades : {1, 2, 3, 5, kMaxMaps}) {
    Scene scene(boxes);
    scene.options.cascades = cascades;
    const ShadowPlan plan = scene.plan();
    ASSERT_EQ(plan.status, PlanStatus::ok);
    EXPECT_LE(plan.map_count, cascades);
    for (const Box& box : boxes) {
      const glm::dvec3 top{0.5 * (box.min.x + box.max.x), box.max.y, 0.5 * (box.min.z + box.max.z)};
      EXPECT_GE(map_serving(plan, top, top.z), 0) << cascades << " at " << top.z;
    }
  }
}

TEST(ReceiverClusters, save_texels_where_many_islands_share_few_maps) {
  std::vector<Box> boxes;
  for (int i = 0; i < 12; ++i) {
    const double z = 30.0 + 20.0 * (i % 6), x = (i * 5 % 12 - 5.5) * 0.12 * z;
    boxes.push_back({{x - 3, 0, z - 3}, {x + 3, 3, z + 3}});
  }
  Scene scene(boxes);
  for (const auto& [cascades, share] : {std::pair{4, 0.9}, {8, 0.5}}) {
    scene.options.cascades = cascades;
    EXPECT_LT(scene.storage(scene.plan()), share * scene.storage(scene.cascades())) << cascades;
  }
}

TEST(ReceiverClusters, are_no_worse_than_as_many_cascades_where_receivers_are_everywhere) {
  Scene scene({{{-1e3, -1, -1e3}, {1e3, 0, 1e3}}});
  for (const Warp* warp : {&warps::none, &warps::optimal}) {
    for (const int cascades : {2, 4}) {
      scene.options.warp.warp = warp;
      scene.options.cascades = cascades;
      EXPECT_LT(scene.storage(scene.plan()), 1.01 * scene.storage(scene.cascades()))
          << warp->name << " " << cascades;
    }
  }
}

TEST(ReceiverClusters, serve_degenerate_receivers) {
  const std::vector<std::vector<Box>> hard{
      {{{0, 0, 50}, {0, 0, 50}}},                              // a point
      {{{-5, 0, 50}, {5, 0, 60}}, {{-5, 0, 50}, {5, 0, 60}}},  // the same sheet twice
      {{{-1, 0, 50}, {1, 1e-9, 50 + 1e-9}}, {{1, 0, 50}, {3, 1, 52}}},
  };
  for (const auto& boxes : hard) {
    for (const Objective objective :
         {Objective::storage, Objective::max, Objective::p95, Objective::picture}) {
      Scene scene(boxes);
      scene.options.warp.objective = objective;
      scene.options.cascades = kMaxMaps;
      const ShadowPlan plan = scene.plan(), cascades = scene.cascades();
      EXPECT_EQ(plan.status, cascades.status);
      for (const ShadowMap& map : plan.maps()) EXPECT_GT(map.depth_range_world, 0.0);
      for (const Box& box : boxes) {
        const glm::dvec3 middle = 0.5 * (box.min + box.max);
        EXPECT_EQ(map_serving(plan, middle, middle.z) >= 0, map_serving(cascades, middle, middle.z) >= 0);
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
