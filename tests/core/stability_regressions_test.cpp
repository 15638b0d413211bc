// Faults that were found once, each as the smallest case that shows it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::test {
namespace {

glm::dvec3 ndc(const ShadowMap& map, const glm::dvec3& p) {
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
  return glm::dvec3(clip) / clip.w;
}

/// A wide ground under a light that reaches over all of it, and a box close under the light.
struct NearCaster {
  Camera camera = perspective_camera({-2.5, 1.5, 0}, {1, -0.3, 0}, {0, 1, 0}, 1.0, 1.5, 0.01, 1e6, 640, 480);
  std::vector<Box> receivers = {{{-1e5, -1, -1e5}, {1e5, 0, 1e5}}},
                   casters = {{{1.15, 0.95, -0.1}, {1.35, 1.15, 0.1}}};
  glm::dvec3 light{0.0, 2.1, 0.0}, receiver{2.5, 0.0, 0.0};  ///< the caster is half way

  void expect_shadow(const Light& of, double range) const {
    PlanOptions options;
    const ShadowPlan plan = make_plan(camera, of, {casters, receivers}, options);
    ASSERT_EQ(plan.status, PlanStatus::ok) << range;
    const int index = map_serving(plan, receiver, 5.0);
    ASSERT_GE(index, 0) << range;
    const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
    EXPECT_EQ(cull_casters(map, casters, {}), 1u) << range;
    EXPECT_GE(ndc(map, 0.5 * (light + receiver)).z, -1.0) << range;
  }
};

TEST(StabilityRegressions, a_spot_of_any_range_keeps_the_caster_close_to_it) {
  const NearCaster scene;
  for (const double range : {50.0, 1e3, 1e5, 1e7})
    scene.expect_shadow(SpotLight{scene.light, {1, -0.5, 0}, 1.3962634, range}, range);
}

TEST(StabilityRegressions, a_point_light_of_any_range_keeps_the_caster_close_to_it) {
  const NearCaster scene;
  for (const double range : {50.0, 1e3, 1e5, 1e7}) scene.expect_shadow(PointLight{scene.light, range}, range);
}

TEST(StabilityRegressions, stable_maps_hold_their_receivers_under_casters_of_any_height) {
  const std::vector<Box> receivers = {{{-50, -1, -50}, {50, 0, 50}}};
  const Camera camera = perspective_camera({0, 2, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100, 640, 480);
  PlanOptions options;
  options.fit = Fit::stable;
  for (const double height : {1e3, 1e9, 1e19, 1e25, 1e30}) {
    const std::vector<Box> casters = {receivers[0], {{-5, 1, -20}, {5, height, -10}}};
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0, -1, 0}}, {casters, receivers}, options);
    ASSERT_EQ(plan.status, PlanStatus::ok) << height;
    for (const ShadowMap& map : plan.maps()) {
      EXPECT_GT(map.depth_range_world, 0.0) << height;
      // On the ground, straight ahead.
      const glm::dvec3 forward = glm::normalize(camera.forward);
      const double depth = 0.5 * (map.depth_begin + map.depth_end);
      const glm::dvec3 p{0.0, 0.0, (depth + 2.0 * forward.y) / forward.z};
      EXPECT_LE(std::max(std::abs(ndc(map, p).x), std::abs(ndc(map, p).y)), 1.0) << height;
      EXPECT_LE(std::abs(ndc(map, p).z), 1.0) << height;
    }
  }
}

TEST(StabilityRegressions, stable_maps_reach_up_to_casters_of_any_height) {
  const std::vector<Box> receivers = {{{-50, -1, -50}, {50, 0, 50}}};
  const Camera camera = perspective_camera({0, 2, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100, 640, 480);
  PlanOptions options;
  options.fit = Fit::stable;
  for (const double height : {1e3, 1e9, 1e15, 1e19, 1e25, 1e30}) {
    const std::vector<Box> casters = {receivers[0], {{-5, 1, -20}, {5, height, -10}}};
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0, -1, 0}}, {casters, receivers}, options);
    const glm::dvec3 below{0, 0, -15};
    const double depth = glm::dot(below - camera.position, glm::normalize(camera.forward));
    const int index = map_serving(plan, below, depth);
    ASSERT_GE(index, 0) << height;
    EXPECT_GE(ndc(plan.map[static_cast<std::size_t>(index)], {0, height, -15}).z, -1.0) << height;
  }
}

TEST(StabilityRegressions, both_matrices_of_a_stable_map_are_alike_far_from_the_origin) {
  // A map less than a millimetre wide where doubles are a tenth of one apart.
  const double y = -592839140039.9204;
  const Camera camera =
      perspective_camera({0, y, 0}, {0, -1, 0}, {0, 0, 1}, 0.0174532925, 1.0, 3e-13, 0.0008, 64, 64);
  const std::vector<Box> receivers = {{{0, -6e11, 0}, {0, y - 0.0001, 0}}},
                         casters = {{{0, -6e11, 0}, {0, 0, 0}}};
  PlanOptions options;
  options.fit = Fit::stable;
  const ShadowPlan plan = make_plan(camera, DirectionalLight{{0, 0, 1}}, {casters, receivers}, options);
  ASSERT_GT(plan.map_count, 0);
  for (const ShadowMap& map : plan.maps()) {
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) {
        const double world = map.clip_from_world[c][r];
        EXPECT_NEAR(map.clip_from_camera_relative[c][r], world, 1e-6 * std::abs(world));
      }
    }
  }
}

