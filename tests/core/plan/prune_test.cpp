// What does the plan leave out, and can each rule be switched off?
#include "gnomon/options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/gnomon.hpp"
#include "support/finite.hpp"

namespace gnomon::test {
namespace {

/// Ground with a wall on it, and nothing in view between 12 and 80 units of depth.
struct Valley {
  Camera camera = perspective_camera({0, 4, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 400.0, 960, 640);
  std::array<Box, 3> boxes{Box{{-8, -1, -12}, {8, 0, 0}}, Box{{-60, -60, -300}, {60, -59, -80}},
                           Box{{-1, 0, -9}, {1, 2, -8}}};
  DirectionalLight sun{{0.3, -1, -0.2}};
  PlanOptions options;
  [[nodiscard]] ShadowPlan plan() const { return make_plan(camera, sun, {boxes, boxes}, options); }
};

TEST(Prune, rules_are_read_by_name) {
  PruneRules rules = kPruneNothing;
  EXPECT_TRUE(parse_prune_rules("all", rules));
  EXPECT_EQ(rules, PruneRules{});
  EXPECT_TRUE(parse_prune_rules("none", rules));
  EXPECT_EQ(rules, kPruneNothing);
  EXPECT_TRUE(parse_prune_rules("held_maps,swept_casters", rules));
  EXPECT_EQ(rules, kPruneNothing.with(PruneRule::held_maps).with(PruneRule::swept_casters));
  for (const char* wrong : {"", ",", "held_maps,", "held", "All", "held_maps swept_casters"}) {
    EXPECT_FALSE(parse_prune_rules(wrong, rules)) << wrong;
  }
  EXPECT_TRUE(rules.has(PruneRule::held_maps)) << "a refused text changes nothing";
}

TEST(Prune, only_cached_and_scrolled_maps_draw_from_the_last_frame) {
  const PruneRules cached =
      kPruneNothing.with(PruneRule::held_maps).with(PruneRule::scrolled_maps).with(PruneRule::static_casters);
  EXPECT_EQ(prune_rules_of(PruneSource::last_frame), cached);
  EXPECT_EQ(prune_rules_of(PruneSource::this_frame).bits, PruneRules::kAll & ~cached.bits);
}

TEST(Prune, a_plan_says_whether_its_map_sizes_follow_the_view) {
  Valley valley;
  EXPECT_FALSE(valley.plan().sizes_vary) << "bounded rules are off by default";
  valley.options.prune = PruneRules::all();
  EXPECT_TRUE(valley.plan().sizes_vary);
  valley.options.prune = exact_prune_rules();
  EXPECT_FALSE(valley.plan().sizes_vary);
  valley.options.resolution.max_error = 0.5;
  EXPECT_TRUE(valley.plan().sizes_vary);
  valley.options.resolution.max_error = 0.0;
  valley.options.resolution.texel_budget = 1 << 20;
  EXPECT_TRUE(valley.plan().sizes_vary);
  valley.options = {};
  valley.options.prune = PruneRules::all();
  valley.options.fit = Fit::stable;
  EXPECT_FALSE(valley.plan().sizes_vary) << "a stable grid is never pruned by the metric";
}

TEST(Prune, every_rule_says_what_it_takes_for_granted_and_why_nothing_is_lost) {
  std::size_t at = 0;
  for (const PruneRuleInfo& info : prune_rules()) {
    EXPECT_EQ(static_cast<std::size_t>(info.rule), at++);
    EXPECT_FALSE(info.name.empty() || info.what.empty() || info.premise.empty() || info.proof.empty());
    PruneRules alone = kPruneNothing;
    EXPECT_TRUE(parse_prune_rules(info.name, alone));
    EXPECT_EQ(alone, kPruneNothing.with(info.rule));
    EXPECT_EQ(find_prune_rule(info.name), &info);
    EXPECT_EQ(exact_prune_rules().has(info.rule), info.certainty == PruneCertainty::exact);
  }
}

TEST(Prune, a_cascade_without_receivers_gets_a_map_only_where_the_rule_is_off) {
  Valley valley;
  valley.options.split.scheme = SplitScheme::given;
  const std::array splits{14.0, 70.0};
  std::copy(splits.begin(), splits.end(), valley.options.split.given.begin());
  valley.options.cascades = 3;
  const ShadowPlan pruned = valley.plan();
  ASSERT_EQ(pruned.map_count, 2);
  EXPECT_EQ(pruned.map[1].cascade, 2);
  valley.options.prune =
      valley.options.prune.without(PruneRule::empty_cascades).without(PruneRule::casterless_cascades);
  const ShadowPlan full = valley.plan();
  ASSERT_EQ(full.map_count, 3);
  EXPECT_EQ(full.map[1].depth_begin, 14.0);
  EXPECT_EQ(full.map[1].depth_end, 70.0);
  for (const int same : {0, 2}) {
    EXPECT_EQ(full.map[static_cast<std::size_t>(same)].clip_from_world,
              pruned.map[same == 0 ? 0 : 1].clip_from_world);
  }
}

TEST(Prune, a_cascade_without_casters_gets_a_map_only_where_the_rule_is_off) {
  Valley valley;
  const std::array<Box, 1> wall{valley.boxes[2]};
  valley.options.cascades = 2;
  const auto plan = [&] {
    return make_plan(valley.camera, valley.sun, {wall, valley.boxes}, valley.options);
  };
  const ShadowPlan pruned = plan();
  ASSERT_EQ(pruned.map_count, 1);
  valley.options.prune = valley.options.prune.without(PruneRule::casterless_cascades);
  const ShadowPlan full = plan();
  ASSERT_EQ(full.map_count, 2);
  for (const ShadowMap& map : full.maps()) {
    EXPECT_TRUE(all_finite(map.clip_from_world));
    EXPECT_GT(map.depth_range_world, 0.0);
  }
}

TEST(Prune, maps_become_no_smaller_than_the_metric_allows_and_the_plan_says_by_how_much) {
  Valley valley;
  for (const double m : {0.5, 1.0, 4.0}) {
    for (const int size : {512, 4096}) {
      valley.options.resolution.max_size = size;
      valley.options.resolution.prune_error = m;
      valley.options.prune = PruneRules{};
      const ShadowPlan pruned = valley.plan();
      valley.options.prune = valley.options.prune.without(PruneRule::metric_resolution);
      const ShadowPlan full = valley.plan();
      ASSERT_EQ(pruned.map_count, full.map_count);
      std::int64_t saved = 0, listed = 0;
      for (int i = 0; i < full.map_count; ++i) {
        const ShadowMap &a = full.map[static_cast<std::size_t>(i)],
                        &b = pruned.map[static_cast<std::size_t>(i)];
        saved += std::int64_t{a.width} * a.height - std::int64_t{b.width} * b.height;
        EXPECT_LE(b.m_s_max, std::max(m, a.m_s_max * (1.0 + 1e-9))) << i;
        EXPECT_LE(b.m_t_max, std::max(m, a.m_t_max * (1.0 + 1e-9))) << i;
      }
      for (const Omission& o : pruned.omitted())
        if (o.kind == OmissionKind::resolution_without_gain) listed += o.saves_texels;
      EXPECT_EQ(saved, listed);
      if (size == 4096 && m >= 1.0) {
        EXPECT_GT(saved, 0);
      }
    }
  }
}

/// The largest perspective error along either axis at points of the receivers in view.
double measured_error(const Valley& valley, const ShadowPlan& plan, std::uint64_t seed, int& points) {
  const Camera& camera = valley.camera;
  const CameraAxes axes = camera_axes(camera);
  double worst = 0.0;
  for (const Box& box : valley.boxes) {
    for (int i = 0; i < 200; ++i) {
      glm::dvec3 p;
      for (int c = 0; c < 3; ++c) {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        p[c] = box.min[c] + (box.max[c] - box.min[c]) * static_cast<double>(seed >> 11) * 0x1p-53;
      }
      const glm::dvec3 away = p - camera.position;
      const double depth = glm::dot(axes.forward, away);
      const double x = glm::dot(axes.right, away) / depth, y = glm::dot(axes.up, away) / depth;
      if (depth < camera.near_depth || x < camera.left || x > camera.right || y < camera.bottom ||
          y > camera.top)
        continue;
      const int map = map_serving(plan, p, depth);
      if (map < 0) continue;
      const PointAliasing m = measure_perspective(plan.map[static_cast<std::size_t>(map)], camera, p);
      if (m.status != PointAliasing::Status::ok) continue;
      worst = std::max(worst, m.perspective_max);
      ++points;
    }
  }
  return worst;
}

TEST(Prune, random_maps_meet_the_bound_that_made_them_smaller_where_it_is_measured) {
  int smaller = 0, points = 0;
  double largest = 0.0;
  for (int i = 0; i < 300; ++i) {
    Valley valley;
    const double t = 0.01 * i;
    valley.camera = perspective_camera({4.0 * std::sin(t), 1.0 + 3.0 * std::cos(7.0 * t), 2.0 * t},
                                       {std::sin(2.0 * t), -0.3, -1.0}, {0, 1, 0}, 0.5 + 0.002 * i, 1.5, 0.2,
                                       400.0, 640, 400);
    valley.options.resolution.max_size = 8192;
    valley.options.prune = PruneRules::all();
    const ShadowPlan plan = valley.plan();
    bool all_small = plan.map_count > 0;
    for (const ShadowMap& map : plan.maps()) all_small = all_small && map.m_max <= 1.0;
    for (const Omission& o : plan.omitted()) {
      if (o.kind != OmissionKind::resolution_without_gain) continue;
      ++smaller;
      // One side may have had more to begin with.
      EXPECT_LE(o.b, std::max(1.0, o.a * (1.0 + 1e-9))) << i;
    }
    if (!all_small) continue;
    const double error = measured_error(valley, plan, static_cast<std::uint64_t>(i), points);
    largest = std::max(largest, error);
    EXPECT_LE(error, 1.0) << i;
  }
  EXPECT_GT(smaller, 50);
  EXPECT_GT(points, 1000);
  EXPECT_GT(largest, 0.5) << "maps are far larger than the metric needs";
}

}  // namespace
}  // namespace gnomon::test
