// Does a pool that keeps pages hold the same texels, bit for bit, as one that draws them all in every frame?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <vector>

#include "gnomon/render/renderer.hpp"
#include "mask_frame.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

/// Two renderers of one scene go the same way: one keeps pages, the other draws them all.
struct Pair {
  Scene scene;
  Light light = DirectionalLight{kSlant};
  Renderer keeps, redraws;
  std::vector<Box> boxes;
  PageOptions pages;
  std::vector<std::byte> memory = std::vector<std::byte>(page_memory(4096, 1 << 17));
  FilterSettings filter = default_settings(filters::hard);
  std::size_t kept = 0, all = 0;

  explicit Pair(const Scene& of) : scene(of), keeps(scene), redraws(scene), boxes(boxes_of(scene)) {
    pages.plan.fit = Fit::stable;
    set_margin(filter, pages.plan);
    pages.page_texels = 64;
    pages.fallback = true;
  }
  PagePlan plan(const Camera& camera) {
    const Frame seen = render::draw(redraws_of_surfaces(), camera, ShadowPlan{}, filters::hard);
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < seen.pixels(); i += 3) {
      if (seen.surface(i)) points.push_back(seen.point(i));
    }
    return plan_pages({.camera = camera, .points_world = points}, light, {boxes, boxes}, pages, memory);
  }
  /// Draws a frame with both; returns the texels of resident pages that differ.
  std::size_t stale(const Camera& camera, std::span<const Box> moved = {}) {
    const PagePlan frame = plan(camera);
    EXPECT_EQ(frame.status, PlanStatus::ok);
    FrameOptions draw_options;
    draw_options.time_passes = false;
    draw_options.moved_world = moved;
    last = keeps.draw(frame, camera, keeps.prepare(filter, Source::pages), draw_options);
    draw_options.prune = draw_options.prune.without(PruneRule::held_maps);
    const FrameStats whole =
        redraws.draw(frame, camera, redraws.prepare(filter, Source::pages), draw_options);
    EXPECT_EQ(whole.pages_drawn, whole.pages);
    EXPECT_EQ(static_cast<std::size_t>(last.pages), frame.pages.size());
    kept += static_cast<std::size_t>(last.pages - last.pages_drawn);
    int drew = 0;
    for (std::size_t i = 0; i < frame.pages.size(); ++i) {
      drew += keeps.drew_page(i) ? 1 : 0;
      EXPECT_TRUE(redraws.drew_page(i)) << i;
    }
    EXPECT_EQ(drew, last.pages_drawn);
    EXPECT_FALSE(keeps.drew_page(frame.pages.size()));
    all += frame.pages.size();
    std::size_t differ = 0;
    for (std::size_t i = 0; i < frame.pages.size(); ++i) {
      const std::vector<float> a = keeps.page_depths(i).values, b = redraws.page_depths(i).values;
      EXPECT_EQ(a.size(), static_cast<std::size_t>(frame.slot_texels() * frame.slot_texels()));
      for (std::size_t k = 0; k < a.size(); ++k) differ += a[k] != b[k];
    }
    const FloatImage kept_mask = keeps.mask(), whole_mask = redraws.mask();
    EXPECT_EQ(kept_mask.values, whole_mask.values);
    return differ;
  }
  /// Moves an instance of both.
  void move(std::size_t instance, const glm::dvec3& by) {
    Instance& at = scene.instances[instance];
    at.world_from_object = glm::translate(glm::dmat4(1.0), by) * at.world_from_object;
    at.bounds_world = {at.bounds_world.min + by, at.bounds_world.max + by};
    boxes[instance] = at.bounds_world;
    ASSERT_TRUE(keeps.move_instance(instance, at));
    ASSERT_TRUE(redraws.move_instance(instance, at));
  }
  FrameStats last;

 private:
  // A frame without maps leaves the pool alone.
  Renderer& redraws_of_surfaces() { return surfaces_; }
  Renderer surfaces_{scene};
};

TEST(KeptPages, a_flight_has_no_stale_texel_under_any_policy_and_light) {
  const std::vector<Light> lights{DirectionalLight{kSlant}, PointLight{{-4.0, 6.0, 3.0}, 60.0},
                                  SpotLight{{-4.0, 6.0, 3.0}, {0.5, -0.8, -0.3}, 0.9, 60.0}};
  for (const Light& light : lights) {
    for (const PagePolicy* policy : {&page_policies::resolution, &page_policies::clipmap}) {
      SCOPED_TRACE(std::string(policy->name) + ", light " + std::to_string(light.index()));
      Pair pair(boxes_on_ground());
      pair.light = light;
      pair.pages.policy = policy;
      for (int frame = 0; frame < 40; ++frame) ASSERT_EQ(pair.stale(going(frame)), 0u) << "frame " << frame;
      EXPECT_GT(pair.kept, pair.all * 3 / 4);
      EXPECT_LT(pair.kept, pair.all);
    }
  }
}

