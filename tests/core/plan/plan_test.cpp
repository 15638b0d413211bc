// Which plan does a scene get that one can see through: its status, its maps, what it leaves out?
#include "gnomon/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gnomon/measure.hpp"
#include "support/near.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

bool tells(const ShadowPlan& plan, OmissionKind kind) {
  for (const Omission& omission : plan.omitted()) {
    if (omission.kind == kind) return true;
  }
  return false;
}

/// A camera five units over a wide ground, under an oblique sun.
Case ground_case() {
  Case c;
  c.camera = perspective_camera({0, 5, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 200, 640, 480);
  c.light = {0.3, -1, 0.2};
  c.receivers = {{{-300, -1, -300}, {300, 0, 300}}};
  c.casters = {{{-300, -1, -300}, {300, 0, 300}}, {{-2, 0, -12}, {2, 6, -10}}};
  return c;
}

TEST(Plan, no_receivers_or_none_in_view_is_nothing_visible) {
  Case c = ground_case();
  c.receivers.clear();
  EXPECT_EQ(c.plan().status, PlanStatus::nothing_visible);
  c.receivers = {Box{}};
  EXPECT_EQ(c.plan().status, PlanStatus::nothing_visible);
  c.receivers = {{{-10, -1, 50}, {10, 3, 60}}};  // behind the camera
  EXPECT_EQ(c.plan().status, PlanStatus::nothing_visible);
  c.receivers = {{{-10, -1, -900}, {10, 3, -800}}};  // beyond its far plane
  EXPECT_EQ(c.plan().status, PlanStatus::nothing_visible);
  EXPECT_EQ(c.plan().map_count, 0);
}

TEST(Plan, receivers_that_nothing_can_shadow_need_no_map) {
  Case c = ground_case();
  for (const Fit fit : {Fit::tight, Fit::stable}) {
    c.options.fit = fit;
    c.casters.clear();
    EXPECT_EQ(c.plan().status, PlanStatus::no_caster);
    c.casters = {{{-10, -50, -40}, {10, -40, -20}}, Box{}};  // below the ground
    const ShadowPlan plan = c.plan();
    EXPECT_EQ(plan.status, PlanStatus::no_caster);
    EXPECT_EQ(plan.map_count, 0);
    EXPECT_TRUE(tells(plan, OmissionKind::cascade_without_caster));
  }
}

TEST(Plan, spaces_between_receivers_get_no_cascade_and_say_so) {
  Case c = ground_case();
  c.receivers = {{{-1, 0, -14}, {1, 1, -12}}, {{-20, 0, -190}, {20, 9, -180}}};
  c.casters = c.receivers;
  c.options.cascades = 8;
  const ShadowPlan plan = c.plan();
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_LT(plan.map_count, 8);
  EXPECT_TRUE(tells(plan, OmissionKind::cascade_without_receiver));
  EXPECT_TRUE(tells(plan, OmissionKind::depth_without_receiver));
  for (const Omission& o : plan.omitted()) {
    if (o.kind != OmissionKind::cascade_without_receiver) continue;
    EXPECT_EQ(o.saves_texels, 1024 * 1024);
  }
}

TEST(Plan, depths_without_receivers_are_not_divided_unless_requested) {
  Case c = ground_case();
  c.receivers = {{{-2, 0, -42}, {2, 4, -38}}};
  c.casters = c.receivers;
  c.options.cascades = 1;
  const ShadowPlan tight = c.plan();
  ASSERT_EQ(tight.map_count, 1);
  EXPECT_GT(tight.map[0].depth_begin, 30.0);
  EXPECT_LT(tight.map[0].depth_end, 50.0);
  c.options.split.range = SplitRange::camera;
  const ShadowPlan whole = c.plan();
  ASSERT_EQ(whole.map_count, 1);
  EXPECT_EQ(whole.map[0].depth_begin, 0.5);
  EXPECT_EQ(whole.map[0].depth_end, 200.0);
  c.options.fit = Fit::stable;
  EXPECT_EQ(c.plan().map[0].depth_end, 200.0);
  c.options.split.range = SplitRange::automatic;
  const ShadowPlan stable = c.plan();
  EXPECT_EQ(stable.map[0].depth_begin, 0.5);
  // At most half an octave behind the farthest corner.
  EXPECT_GE(stable.map[0].depth_end, 42.0);
  EXPECT_LT(stable.map[0].depth_end, 1.42 * 43.0);
  EXPECT_TRUE(tells(stable, OmissionKind::depth_without_receiver));
  c.options.split.range = SplitRange::receivers;
  EXPECT_GT(c.plan().map[0].depth_begin, 30.0);
}

TEST(Plan, light_exactly_along_or_against_the_view_gives_finite_maps) {
  for (const double sign : {1.0, -1.0}) {
    for (const Warp* warp : all_warps()) {
      Case c = ground_case();
      c.light = c.camera.forward * sign;
      c.options.warp.warp = warp;
      const ShadowPlan plan = c.plan();
      ASSERT_EQ(plan.status, PlanStatus::ok) << warp->name;
      const AliasingStats stats = measure(plan, c.camera, c.bounds(), {16, 16, 32});
      EXPECT_GT(stats.samples, 0u);
      EXPECT_EQ(stats.outside, 0u) << warp->name;
      EXPECT_TRUE(std::isfinite(stats.max)) << warp->name;
    }
  }
}

TEST(Plan, a_receiver_that_is_a_point_a_line_or_flat_is_held_by_a_finite_map) {
  const Box shapes[] = {{{0, 1, -10}, {0, 1, -10}},
                        {{-1, 1, -10}, {1, 1, -10}},
                        {{-1, 1, -12}, {1, 1, -10}},
                        {{0, 0, -10}, {0, 4, -10}},
                        {{1, 1, -10}, {1, 1, -8}}};
  for (const Box& shape : shapes) {
    for (const Fit fit : {Fit::tight, Fit::stable}) {
      for (const glm::dvec3& light : {glm::dvec3(0, -1, 0), glm::dvec3(0.3, -1, 0.2), glm::dvec3(0, 0, -1)}) {
        Case c = ground_case();
        c.camera.forward = {0, 0, -1};
        c.light = light;
        c.receivers = {shape};
        c.casters = {{{-5, -5, -20}, {5, 5, -2}}};
        c.options.fit = fit;
        c.options.cascades = 1;
        const ShadowPlan plan = c.plan();
        ASSERT_EQ(plan.status, PlanStatus::ok);
        const glm::dvec4 clip = plan.map[0].clip_from_world * glm::dvec4(0.5 * (shape.min + shape.max), 1.0);
        EXPECT_GT(clip.w, 0.0);
        EXPECT_LT(std::abs(clip.x) / clip.w, 1.0);
        EXPECT_LT(std::abs(clip.y) / clip.w, 1.0);
        EXPECT_LT(std::abs(clip.z) / clip.w, 1.0);
        EXPECT_TRUE(std::isfinite(plan.map[0].texel_world.x + plan.map[0].texel_world.y));
      }
    }
  }
}

TEST(Plan, a_point_that_only_rounding_gives_an_extent_is_held_by_a_map_too) {
  // Clipping leaves vertices a last bit apart; a map of that size would divide by its rounding.
  Case c = ground_case();
  c.camera =
      perspective_camera({-0.24999725079692064, 0.24999942475115583, -0.54846465831093338},
                         {0.034942837920574683, -0.99594364408290015, -0.082917162812833262}, {0, 1, 0}, 2.59,
                         0.5231558, 3.3574576286257236e-06, 0.27423232915546669, 33, 64);
  const glm::dvec3 p{-0.24998760737377346, 0.24999342879614056, -0.54846887349106699};
  c.light = {0, -1, 0};
  c.receivers = {{p, p}};
  c.casters = {{p - glm::dvec3(0.1), p + glm::dvec3(0.1)}};
  c.options.cascades = 1;
  const ShadowPlan plan = c.plan();
  ASSERT_EQ(plan.status, PlanStatus::ok);
  const glm::dvec4 clip = plan.map[0].clip_from_world * glm::dvec4(p, 1.0);
  EXPECT_LE(std::abs(clip.x) / clip.w, 1.0);
  EXPECT_LE(std::abs(clip.y) / clip.w, 1.0);
  EXPECT_LE(std::abs(clip.z) / clip.w, 1.0);
}

TEST(Plan, doubling_the_map_halves_the_error) {
  Case c = ground_case();
  c.options.filter.texels = 0.0;
  c.options.warp.warp = &warps::none;
  c.options.prune = kPruneNothing;
  const MeasureOptions grid{16, 16, 32};
  const AliasingStats coarse = measure(c.plan(), c.camera, c.bounds(), grid);
  c.options.resolution.max_size = 2048;
  const AliasingStats fine = measure(c.plan(), c.camera, c.bounds(), grid);
  EXPECT_CLOSE(fine.max * 2.0, coarse.max, 1e-9);
  EXPECT_CLOSE(fine.storage, coarse.storage, 1e-9);  // what is needed does not depend on what is there
}

TEST(Plan, more_cascades_lower_the_error_on_the_ground) {
  Case c = ground_case();
  double last = 1e300;
  for (const int cascades : {1, 2, 4, 8}) {
    c.options.cascades = cascades;
    c.options.warp.warp = &warps::none;
    const double p95 = measure(c.plan(), c.camera, c.bounds(), {24, 24, 64}).p95;
    EXPECT_LT(p95, last) << cascades;
    last = p95;
  }
}

// As README has it: compilers warn of members that are missing, but for those with a default.
TEST(Plan, options_are_given_by_name_without_the_others) {
  PlanOptions options;
  options.cascades = 3;
  EXPECT_EQ((PlanOptions{.cascades = 3}), options);
  EXPECT_EQ((PageOptions{.capacity = 12}.plan), PlanOptions{});
  EXPECT_EQ((LightOptions{.pool_width = 512}.plan), PlanOptions{});
}

TEST(Plan, the_filter_margin_is_whole_texels_that_hold_the_kernel) {
  Case c = ground_case();
  for (const auto& [radius, margin] : {std::pair{0.0, 0}, {0.5, 1}, {1.0, 1}, {3.2, 4}}) {
    c.options.filter.texels = radius;
    const ShadowPlan plan = c.plan();
    EXPECT_GT(plan.map_count, 0);
    for (const ShadowMap& map : plan.maps()) EXPECT_EQ(map.filter_margin_texels, margin);
  }
}

TEST(Plan, off_axis_and_orthographic_cameras_are_planned_without_excuse) {
  Case c = ground_case();
  c.camera.left = 0.2;
  c.camera.right = 0.9;  // looks past its own axis
  ShadowPlan plan = c.plan();
  EXPECT_EQ(plan.status, PlanStatus::ok);
  EXPECT_EQ(measure(plan, c.camera, c.bounds(), {8, 8, 32}).outside, 0u);
  c.camera =
      orthographic_camera({0, 50, 50}, {0, -1, -1}, {0, 1, 0}, 40, 1.5, -20, 200, 640, 480);  // near behind
  plan = c.plan();
  EXPECT_EQ(plan.status, PlanStatus::ok);
  for (const ShadowMap& map : plan.maps()) EXPECT_EQ(map.kappa, 0.0);  // no perspective to undo
}

TEST(Plan, the_light_is_a_direction_and_the_origin_is_the_camera) {
  Case c = ground_case();
  c.light = {0, -3, 4};
  const ShadowPlan plan = c.plan();
  EXPECT_EQ(plan.origin_world, c.camera.position);
  EXPECT_LE(glm::length(plan.light_direction - glm::dvec3(0, -0.6, 0.8)), 1e-15);
  for (const ShadowMap& map : plan.maps()) {
    EXPECT_LE(glm::length(map.light_world - glm::dvec4(0, 0.6, -0.8, 0)), 1e-15);
  }
}

// A wall without thickness lies exactly in the cuts that bound what is seen of it: rounding once lost it
// there.
TEST(Plan, a_receiver_without_thickness_among_others_keeps_its_map) {
  Camera camera;
  camera.position = glm::dvec3(-1.9726781845092773);
  camera.forward = {0.3134553434462729, 0.90818828161374809, -0.27738023145935692};
  camera.left = -1.2959283761841913;
  camera.right = 1.2959283761841913;
  camera.bottom = -0.52078491231718449;
  camera.top = 0.52078491231718449;
  camera.near_depth = 0.059525978371499116;
  camera.far_depth = 0.98633896080696948;
  const Box receivers[] = {
      {{-1.3278427124023438, -1.4924297332763672, -2.4231958389282227},
       {-1.3278427124023438, -1.3511800765991211, -0.43183422088623047}},
      {{-3.9453554153442383, -2.1699457168579102, -3.9453554153442383}, {0, -2.0713119506835938, 0}}};
  const Box casters[] = {{glm::dvec3(-10.0), glm::dvec3(10.0)}};
  PlanOptions options;
  options.cascades = 1;
  EXPECT_EQ(make_plan(camera, DirectionalLight{{0, -1, 0}}, {casters, receivers}, options).status,
            PlanStatus::ok);
}

TEST(Plan, a_receiver_exactly_on_the_far_end_is_served_whatever_rounding_makes_of_its_depth) {
  // A corner on the far plane, seen from far off the origin along a slanted view: its depth, computed anew,
  // comes out on either side of the end.
  int beyond = 0;
  for (int i = 1; i <= 200; ++i) {
    const glm::dvec3 eye{1e5 + 0.1 * i, 37.3, -2e5};
    const Camera camera = perspective_camera(eye, {0.3 * i, -1.0, -17.0 + 0.1 * i}, {0, 1, 0}, 1.0, 1.5, 0.5,
                                             100.0 + 0.37 * i, 640, 480);
    const CameraAxes axes = camera_axes(camera);
    const glm::dvec3 corner = eye + axes.forward * camera.far_depth + axes.right * (0.5 * camera.far_depth);
    const Box box{glm::min(corner, eye), glm::max(corner, eye)};
    const ShadowPlan plan = make_plan(camera, DirectionalLight{}, {{&box, 1}, {&box, 1}}, {});
    ASSERT_EQ(plan.status, PlanStatus::ok);
    const ShadowMap& last = plan.maps().back();
    for (const double ulps : {-4.0, 0.0, 4.0}) {
      const double depth = glm::dot(axes.forward, corner - eye) * (1.0 + ulps * 0x1p-52);
      if (depth > last.depth_end) ++beyond;
      EXPECT_EQ(map_serving(plan, corner, depth), plan.map_count - 1);
    }
    // What is beyond by more than rounding is not served.
    EXPECT_EQ(map_serving(plan, corner, last.depth_end * (1.0 + 1e-6)), -1);
    EXPECT_EQ(map_serving(plan, corner, plan.map[0].depth_begin * (1.0 - 1e-6)), -1);
  }
  EXPECT_GT(beyond, 0);
}

}  // namespace
}  // namespace gnomon::test
