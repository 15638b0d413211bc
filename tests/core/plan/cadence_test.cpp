// Are far cascades planned every n-th frame, and at once where the camera did what nobody promised?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// A plain seen from above its middle, with boxes all over it.
struct Plain {
  Camera camera = perspective_camera({0, 10, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 1, 400, 960, 640);
  std::vector<Box> boxes;
  PlanOptions options;
  PlanHistory history;
  glm::dvec3 light{0.3, -1, 0.2};
  Plain() {
    for (int x = -400; x <= 400; x += 50) {
      for (int z = -400; z <= 400; z += 50) boxes.push_back({{x - 5, 0, z - 5}, {x + 5, 8, z + 5}});
    }
    boxes.push_back({{-400, -1, -400}, {400, 0, 400}});
    options.cadence = {3, 0.5, 0.02};
  }
  ShadowPlan plan() { return make_plan(camera, DirectionalLight{light}, {boxes, boxes}, options, &history); }
};

/// By cascade: whether its map is another than before.
std::vector<bool> changed(const ShadowPlan& before, const ShadowPlan& now) {
  std::vector<bool> result;
  for (std::size_t i = 0; i < now.maps().size(); ++i)
    result.push_back(reuse(before.map[i], now.map[i]).kind != ReuseKind::identical);
  return result;
}

TEST(Cadence, cascades_behind_the_first_take_turns) {
  Plain plain;
  ShadowPlan before = plain.plan();
  ASSERT_EQ(before.map_count, 4);
  for (int frame = 1; frame < 10; ++frame) {
    plain.camera.position.x += 0.4;
    const ShadowPlan now = plain.plan();
    ASSERT_EQ(now.map_count, 4);
    const std::vector<bool> moved = changed(before, now);
    EXPECT_TRUE(moved[0]);
    for (int i = 1; i < 4; ++i)
      EXPECT_EQ(moved[static_cast<std::size_t>(i)], (frame + i) % 3 == 0) << frame << i;
    before = now;
  }
}

TEST(Cadence, a_kept_map_is_relative_to_this_frames_eye) {
  Plain plain;
  ShadowPlan before = plain.plan();
  plain.camera.position.x += 0.4;
  const ShadowPlan now = plain.plan();
  const ShadowMap& kept = now.map[1];
  ASSERT_EQ(reuse(before.map[1], kept).kind, ReuseKind::identical);
  EXPECT_EQ(kept.clip_from_camera_relative,
            rebased(before.map[1], plain.camera.position).clip_from_camera_relative);
  EXPECT_NE(kept.clip_from_camera_relative, before.map[1].clip_from_camera_relative);
}

TEST(Cadence, a_broken_promise_another_lens_or_light_plans_every_cascade) {
  const auto all_change = [](auto&& act) {
    Plain plain;
    const ShadowPlan before = plain.plan();
    act(plain);
    const std::vector<bool> moved = changed(before, plain.plan());
    return std::ranges::all_of(moved, [](bool m) { return m; });
  };
  EXPECT_FALSE(all_change([](Plain&) {}));
  EXPECT_FALSE(all_change([](Plain& p) { p.camera.position.x += 0.5; }));
  EXPECT_TRUE(all_change([](Plain& p) { p.camera.position.x += 50.0; }));
  EXPECT_TRUE(all_change([](Plain& p) { p.camera.forward.x += 1.0; }));
  EXPECT_TRUE(all_change([](Plain& p) { p.camera.left *= 1.01; }));
  EXPECT_TRUE(all_change([](Plain& p) { p.light.x += 0.01; }));
  EXPECT_TRUE(all_change([](Plain& p) { p.options.resolution.max_size = 512; }));
}

/// Which cascades were planned in the last frame, of those that may be kept.
int planned_anew(const PlanHistory& history) {
  int planned = 0;
  for (std::size_t i = 1; i < 4; ++i) planned += history.kept[i].frame == history.frame - 1 ? 1 : 0;
  return planned;
}

// Not split.lambda and the like: edges move to their new places in steps, and each step is another map.
TEST(Cadence, any_other_option_plans_every_cascade_once) {
  struct Change {
    const char* what;
    void (*make)(PlanOptions&);
  };
  const Change changes[] = {
      {"resolution.max_size", [](PlanOptions& o) { o.resolution.max_size = 512; }},
      {"fit", [](PlanOptions& o) { o.fit = Fit::rotated; }},
      {"split.pseudo_near", [](PlanOptions& o) { o.split.pseudo_near = 3.0; }},
      {"split.overlap", [](PlanOptions& o) { o.split.overlap = 0.25; }},
      {"split.selection", [](PlanOptions& o) { o.split.selection = MapSelection::finest; }},
      {"warp.warp", [](PlanOptions& o) { o.warp.warp = &warps::none; }},
      {"warp.objective", [](PlanOptions& o) { o.warp.objective = Objective::p95; }},
      {"warp.focus",
       [](PlanOptions& o) {
         o.warp.focus = {{-5, 0, -60}, {5, 8, -50}};
       }},
      {"cadence.frames", [](PlanOptions& o) { o.cadence.frames = 5; }},
      {"cadence.largest_step", [](PlanOptions& o) { o.cadence.largest_step = 5.0; }},
      {"cadence.largest_turn", [](PlanOptions& o) { o.cadence.largest_turn = 0.2; }},
      {"filter.texels", [](PlanOptions& o) { o.filter.texels = 8.0; }},
      {"filter.world", [](PlanOptions& o) { o.filter.world = 2.0; }},
      {"bias.slope_texels", [](PlanOptions& o) { o.bias.slope_texels = 2.0; }},
      {"clip_space.reversed_z", [](PlanOptions& o) { o.clip_space.reversed_z = true; }},
      {"prune", [](PlanOptions& o) { o.prune = o.prune.without(PruneRule::casterless_cascades); }},
  };
  for (const Change& change : changes) {
    Plain plain;
    (void)plain.plan();
    (void)plain.plan();
    ASSERT_LT(planned_anew(plain.history), 3);
    change.make(plain.options);
    const ShadowPlan now = plain.plan();
    EXPECT_EQ(planned_anew(plain.history), 3) << change.what;
    for (const ShadowMap& map : now.maps()) {
      EXPECT_GE(map.filter_margin_texels, plain.options.filter.texels) << change.what;
      EXPECT_EQ(map.width, plain.options.resolution.max_size) << change.what;
    }
    (void)plain.plan();
    EXPECT_LT(planned_anew(plain.history), 3) << change.what;
  }
}

TEST(Cadence, a_lambda_that_is_no_number_is_refused_as_without_one) {
  Plain plain;
  plain.options.split.lambda = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(plain.plan().invalid_field, "options.split.lambda");
}

TEST(Cadence, room_is_what_the_promise_requires) {
  Plain still, moving;
  still.options.cadence = {3, 0.0, 0.0};
  const ShadowPlan a = still.plan(), b = moving.plan();
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(b.map[i].texel_world.x, a.map[i].texel_world.x) << i;
  EXPECT_EQ(a.map[0].clip_from_world, b.map[0].clip_from_world) << "the first cascade needs none";
}

TEST(Cadence, where_it_cannot_be_it_is_reported) {
  Plain plain;
  const auto ignored = [](const ShadowPlan& plan) {
    return std::ranges::any_of(plan.omitted(), [](const Omission& o) {
      return o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(IgnoredOption::cadence);
    });
  };
  EXPECT_FALSE(ignored(plain.plan()));
  const SceneBounds bounds{plain.boxes, plain.boxes};
  EXPECT_TRUE(ignored(make_plan(plain.camera, DirectionalLight{plain.light}, bounds, plain.options)));
  EXPECT_TRUE(
      ignored(make_plan(plain.camera, PointLight{{0, 30, -50}, 100}, bounds, plain.options, &plain.history)));
  plain.options.resolution.max_error = 1.0;
  EXPECT_TRUE(ignored(plain.plan()));
}

TEST(Cadence, broken_values_are_named) {
  Plain plain;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const CadenceOptions& cadence) {
    plain.options.cadence = cadence;
    return std::string(plain.plan().invalid_field);
  };
  EXPECT_EQ(refused({0, 0.0, 0.0}), "options.cadence.frames");
  EXPECT_EQ(refused({kMaxCadenceFrames + 1, 0.0, 0.0}), "options.cadence.frames");
  EXPECT_EQ(refused({2, -1.0, 0.0}), "options.cadence.largest_step");
  EXPECT_EQ(refused({2, nan, 0.0}), "options.cadence.largest_step");
  EXPECT_EQ(refused({2, 1.0, 4.0}), "options.cadence.largest_turn");
  EXPECT_EQ(refused({kMaxCadenceFrames, 1e30, 3.0}), "")
      << "no visible receiver is ever outside of all the world";
}