// A new pool has pages in other slots, and floats round places in a layer otherwise there. A comparison of
// nearly equal depths may turn, and a texel counts one in the kernel's.
TEST(KeptPages, a_pool_of_another_age_has_the_same_texels_and_turns_few_comparisons) {
  constexpr float kRadius = 2.5f, kTexel = 1.0f / (4.0f * kRadius * kRadius), kRounding = 1e-4f;
  Pair pair(boxes_on_ground());
  pair.filter = parse_filter("pcf:radius=2.5").settings;
  set_margin(pair.filter, pair.pages.plan);
  std::size_t partly = 0, turned = 0;
  for (int frame = 0; frame < 24; ++frame) {
    ASSERT_EQ(pair.stale(going(frame)), 0u);
    if (frame % 4 != 3) continue;
    const PagePlan plan = pair.plan(going(frame));
    Renderer fresh(pair.scene);
    FrameOptions options;
    options.time_passes = false;
    fresh.draw(plan, going(frame), fresh.prepare(pair.filter, Source::pages), options);
    for (std::size_t i = 0; i < plan.pages.size(); ++i)
      ASSERT_EQ(fresh.page_depths(i).values, pair.keeps.page_depths(i).values) << i;
    const FloatImage kept = pair.keeps.mask(), made = fresh.mask();
    for (std::size_t i = 0; i < kept.values.size(); i += 2) {
      const float apart = std::abs(kept.values[i] - made.values[i]);
      EXPECT_LE(apart, 2.0f * kTexel) << i;
      partly += kept.values[i] > 0.0f && kept.values[i] < 1.0f;
      turned += apart > kRounding;
    }
  }
  EXPECT_GT(partly, 2000u);
  EXPECT_LE(1000 * turned, partly);
}

TEST(KeptPages, a_box_that_walks_costs_its_pages_and_leaves_none_stale) {
  Pair pair(boxes_on_ground());
  const Camera camera = going(0);
  ASSERT_EQ(pair.stale(camera), 0u);
  ASSERT_EQ(pair.last.pages_drawn, pair.last.pages);
  ASSERT_EQ(pair.stale(camera), 0u);
  EXPECT_EQ(pair.last.pages_drawn, 0);
  EXPECT_EQ(pair.last.map[0].triangles, 0u);
  std::vector<float> before = pair.keeps.mask().values;
  for (int frame = 0; frame < 12; ++frame) {
    pair.move(1, {0.13, 0.0, -0.07});
    ASSERT_EQ(pair.stale(camera), 0u) << "frame " << frame;
    EXPECT_GT(pair.last.pages_drawn, 0);
    EXPECT_LT(pair.last.pages_drawn, pair.last.pages * 2 / 3);
    EXPECT_NE(pair.keeps.mask().values, before) << "its shadow walks along";
    before = pair.keeps.mask().values;
  }
  Instance nowhere = pair.scene.instances[1];
  EXPECT_FALSE(pair.keeps.move_instance(999, nowhere));
  nowhere.bounds_world = {};
  EXPECT_FALSE(pair.keeps.move_instance(1, nowhere));
}

TEST(KeptPages, bounds_that_the_caller_names_are_redrawn) {
  Pair pair(boxes_on_ground());
  const Camera camera = going(0);
  ASSERT_EQ(pair.stale(camera), 0u);
  const Box moved = pair.boxes[1];
  ASSERT_EQ(pair.stale(camera, {&moved, 1}), 0u);
  EXPECT_GT(pair.last.pages_drawn, 0);
  EXPECT_LT(pair.last.pages_drawn, pair.last.pages);
}

TEST(KeptPages, maps_take_the_pool_and_other_page_sizes_begin_again) {
  Pair pair(boxes_on_ground());
  const Camera camera = going(0);
  ASSERT_EQ(pair.stale(camera), 0u);
  const ShadowPlan maps = plan_for(pair.scene, camera, kSlant, {});
  render::draw(pair.keeps, camera, maps, pair.filter);
  ASSERT_EQ(pair.stale(camera), 0u);
  EXPECT_EQ(pair.last.pages_drawn, pair.last.pages);
  pair.pages.page_texels = 128;
  ASSERT_EQ(pair.stale(camera), 0u);
  EXPECT_EQ(pair.last.pages_drawn, pair.last.pages);
  pair.pages.target_m = 0.25;  // the pool grows
  ASSERT_EQ(pair.stale(camera), 0u);
  ASSERT_EQ(pair.stale(camera), 0u);
  EXPECT_EQ(pair.last.pages_drawn, 0);
}

TEST(KeptPages, maps_follow_a_box_that_walks) {
  Pair pair(boxes_on_ground());
  const Camera camera = going(0);
  PlanOptions options;
  options.fit = Fit::stable;
  set_margin(pair.filter, options);
  for (int frame = 0; frame < 3; ++frame) {
    pair.move(1, {0.2, 0.0, 0.0});
    const ShadowPlan plan = make_plan(camera, pair.light, {pair.boxes, pair.boxes}, options);
    const Frame kept = render::draw(pair.keeps, camera, plan, pair.filter);
    Renderer anew(pair.scene);
    EXPECT_EQ(kept.mask.values, render::draw(anew, camera, plan, pair.filter).mask.values);
  }
}

}  // namespace
}  // namespace gnomon::render
