// Do a texel budget and a target error give the maps that they promise?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gnomon/gnomon.hpp"
#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// A plain seen from above its near end.
struct Plain {
  Camera camera = perspective_camera({0, 5, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 200, 960, 640);
  std::vector<Box> casters = {{{-90, 0, -200}, {90, 5, -1}}}, receivers = {{{-90, -1, -200}, {90, 0, -1}}};
  Light light = DirectionalLight{{0.2, -1, 0.1}};
  PlanOptions options;
  [[nodiscard]] ShadowPlan plan() const { return make_plan(camera, light, {casters, receivers}, options); }
};

std::int64_t texels(const ShadowPlan& plan) {
  return std::accumulate(
      plan.maps().begin(), plan.maps().end(), std::int64_t{0},
      [](std::int64_t sum, const ShadowMap& map) { return sum + std::int64_t{map.width} * map.height; });
}
double worst(const ShadowPlan& plan) {
  double m = 0.0;
  for (const ShadowMap& map : plan.maps()) m = std::max({m, map.m_s_max, map.m_t_max});
  return m;
}

TEST(Budget, equal_maps_of_the_same_texels_have_a_worse_worst_map) {
  for (const Warp* warp : {&warps::none, &warps::optimal}) {
    Plain plain;
    plain.options.warp.warp = warp;
    plain.options.split.scheme = SplitScheme::uniform;
    const ShadowPlan equal = plain.plan();
    plain.options.resolution.texel_budget = texels(equal);
    const ShadowPlan budgeted = plain.plan();
    EXPECT_LE(texels(budgeted), plain.options.resolution.texel_budget);
    EXPECT_LT(worst(budgeted), 0.8 * worst(equal)) << warp->name;
  }
}

TEST(Budget, errors_are_equal_within_a_step_of_the_sides_whatever_the_border) {
  for (const double kernel : {1.0, 32.0}) {
    Plain plain;
    plain.options.warp.objective = Objective::storage;
    plain.options.filter.texels = kernel;
    plain.options.resolution.texel_budget = 4 << 20;
    const ShadowPlan plan = plain.plan();
    ASSERT_GT(plan.map_count, 1);
    int shortest = plan.map[0].width;
    for (const ShadowMap& map : plan.maps()) shortest = std::min({shortest, map.width, map.height});
    // Sides are rounded down by less than a step, of which the shortest has the least.
    const double rounded = shortest - 2.0 * plan.map[0].filter_margin_texels;
    const double least = worst(plan) / (1.0 + kSizeStep / rounded);
    for (const ShadowMap& map : plan.maps()) {
      EXPECT_EQ(map.width % kSizeStep, 0);
      EXPECT_EQ(map.height % kSizeStep, 0);
      EXPECT_GT(map.m_s_max, least) << map.cascade << ", kernel " << kernel;
      EXPECT_GT(map.m_t_max, least) << map.cascade << ", kernel " << kernel;
    }
  }
}

/// The mean over points of the plain of a texel's extent in any direction, pixels.
double mean_error(const ShadowPlan& plan, const Camera& camera) {
  const CameraAxes axes = camera_axes(camera);
  double sum = 0.0, count = 0.0;
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 60; ++column) {
      const glm::dvec3 ray = axes.forward +
                             axes.right * (camera.left + (camera.right - camera.left) * (column + 0.5) / 60) +
                             axes.up * (camera.bottom + (camera.top - camera.bottom) * (row + 0.5) / 60);
      const double depth = -camera.position.y / ray.y;
      const glm::dvec3 point = camera.position + ray * depth;
      const int map = map_serving(plan, point, depth);
      if (!(depth > 0.0) || map < 0) continue;
      const PointAliasing m = measure_perspective(plan.map[static_cast<std::size_t>(map)], camera, point);
      if (m.status != PointAliasing::Status::ok) continue;  // beside the plain
      sum += std::sqrt(0.5 * (m.perspective_s * m.perspective_s + m.perspective_t * m.perspective_t));
      count += 1.0;
    }
  }
  return sum / count;
}

TEST(Budget, by_the_picture_has_a_lower_mean_error_than_equal_maps_and_than_equal_errors) {
  for (const SplitScheme scheme : {SplitScheme::automatic, SplitScheme::uniform}) {
    Plain plain;
    plain.options.split.scheme = scheme;
    const ShadowPlan equal = plain.plan();
    plain.options.resolution.texel_budget = texels(equal);
    const ShadowPlan by_picture = plain.plan();
    plain.options.warp.objective = Objective::max;
    const ShadowPlan by_worst = plain.plan();
    EXPECT_LE(texels(by_picture), plain.options.resolution.texel_budget);
    EXPECT_LT(mean_error(by_picture, plain.camera), 0.95 * mean_error(equal, plain.camera));
    EXPECT_LT(mean_error(by_picture, plain.camera), mean_error(by_worst, plain.camera));
    // Every map keeps texels, also one that few points are in.
    for (const ShadowMap& map : by_picture.maps())
      EXPECT_GE(std::min(map.width, map.height), 64) << map.cascade;
  }
}