TEST(Cadence, a_camera_that_turns_as_fast_as_promised_keeps_each_map_until_its_turn) {
  constexpr double kTurn = 0.02;
  Plain plain;
  plain.options.cadence = {3, 0.0, kTurn};
  ShadowPlan before = plain.plan();
  ASSERT_EQ(before.map_count, 4);
  for (int frame = 1; frame < 10; ++frame) {
    plain.camera.forward = {std::sin(kTurn * frame), -0.2, -std::cos(kTurn * frame)};
    const ShadowPlan now = plain.plan();
    ASSERT_EQ(now.map_count, 4);
    const std::vector<bool> moved = changed(before, now);
    for (int i = 1; i < 4; ++i)
      EXPECT_EQ(moved[static_cast<std::size_t>(i)], (frame + i) % 3 == 0) << frame << i;
    before = now;
  }
}

TEST(Cadence, a_map_that_missed_its_turn_is_planned_in_the_next_frame) {
  Plain plain;
  const glm::dvec3 ahead = plain.camera.forward;
  (void)plain.plan();
  (void)plain.plan();
  // Cascade 1 is due in frame 2, in which the camera looks into the sky.
  plain.camera.forward = {0, 1, -0.1};
  ASSERT_EQ(plain.plan().status, PlanStatus::nothing_visible);
  ASSERT_EQ(plain.history.kept[1].frame, 0);
  plain.camera.forward = ahead;
  ASSERT_EQ(plain.plan().status, PlanStatus::ok);
  EXPECT_EQ(plain.history.kept[1].frame, 3);
}

