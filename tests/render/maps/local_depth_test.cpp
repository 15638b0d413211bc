// Do filters that store depths keep their shadows where perspective leaves nearly all depths at the far end?
#include <gtest/gtest.h>

#include <cmath>

#include "filter/filter_block.hpp"
#include "mask_frame.hpp"

namespace gnomon::render {
namespace {

constexpr glm::dvec3 kLight{0.0, 30.0, 0.0};
constexpr float kPlateHeight = 4.0f, kPlateHalf = 4.0f;
/// Half the side of the plate's shadow on the ground.
constexpr double kShadowHalf = kPlateHalf * 30.0 / (30.0 - kPlateHeight);

/// A plate not far above the ground, and right under the light a speck that pulls the map's near plane to it.
Scene plate_and_speck() {
  Scene scene = empty_scene();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  add_box(scene, {-kPlateHalf, kPlateHeight - 0.1f, -kPlateHalf}, {kPlateHalf, kPlateHeight, kPlateHalf});
  add_box(scene, {-0.001f, 29.9f, -0.001f}, {0.001f, 29.95f, 0.001f});
  return scene;
}

/// Mean light on the ground in the middle of the plate's shadow, and round it.
struct MeanLight {
  double shadow = 0.0, open = 0.0;
};

MeanLight under(const Light& local, const Filter& filter) {
  static const Scene scene = plate_and_speck();
  static Renderer renderer(scene);
  const Camera camera =
      perspective_camera({0, 9, 26}, {0, -0.4, -1}, {0, 1, 0}, 0.9, 1.0, 0.5, 80.0, kSize, kSize);
  const std::vector<Box> boxes = boxes_of(scene);
  PlanOptions options;
  options.resolution.max_size = 256;
  set_margin(default_settings(filter), options);
  const ShadowPlan plan = make_plan(camera, local, {boxes, boxes}, options);
  EXPECT_EQ(plan.status, PlanStatus::ok);
  EXPECT_GT(depth_curve(plan, plan.map[0]), 100.0) << "the scene is to be hard";
  const Frame frame = draw(renderer, camera, plan, filter);
  MeanLight light;
  int dark = 0, lit = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (!frame.surface(i) || frame.point(i).y > 0.01) continue;
    const double out = std::max(std::abs(frame.point(i).x), std::abs(frame.point(i).z));
    if (out < 0.7 * kShadowHalf) light.shadow += frame.lit(i), ++dark;
    // Penumbras of pcss are wide.
    if (out > 1.6 * kShadowHalf && out < 12.0) light.open += frame.lit(i), ++lit;
  }
  EXPECT_GT(dark, 200);
  EXPECT_GT(lit, 200);
  return {light.shadow / dark, light.open / lit};
}

TEST(LocalLightDepth, every_filter_keeps_the_shadow_of_a_plate_under_a_spot) {
  for (const Filter* filter : all_filters()) {
    const MeanLight light = under(SpotLight{kLight, {0, -1, 0}, 0.5, 60.0}, *filter);
    EXPECT_LT(light.shadow, 0.05) << filter->info.name;
    EXPECT_GT(light.open, 0.95) << filter->info.name;
  }
}

TEST(LocalLightDepth, stored_depths_keep_it_under_a_point_light) {
  for (const Filter* filter : {&filters::vsm, &filters::esm}) {
    const MeanLight light = under(PointLight{kLight, 60.0}, *filter);
    EXPECT_LT(light.shadow, 0.05) << filter->info.name;
    EXPECT_GT(light.open, 0.95) << filter->info.name;
  }
}

TEST(LocalLightDepth, is_even_in_distance_along_the_middle_of_a_spot) {
  const SpotLight spot{{0, 10, 0}, {0, -1, 0}, 0.4, 20.0};
  const std::vector<Box> receivers{{{-2, -0.1, -2}, {2, 0, 2}}}, casters{{{-0.2, 2, -0.2}, {0.2, 9.5, 0.2}}};
  const Camera camera =
      perspective_camera({0, 3, 8}, {0, -0.3, -1}, {0, 1, 0}, 0.9, 1.0, 0.5, 40.0, kSize, kSize);
  for (const ClipSpace space : {kOpenGl, kOpenGlZeroToOne}) {
    PlanOptions options;
    options.clip_space = space;
    options.warp.warp = &warps::none;
    const ShadowPlan plan = make_plan(camera, spot, {casters, receivers}, options);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    const double curve = depth_curve(plan, plan.map[0]);
    const auto depth_at = [&](double y) {
      const glm::dvec4 h =
          glm::inverse(clip_from_gl_clip(space)) * plan.map[0].clip_from_world * glm::dvec4(0, y, 0, 1);
      return linear_depth(0.5 * h.z / h.w + 0.5, curve);
    };
    const double step = depth_at(6.0) - depth_at(7.0);
    EXPECT_GT(step, 0.01);
    EXPECT_NEAR(depth_at(1.0) - depth_at(2.0), step, 0.01 * step);
    EXPECT_NEAR(depth_at(3.0) - depth_at(4.0), step, 0.01 * step);
  }
}

TEST(LocalLightDepth, parallel_light_has_no_curve) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  const ShadowPlan plan = plan_for(scene, camera, kSlant, {});
  ASSERT_GT(plan.map_count, 0);
  EXPECT_EQ(depth_curve(plan, plan.map[0]), 0.0);
  EXPECT_EQ(linear_depth(0.3, 0.0), 0.3);
}

}  // namespace
}  // namespace gnomon::render