TEST(StabilityRegressions, a_trapezoid_that_loses_by_p95_is_dropped) {
  const Camera camera{{-0.5, -0.5, -0.5},
                      {0.26492085927014647, 0.8829204704789508, -0.38764465833130657},
                      {0, 1, 0},
                      false,
                      -3.712392059685385,
                      5.191909140474577,
                      0.42142155787830227,
                      4.318614505434092,
                      0.18752347790577098,
                      0.25,
                      498,
                      218};
  const std::vector<Box> boxes = {{{-1.0270721082637646, -0.38357844141901554, -0.37106977753834863},
                                   {0.2256405164485364, -0.04778985100556635, -0.3107102141974019}}};
  const DirectionalLight light{{0.00014723657482541386, -0.0009026702873813441, 0.0004043609072506415}};
  PlanOptions options;
  options.resolution.max_size = 64;
  options.cascades = 1;
  options.filter.texels = 0.0;
  options.split.scheme = SplitScheme::uniform;
  options.warp.objective = Objective::p95;
  options.warp.warp = &warps::tsm;
  const AliasingStats with =
      measure(make_plan(camera, light, {boxes, boxes}, options), camera, {boxes, boxes});
  options.warp.warp = &warps::none;
  const AliasingStats without =
      measure(make_plan(camera, light, {boxes, boxes}, options), camera, {boxes, boxes});
  EXPECT_LE(with.p95, without.p95 * 1.05);
}

TEST(StabilityRegressions, the_largest_texel_counts_how_far_texels_lean_off_the_axis) {
  const Camera camera =
      perspective_camera({0, 2, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.4, 2.0, 0.1, 100, 1920, 1080);
  const std::vector<Box> boxes = {{{-100, -1, -100}, {100, 0, 100}}};
  const glm::dvec3 travel = glm::normalize(glm::dvec3(0.3, -1, 0.2));
  PlanOptions options;
  options.cascades = 1;
  const ShadowPlan plan = make_plan(camera, DirectionalLight{travel}, {boxes, boxes}, options);
  ASSERT_EQ(plan.map_count, 1);
  const ShadowMap& map = plan.map[0];
  Polytope body = frustum_slice(camera, camera_axes(camera), map.depth_begin, map.depth_end);
  clip(body, Box{boxes[0].min - camera.position, boxes[0].max - camera.position});
  for (const Polytope::Vertex& v : body.vertices()) {
    const glm::dvec2 texel =
        texel_extent_world(map.clip_from_world, map.texels(), travel, v.position + camera.position);
    EXPECT_LE(texel.x, map.texel_world_max.x * (1.0 + 1e-6));
    EXPECT_LE(texel.y, map.texel_world_max.y * (1.0 + 1e-6));
  }
}

/// The largest texel of the plan's only map at points of a ground at y = 0, as shares of what the record
/// states.
glm::dvec2 largest_of_stated(const ShadowPlan& plan, const Camera& camera, const Box& ground,
                             const glm::dvec3& light, double& above_centre) {
  constexpr int kSteps = 40;
  glm::dvec2 largest{0.0};
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const glm::dvec3 p{glm::mix(ground.min.x, ground.max.x, i / double{kSteps}), 0.0,
                         glm::mix(ground.min.z, ground.max.z, k / double{kSteps})};
      const int index = map_serving(plan, p, glm::dot(p - camera.position, glm::normalize(camera.forward)));
      if (index < 0) continue;
      const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
      const glm::dvec2 texel =
          texel_extent_world(map.clip_from_world, map.texels(), glm::normalize(p - light), p);
      for (int axis = 0; axis < 2; ++axis) {
        largest[axis] = std::max(largest[axis], texel[axis] / map.texel_world_max[axis]);
        above_centre = std::max(above_centre, texel[axis] / map.texel_world[axis]);
      }
    }
  }
  return largest;
}

