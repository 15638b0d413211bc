// Does a plan that remembers the frame before it keep what a plan promises, whatever comes into view?
#include "gnomon/extend/warp.hpp"
#include "gnomon/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "map/history.hpp"
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
      const ShadowPlan plan = make_plan(in.camera, in.light, in.bounds(), in.options, &history);
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

// The way to the best map ends in a map that is computed anew in each frame, and rounds differently.
TEST(PlanHistory, a_frame_in_which_nothing_moves_keeps_every_bit) {
  const std::vector<Box> boxes = {
      {{-100, -1, -100}, {100, 0, 100}}, {{-5, 0, -30}, {5, 8, -20}}, {{12, 0, -70}, {20, 30, -60}}};
  const Light lights[] = {DirectionalLight{{0.4, -0.7, -0.3}}, SpotLight{{2, 8, 8}, {0, -0.6, -1}, 0.6, 60},
                          PointLight{{2, 4, -8}, 40}};
  int maps = 0, warped = 0;
  for (int kind = 0; kind < 3 * 2 * 3 * 4; ++kind) {
    const Light& light = lights[kind % 3];
    PlanOptions options;
    options.fit = kind / 3 % 2 == 0 ? Fit::tight : Fit::rotated;
    const Objective objectives[] = {Objective::picture, Objective::storage, Objective::p95};
    options.warp.objective = objectives[kind / 6 % 3];
    const double turn = 0.1 * (kind / 18);
    // A kilometre off, where matrices from the world round more.
    const glm::dvec3 off{kind % 2 == 0 ? 0.0 : 1000.0, 0.0, 0.0};
    const auto moved = [&](Box box) { return Box{box.min + off, box.max + off}; };
    std::vector<Box> scene;
    for (const Box& box : boxes) scene.push_back(moved(box));
    Light at = light;
    if (auto* spot = std::get_if<SpotLight>(&at)) spot->position += off;
    if (auto* point = std::get_if<PointLight>(&at)) point->position += off;
    const Camera camera = perspective_camera(glm::dvec3(0, 1.7, 5) + off, {turn, -0.08, -1}, {0, 1, 0}, 1.1,
                                             1.5, 0.05, 500.0, 960, 640);
    PlanHistory history;
    ShadowPlan before;
    constexpr int kSettled = 60, kFrames = 90;
    for (int frame = 0; frame < kFrames; ++frame) {
      const ShadowPlan plan = make_plan(camera, at, {scene, scene}, options, &history);
      ASSERT_EQ(plan.status, PlanStatus::ok);
      for (int i = 0; frame >= kSettled && i < plan.map_count; ++i) {
        const ShadowMap &last = before.map[static_cast<std::size_t>(i)],
                        &now = plan.map[static_cast<std::size_t>(i)];
        ASSERT_EQ(reuse(last, now).kind, ReuseKind::identical)
            << "kind " << kind << ", frame " << frame << ", map " << now.cascade;
        ++maps;
        warped += now.kappa > 0.0 ? 1 : 0;
      }
      before = plan;
    }
  }
  EXPECT_GT(maps, 1000);
  EXPECT_GT(warped, 1000);
}