TEST(Budget, a_stable_map_stays_square) {
  Plain plain;
  plain.options.resolution.texel_budget = 1 << 20;
  plain.options.fit = Fit::stable;
  const ShadowPlan plan = plain.plan();
  EXPECT_GT(plan.map_count, 0);
  for (const ShadowMap& map : plan.maps()) EXPECT_EQ(map.width, map.height);
}

TEST(Budget, faces_of_a_point_light_share_it_too) {
  Plain plain;
  plain.light = PointLight{{10, 8, -12}, 60};
  plain.options.warp.warp = &warps::none;
  const ShadowPlan equal = plain.plan();
  ASSERT_GT(equal.map_count, 1);
  plain.options.resolution.texel_budget = texels(equal);
  const ShadowPlan budgeted = plain.plan();
  EXPECT_LE(texels(budgeted), plain.options.resolution.texel_budget);
  EXPECT_LT(worst(budgeted), worst(equal));
}

TEST(Budget, any_budget_is_kept_and_spent) {
  for_all(200, [] {
    Case c = draw_case();
    const int least = least_budget_side(c.options);
    const std::int64_t smallest = std::int64_t{least} * least * c.options.cascades;
    c.options.resolution.texel_budget =
        static_cast<std::int64_t>(static_cast<double>(smallest) * std::exp(6.0 * unit()));
    const ShadowPlan plan = c.plan();
    require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
    require(texels(plan) <= c.options.resolution.texel_budget, texels(plan), "of",
            c.options.resolution.texel_budget);
  });
}

/// The bound that max_error is about.
double bound(const ShadowPlan& plan) {
  double m = 0.0;
  for (const ShadowMap& map : plan.maps()) m = std::max(m, map.m_max);
  return m;
}

TEST(Target, the_fewest_maps_that_meet_it_are_taken) {
  Plain plain;
  plain.options.cascades = kMaxMaps;
  for (int maps = 1; maps <= 5; ++maps) {
    Plain fixed;
    fixed.options.cascades = maps;
    const double m = bound(fixed.plan());
    plain.options.resolution.max_error = m * 1.001;
    const ShadowPlan plan = plain.plan();
    EXPECT_EQ(plan.map_count, maps);
    EXPECT_LE(bound(plan), plain.options.resolution.max_error);
  }
}

TEST(Target, maps_that_are_made_smaller_still_meet_it) {
  Plain plain;
  plain.options.resolution.max_size = 8192;
  plain.options.resolution.max_error = 0.25;  // below prune_m
  const ShadowPlan plan = plain.plan();
  ASSERT_GT(plan.map_count, 0);
  EXPECT_LT(texels(plan), std::int64_t{plan.map_count} * 8192 * 8192) << "some are made smaller";
  EXPECT_LE(bound(plan), 0.25);
}

TEST(Target, an_unattainable_target_gives_the_best_there_is) {
  Plain plain;
  plain.options.resolution.max_error = 1e-9;
  EXPECT_LE(bound(plain.plan()), bound(Plain{}.plan()) * 1.01);
}

TEST(Target, with_a_budget_it_is_met_by_fewer_maps_of_more_texels) {
  Plain plain;
  plain.options.cascades = kMaxMaps;
  plain.options.resolution.texel_budget = 8 << 20;
  const ShadowPlan best = plain.plan();
  plain.options.resolution.max_error = 2.0 * bound(best);
  const ShadowPlan enough = plain.plan();
  EXPECT_LT(enough.map_count, best.map_count);
  // The rim's share changes with the size, and with it the warp.
  EXPECT_LE(bound(enough), plain.options.resolution.max_error * 1.02);
}

TEST(Budget, sizes_are_stable_under_a_slow_camera) {
  Plain plain;
  plain.options.resolution.texel_budget = 1 << 20;
  PlanHistory history;
  const SceneBounds bounds{plain.casters, plain.receivers};
  ShadowPlan last = make_plan(plain.camera, plain.light, bounds, plain.options, &history);
  for (int frame = 0; frame < 20; ++frame) {
    plain.camera.position.z -= 0.02;
    const ShadowPlan plan = make_plan(plain.camera, plain.light, bounds, plain.options, &history);
    ASSERT_EQ(plan.map_count, last.map_count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(plan.map_count); ++i)
      EXPECT_EQ(plan.map[i].width, last.map[i].width) << frame;
    last = plan;
  }
}

TEST(Budget, more_texels_than_the_largest_maps_take_give_the_largest_map) {
  Plain plain;
  plain.options.filter.texels = 0.0;
  plain.options.resolution.texel_budget = std::int64_t{kMaxMaps} * kMaxMapSize * kMaxMapSize;
  const ShadowPlan plan = plain.plan();
  int longest = 0;
  for (const ShadowMap& map : plan.maps()) longest = std::max({longest, map.width, map.height});
  EXPECT_EQ(longest, kMaxMapSize);
}

}  // namespace
}  // namespace gnomon::test