TEST(StabilityRegressions, the_largest_texel_under_a_local_light_is_largest_over_the_body) {
  // Texels grow with the distance from the light, and shrink across rays that leave its axis.
  const Box ground{{-20, -1, -20}, {20, 0, 20}}, aside{{14, -1, -3}, {20, 0, 3}};
  const glm::dvec3 above{0, 6, 0};
  double most_above_centre = 0.0;
  for (const Box& box : {ground, aside}) {
    for (const Light& light : {Light(SpotLight{above, {0, -1, 0}, 1.3, 60}), Light(PointLight{above, 60})}) {
      for (const Warp* warp : {&warps::none, &warps::optimal}) {
        const Camera camera =
            perspective_camera({0, 8, 30}, {0, -0.3, -1}, {0, 1, 0}, 1.4, 2.0, 0.1, 100, 640, 480);
        const std::vector<Box> boxes = {box};
        PlanOptions options;
        options.cascades = 1;
        options.warp.warp = warp;
        const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, options);
        ASSERT_EQ(plan.status, PlanStatus::ok);
        double above_centre = 0.0;
        const glm::dvec2 largest = largest_of_stated(plan, camera, box, above, above_centre);
        // How loose the bound is: not at all without a warp, but that the box reaches down to y = -1.
        const bool unwarped = warp == &warps::none;
        EXPECT_GE(unwarped ? std::min(largest.x, largest.y) : std::max(largest.x, largest.y),
                  unwarped ? 0.8 : 0.65)
            << warp->name;
        most_above_centre = std::max(most_above_centre, above_centre);
        EXPECT_LE(std::max(largest.x, largest.y), 1.0 + 1e-6);
      }
    }
  }

  EXPECT_GT(most_above_centre, 2.0);  // else the texel at the centre would do
}

TEST(StabilityRegressions, a_plate_in_a_small_rest_of_a_large_body_is_not_lost) {
  // Vertices of the rest have the rounding of the frustum that it was cut from, 6e3 times its own size.
  Camera camera;
  camera.position = {-0.062491018325090408, -0.5, -0.5};
  camera.forward = {-0.78279192544518705, 0.5713652028176599, 0.24653317518531065};
  camera.right = 0.018337392460323041;
  camera.left = -camera.right;
  camera.top = 0.0087268677907587893;
  camera.bottom = -camera.top;
  camera.near_depth = 3.924915362455303e-05;
  camera.far_depth = 0.25;
  const CameraAxes axes = camera_axes(camera);
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 on = axes.forward * (4.3e-5 * (1.0 + 0.001 * i));
    const Box plate{{on.x, on.y - 1e-6, on.z - 1e-6}, {on.x, on.y + 1e-6, on.z + 1e-6}};
    Polytope body = frustum_slice(camera, axes, camera.near_depth, camera.far_depth);
    clip(body, Box{{-0.2, on.y - 1e-6, on.z - 1e-6}, {on.x, 0.15, 0.07}});
    clip(body, Plane{-axes.forward, 1.6898516551443825e-4});
    clip(body, plate);
    EXPECT_FALSE(body.empty()) << i;
  }
}

TEST(StabilityRegressions, measure_takes_no_point_from_an_empty_box) {
  const Camera camera = perspective_camera({0, 2, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100, 640, 480);
  const std::vector<Box> ground = {{{-50, -1, -50}, {50, 0, 50}}};
  std::vector<Box> more = ground;
  more.push_back({{5, 5, -5}, {-5, -5, -40}});  // inside out
  const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.2, -1, 0.1}}, {ground, ground});
  const AliasingStats a = measure(plan, camera, {ground, ground}), b = measure(plan, camera, {more, more});
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.outside, b.outside);
}

TEST(StabilityRegressions, a_receiver_at_one_depth_close_to_the_eye_has_a_map) {
  // A plate across the view at 3.5e-8 of the far plane's depth: where the cascades end must not miss it.
  const Camera camera =
      perspective_camera({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.0174532925, 1.0, 3e-12, 1.0, 64, 64);
  const std::vector<Box> plate = {{{0, 3.518e-8, 0}, {1, 3.518e-8, 1}}}, casters = {{{0, 0, 0}, {1, 1, 0}}};
  const ShadowPlan plan = make_plan(camera, DirectionalLight{{0, 0, 1}}, {casters, plate});
  const glm::dvec3 p{1e-10, 3.518e-8, 1e-10};
  EXPECT_GE(map_serving(plan, p, p.y), 0);
}

TEST(StabilityRegressions, stable_maps_of_a_flat_scene_far_up_the_light_have_a_depth_range) {
  // Doubles are 128 apart there at least: the ends of a depth range that is shorter are one number.
  PlanOptions options;
  options.fit = Fit::stable;
  int maps = 0;
  for (int i = 0; i < 64; ++i) {
    const double y = 1e18 * (1.0 + 0.37 * i);
    const Camera camera = perspective_camera({0, y, 0}, {0, 0, -1}, {0, 1, 0}, 0.01, 1.0, 1e3, 1e5, 640, 640);
    const std::vector<Box> boxes = {{{-1e5, y, -1e5}, {1e5, y, 1e5}}};
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0, -1, 0}}, {boxes, boxes}, options);
    for (const ShadowMap& map : plan.maps()) {
      ++maps;
      EXPECT_GT(map.snap_key.depth_near, map.snap_key.depth_far) << y;
      EXPECT_GT(map.depth_range_world, 0.0) << y;
      EXPECT_TRUE(std::isfinite(map.clip_from_world[3][2])) << y;
    }
  }
  EXPECT_GT(maps, 64);
}

}  // namespace
}  // namespace gnomon::test
