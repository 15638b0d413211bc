// Where one map passes into the next: is the passage what both maps say, and does each of them know the
// casters?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

const glm::dvec3 kSteep = glm::normalize(glm::dvec3(0.35, -1.0, 0.1));

/// Rows of low boxes away from the camera: whatever the split, some stand just before it and shadow no
/// receiver behind it.
std::vector<Box> rows_of_boxes() {
  std::vector<Box> boxes;
  for (int row = 0; row < 14; ++row) {
    for (int column = -3; column <= 3; ++column) {
      const glm::dvec3 foot{1.6 * column, 0.0, 10.0 - 2.0 * row};
      boxes.push_back({foot, foot + glm::dvec3(0.7, 1.2, 0.5)});
    }
  }
  return boxes;
}

Scene rows_on_ground() {
  Scene scene = empty_scene();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, add_material(scene, {}));
  for (const Box& box : rows_of_boxes()) add_box(scene, glm::vec3(box.min), glm::vec3(box.max));
  return scene;
}

Camera along_the_rows() {
  return perspective_camera({0.3, 4.0, 14.0}, {0.0, -0.3, -1.0}, {0, 1, 0}, 0.9, 1.0, 0.5, 60.0, kSize,
                            kSize);
}

PlanOptions two_maps(const Filter& filter, double overlap) {
  PlanOptions options;
  options.resolution.max_size = 512;
  options.cascades = 2;
  options.split.overlap = overlap;
  set_margin(default_settings(filter), options);
  return options;
}

double depth_at(const Frame& frame, std::size_t i) {
  return frame.positions.values[4 * i + 3];
}

/// The same maps, each asked for all of the overlap in turn.
struct Passage {
  ShadowPlan plan;
  double begin, end;  ///< view depths
  Frame before, behind;
};
Passage draw_both(Renderer& renderer, const ShadowPlan& plan, const Filter& filter, double overlap) {
  Passage passage{plan, plan.map[1].depth_begin - overlap, plan.map[1].depth_begin, {}, {}};
  const Camera camera = along_the_rows();
  passage.before = draw(renderer, camera, plan, filter);
  ShadowPlan earlier = plan;
  earlier.map[0].depth_end = earlier.map[1].depth_begin = passage.begin;
  passage.behind = draw(renderer, camera, earlier, filter);
  return passage;
}

/// Of the pixels on the ground within the passage whose answer is the same a texel or two around: those that
/// the map behind lights though a box shadows them, and those that it shadows though none does.
struct Wrong {
  int judged = 0, leaks = 0, false_shadows = 0;
};
Wrong wrong_behind(const Passage& passage) {
  constexpr double kAround = 0.12;  // world units; texels of these maps are below 0.06
  const std::vector<Box> boxes = rows_of_boxes();
  const auto shadowed = [&](const glm::dvec3& p) {
    return std::any_of(boxes.begin(), boxes.end(),
                       [&](const Box& box) { return hits_box(p, -kSteep, box.min, box.max); });
  };
  Wrong wrong;
  for (std::size_t i = 0; i < passage.behind.pixels(); ++i) {
    const double depth = depth_at(passage.behind, i);
    const glm::dvec3 p = passage.behind.point(i);
    if (!passage.behind.surface(i) || depth < passage.begin || depth > passage.end || p.y > 0.001) continue;
    int dark = 0;
    for (const double x : {-kAround, kAround}) {
      for (const double z : {-kAround, kAround}) dark += shadowed(p + glm::dvec3(x, 1e-4, z)) ? 1 : 0;
    }
    if (dark != 0 && dark != 4) continue;
    ++wrong.judged;
    if (dark == 4 && passage.behind.lit(i) > 0.0f) ++wrong.leaks;
    if (dark == 0 && passage.behind.lit(i) < 1.0f) ++wrong.false_shadows;
  }
  return wrong;
}

TEST(Transition, the_map_behind_knows_all_casters_of_the_overlap_and_without_one_it_does_not) {
  const Scene scene = rows_on_ground();
  Renderer renderer(scene);
  const Camera camera = along_the_rows();
  const ShadowPlan plan = plan_for(scene, camera, kSteep, two_maps(filters::hard, 0.4));
  ASSERT_EQ(plan.map_count, 2);
  ASSERT_GT(plan.map[1].overlap, 1.0);
  const Wrong with = wrong_behind(draw_both(renderer, plan, filters::hard, plan.map[1].overlap));
  EXPECT_GT(with.judged, 500);
  EXPECT_EQ(with.leaks, 0);
  EXPECT_EQ(with.false_shadows, 0);
  const ShadowPlan cut = plan_for(scene, camera, kSteep, two_maps(filters::hard, 0.0));
  const Wrong without = wrong_behind(draw_both(renderer, cut, filters::hard, plan.map[1].overlap));
  EXPECT_GT(without.leaks, 0) << "nothing was there to leak";
}

