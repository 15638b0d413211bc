// Does a plan that remembers the frame before it keep what a plan promises, whatever comes into view?
#include "gnomon/history.hpp"

#include <gtest/gtest.h>

#include "support/finite.hpp"
#include "support/seeded_input.hpp"

namespace gnomon::test {
namespace {

// A cascade without a map in one frame may have one in the next: its size is not remembered.
TEST(PlanHistory, fits_maps_within_the_budget_for_cascades_that_had_none) {
  SeededInput in;
  int appeared = 0, budgeted = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    seed_input(seed, Extremes::ordinary, in);
    PlanHistory history;
    for (int frame = 0; frame < 3; ++frame) {
      const ShadowPlan plan = make_plan(in.camera, in.light, in.bounds(), in.options, history);
      std::int64_t texels = 0;
      for (const ShadowMap& map : plan.maps()) {
        ASSERT_GE(map.width, 4) << "case " << seed << ", frame " << frame;
        ASSERT_GE(map.height, 4) << "case " << seed << ", frame " << frame;
        ASSERT_TRUE(all_finite(map.clip_from_world)) << "case " << seed << ", frame " << frame;
        texels += std::int64_t{map.width} * map.height;
      }
      if (in.options.resolution.texel_budget > 0 && in.options.split.partition == Partition::view_depth) {
        ASSERT_LE(texels, in.options.resolution.texel_budget) << "case " << seed << ", frame " << frame;
        budgeted += texels > 0 ? 1 : 0;
      }
      for (const PlanEvent& event : history.events())
        appeared += frame > 0 && event.kind == PlanEventKind::map_appeared ? 1 : 0;
      in.camera.position += in.camera.forward * 0.01;
    }
  }
  EXPECT_GT(appeared, 10) << "the case that this is about";
  EXPECT_GT(budgeted, 10) << "plans with maps and a budget";
}

TEST(PlanHistory, searches_from_nothing_after_a_while_and_under_other_options) {
  const Camera camera =
      perspective_camera({0, 5, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 200.0, 640, 400);
  const std::vector<Box> boxes = {{{-100, -1, -100}, {100, 0, 100}}, {{-5, 0, -30}, {5, 8, -20}}};
  PlanOptions options;
  options.cascades = 1;
  PlanHistory history;
  const auto plan = [&] {
    return make_plan(camera, DirectionalLight{{0.3, -1, 0.2}}, {boxes, boxes}, options, history).map_count;
  };
  ASSERT_EQ(plan(), 1);
  const std::int64_t first = history.map[0].searched.until;
  EXPECT_LT(history.map[0].searched.gain_ratio, 1.0);
  while (history.frame < first) {
    ASSERT_EQ(plan(), 1);
    ASSERT_EQ(history.map[0].searched.until, first)
        << "follows the first result in frame " << history.frame - 1;
  }
  ASSERT_EQ(plan(), 1);
  EXPECT_GT(history.map[0].searched.until, first);
  const std::int64_t second = history.map[0].searched.until;
  ASSERT_EQ(plan(), 1);
  EXPECT_EQ(history.map[0].searched.until, second);
  options.warp.objective = Objective::p95;
  ASSERT_EQ(plan(), 1);
  EXPECT_GT(history.map[0].searched.until, second) << "another objective has another best warp";
}

}  // namespace
}  // namespace gnomon::test