TEST(PlanHistory, a_move_that_shows_makes_another_map) {
  const std::vector<Box> boxes = {{{-100, -1, -100}, {100, 0, 100}}, {{-5, 0, -30}, {5, 8, -20}}};
  PlanOptions options;
  options.cascades = 1;
  for (int what = 0; what < 4; ++what) {
    Camera camera = perspective_camera({0, 5, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 200.0, 640, 400);
    DirectionalLight sun{{0.3, -1, 0.2}};
    std::vector<Box> scene = boxes;
    PlanHistory history;
    ShadowPlan before;
    for (int frame = 0; frame < 40; ++frame)
      before = make_plan(camera, sun, {scene, scene}, options, &history);
    if (what == 0) camera.position.x += 1e-3;
    if (what == 1) camera.forward.x += 1e-4;
    if (what == 2) sun.direction.x += 1e-9;
    if (what == 3) scene[1].max.y += 1.0;  // a caster that is nearer to the light: the depths
    const ShadowPlan now = make_plan(camera, sun, {scene, scene}, options, &history);
    EXPECT_EQ(reuse(before.map[0], now.map[0]).kind, ReuseKind::none) << what;
  }
}

TEST(PlanHistory, searches_from_nothing_after_a_while_and_under_other_options) {
  const Camera camera =
      perspective_camera({0, 5, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 200.0, 640, 400);
  const std::vector<Box> boxes = {{{-100, -1, -100}, {100, 0, 100}}, {{-5, 0, -30}, {5, 8, -20}}};
  PlanOptions options;
  options.cascades = 1;
  PlanHistory history;
  const auto plan = [&] {
    return make_plan(camera, DirectionalLight{{0.3, -1, 0.2}}, {boxes, boxes}, options, &history).map_count;
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

TEST(PlanHistory, no_map_of_a_warp_is_kept_under_none) {
  const Camera camera =
      perspective_camera({0, 5, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 200.0, 640, 400);
  const std::vector<Box> boxes = {{{-100, -1, -100}, {100, 0, 100}}, {{-5, 0, -30}, {5, 8, -20}}};
  for (const Fit fit : {Fit::tight, Fit::rotated, Fit::warped_stable}) {
    PlanOptions options;
    options.cascades = 1;
    options.fit = fit;
    PlanHistory history;
    const auto kappa = [&] {
      return make_plan(camera, DirectionalLight{{0.3, -1, 0.2}}, {boxes, boxes}, options, &history)
          .map[0]
          .kappa;
    };
    EXPECT_GT(kappa(), 0.0) << to_string(fit) << ": the case that this is about";
    options.warp.warp = &warps::none;
    EXPECT_EQ(kappa(), 0.0) << to_string(fit);
  }
}

double fall_off_angle = 0.0;  // radians, in the light plane

/// In the place of a warp: falls off towards an angle, and is always worth following.
WarpChoice fall_off(const WarpInput& input) noexcept {
  WarpChoice choice;
  choice.axis = {std::cos(fall_off_angle), std::sin(fall_off_angle)};
  const Span u = along(input.body, choice.axis);
  choice.kappa = 0.5 / (u.high - u.low);
  choice.gain_ratio = 1.0;
  choice.last_ratio = 2.0;
  return choice;
}
const Warp kFallOff{"fall_off", "falls off where it is told to", fall_off, false};

TEST(PlanHistory, the_axis_of_a_warp_takes_the_shorter_way_round) {
  constexpr double kPi = 3.141592653589793, kAside = 0.3, kRounding = 1e-9;
  const Camera camera =
      perspective_camera({0, 5, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.6, 1.0, 60.0, 640, 400);
  const std::vector<Box> boxes = {{{-100, -1, -100}, {100, 0, 100}}};
  PlanOptions options;
  options.cascades = 1;
  options.warp.warp = &kFallOff;
  PlanHistory history;
  // The angle from -x to where w grows, towards the view.
  const auto beside = [&] {
    const ShadowPlan plan =
        make_plan(camera, DirectionalLight{{0, -1, 0}}, {boxes, boxes}, options, &history);
    EXPECT_EQ(plan.map_count, 1);
    const glm::dmat4& m = plan.map[0].clip_from_world;
    return std::atan2(-m[2][3], -m[0][3]);
  };
  fall_off_angle = kPi - kAside;
  EXPECT_NEAR(beside(), kAside, kRounding);
  fall_off_angle = kAside - kPi;
  int steps = 0;
  double before = kAside, now = kAside;
  while (steps < 100 && std::abs(now + kAside) > kRounding) {
    now = beside();
    EXPECT_LT(now, before) << "step " << steps;
    before = now;
    ++steps;
  }
  EXPECT_GT(steps, 2) << "no way in one step";
  EXPECT_LT(steps, 100);
}

/// A square view from above onto level ground under a vertical sun, with a map of Fit::warped_stable: its
/// rectangle is the view with a tenth of its sides more at each of them.
struct FromAbove {
  std::vector<Box> boxes = {{{-100, -1, -100}, {100, 0, 100}}};
  PlanOptions options;
  PlanHistory history;
  FromAbove() {
    options.cascades = 1;
    options.fit = Fit::warped_stable;
    options.warp.warp = &warps::none;
    options.resolution.max_size = 256;
    options.filter.texels = 16.0;  // an eighth of the map is border
  }
  /// Whether the map is another than in the last frame.
  bool refits(double x, double side) {
    const Camera camera = orthographic_camera({x, 10, 0}, {0, -1, 0}, {0, 0, -1}, side, 1.0, 1, 20, 256, 256);
    const ShadowPlan plan =
        make_plan(camera, DirectionalLight{{0, -1, 0}}, {boxes, boxes}, options, &history);
    EXPECT_EQ(plan.map_count, 1);
    return history.event_count > 0;
  }
};

TEST(WarpedStable, a_map_is_kept_until_the_view_reaches_its_border) {
  FromAbove scene;
  EXPECT_TRUE(scene.refits(0.0, 20.0)) << "the first map";
  // Room is 2 units; the border begins there, and is 1.7 units wide.
  EXPECT_FALSE(scene.refits(1.9, 20.0));
  EXPECT_TRUE(scene.refits(2.1, 20.0));
}

TEST(WarpedStable, a_map_is_kept_until_the_view_uses_less_than_two_fifths_of_it) {
  FromAbove scene;
  EXPECT_TRUE(scene.refits(0.0, 20.0)) << "the first map";
  // Of a side of 24 units.
  EXPECT_FALSE(scene.refits(0.0, 15.4)) << "0.41";
  EXPECT_TRUE(scene.refits(0.0, 14.9)) << "0.39";
}

}  // namespace
}  // namespace gnomon::test