TEST(Transition, a_blend_is_the_mean_of_both_maps_weighted_by_the_way_through_the_overlap) {
  const Scene scene = rows_on_ground();
  Renderer renderer(scene);
  for (const Filter* filter : {&filters::hard, &filters::pcf, &filters::vsm}) {
    const ShadowPlan plan = plan_for(scene, along_the_rows(), kSteep, two_maps(*filter, 0.4));
    ASSERT_EQ(plan.map_count, 2);
    const Passage passage = draw_both(renderer, plan, *filter, plan.map[1].overlap);
    FrameOptions options;
    options.transition = SplitTransition::blend;
    const Frame blend = draw(renderer, passage.before.camera, plan, default_settings(*filter), options);
    int within = 0, different = 0;
    for (std::size_t i = 0; i < blend.pixels(); ++i) {
      const double way =
          std::clamp((depth_at(blend, i) - passage.begin) / (passage.end - passage.begin), 0.0, 1.0);
      const double near = passage.before.lit(i), far = passage.behind.lit(i);
      constexpr double kFloat = 1e-4;  // depths of 20 over an overlap of 2, in float
      ASSERT_NEAR(blend.lit(i), near + way * (far - near), kFloat)
          << filter->info.name << " at " << depth_at(blend, i);
      if (way > 0.0 && way < 1.0) ++within;
      if (way > 0.0 && way < 1.0 && std::abs(near - far) > 0.1) ++different;
    }
    EXPECT_GT(within, 500) << filter->info.name;
    EXPECT_GT(different, 2) << filter->info.name << ": both maps say the same, so nothing was mixed";
  }
}

TEST(Transition, a_dither_takes_either_map_and_the_next_one_as_often_as_the_way_through_the_overlap) {
  const Scene scene = rows_on_ground();
  Renderer renderer(scene);
  const ShadowPlan plan = plan_for(scene, along_the_rows(), kSteep, two_maps(filters::pcf, 0.4));
  ASSERT_EQ(plan.map_count, 2);
  const Passage passage = draw_both(renderer, plan, filters::pcf, plan.map[1].overlap);
  FrameOptions options;
  options.transition = SplitTransition::dither;
  const Frame dither = draw(renderer, passage.before.camera, plan, default_settings(filters::pcf), options);
  double expected = 0.0, taken = 0.0, within = 0.0;
  for (std::size_t i = 0; i < dither.pixels(); ++i) {
    const bool next = dither.map(i) == 1;
    ASSERT_NEAR(dither.lit(i), next ? passage.behind.lit(i) : passage.before.lit(i), kWeightRounding) << i;
    const double way = (depth_at(dither, i) - passage.begin) / (passage.end - passage.begin);
    const bool asked =
        dither.surface(i) && glm::dot(dither.normal(i), kSteep) < 0.0;  // others are dark by themselves
    if (!asked || way < 0.0 || way > 1.0) continue;
    within += 1.0;
    expected += way;
    taken += next ? 1.0 : 0.0;
  }
  EXPECT_GT(within, 500.0);
  EXPECT_NEAR(taken / within, expected / within, 0.02);
}

TEST(Transition, without_an_overlap_in_the_plan_every_transition_is_a_cut) {
  const Scene scene = rows_on_ground();
  Renderer renderer(scene);
  const Camera camera = along_the_rows();
  const ShadowPlan plan = plan_for(scene, camera, kSteep, two_maps(filters::pcf, 0.0));
  ASSERT_EQ(plan.map_count, 2) << "no split to pass over";
  const Frame cut = draw(renderer, camera, plan, filters::pcf);
  EXPECT_GT(std::count(cut.mask.values.begin(), cut.mask.values.end(), 0.0f), 100) << "no shadow";
  for (const SplitTransition transition : {SplitTransition::blend, SplitTransition::dither}) {
    FrameOptions options;
    options.transition = transition;
    EXPECT_EQ(draw(renderer, camera, plan, default_settings(filters::pcf), options).mask.values,
              cut.mask.values);
  }
}

}  // namespace
}  // namespace gnomon::render