TEST(Cadence, a_stable_map_that_is_kept_holds_what_the_promised_steps_bring_into_view) {
  constexpr double kStep = 8.0;
  Plain plain;
  // Receivers everywhere, and a view so wide and flat that its far edge is as long as the map.
  plain.boxes = {{{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}}};
  plain.camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.2, 30.0, 1.0, 60.0, 960, 32);
  plain.light = {0, -1, 0};
  plain.options.fit = Fit::stable;
  plain.options.cadence = {3, kStep, 0.0};
  ShadowPlan before = plain.plan();
  int kept = 0;
  for (int frame = 1; frame < 10; ++frame) {
    plain.camera.position.x += kStep;
    const ShadowPlan now = plain.plan();
    ASSERT_EQ(now.map_count, 4);
    const std::vector<bool> moved = changed(before, now);
    for (std::size_t i = 1; i < 4; ++i) {
      kept += moved[i] ? 0 : 1;
      for (const double x : {-1.0, 1.0}) {
        const glm::dvec3 corner = point_at(plain.camera, x, 1.0, now.map[i].depth_end);
        EXPECT_TRUE(map_holds(now, now.map[i], corner)) << frame << i << " at " << x;
      }
    }
    before = now;
  }
  EXPECT_EQ(kept, 3 * 6) << "two of three frames keep a cascade";
}

}  // namespace
}  // namespace gnomon::test
