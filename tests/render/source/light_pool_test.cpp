// Do the lights of a file shine as it says, and does a pool plan them as plan_lights and make_plan do?
#include "gnomon/render/light_pool.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "gnomon/render/renderer.hpp"
#include "mask_frame.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

SceneLight light_of_file(const char* name, const Light& light, const glm::vec3& color, double intensity) {
  return {name, light, color, intensity};
}

TEST(LightsOfAFile, keep_the_proportions_of_their_intensities_and_dark_ones_are_not_there) {
  Scene scene;
  scene.lights = {light_of_file("sun", DirectionalLight{}, {1, 0.5, 0.25}, 5.0),
                  light_of_file("off", PointLight{}, {1, 1, 1}, 0.0),
                  light_of_file("black", PointLight{}, {0, 0, 0}, 90.0),
                  light_of_file("lamp", PointLight{{1, 2, 3}, 9.0}, {1, 1, 0}, 20.0)};
  std::vector<PooledLight> lights = lights_of(scene);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0].name, "sun");
  EXPECT_EQ(lights[1].name, "lamp");
  EXPECT_FLOAT_EQ(lights[0].color.x / lights[1].color.x, 5.0f / 20.0f);
  EXPECT_FLOAT_EQ(lights[0].color.z / lights[0].color.x, 0.25f);
  EXPECT_EQ(lights[1].color.z, 0.0f);
  EXPECT_TRUE(lights[1].inverse_square);
  EXPECT_EQ(std::get<PointLight>(lights[1].request.light).range, 9.0);
  // As large and as small as files may have them.
  scene.lights = {light_of_file("huge", DirectionalLight{}, {1, 1, 1}, 1e30),
                  light_of_file("faint", PointLight{}, {1, 1, 1}, 1e10)};
  lights = lights_of(scene);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_FLOAT_EQ(lights[1].color.x / lights[0].color.x, 1e-20f);
  EXPECT_TRUE(lights_of(Scene()).empty());
}

TEST(Exposure, leaves_a_hundredth_of_the_lit_pixels_above_a_white_surface_in_the_sun) {
  FloatImage sum{20, 20, 3, std::vector<float>(1200, 0.0f), {}};
  EXPECT_EQ(exposure_of(sum), 0.0) << "in the dark";
  // Half is dark; of the 200 others two are as bright as a lamp itself.
  for (std::size_t i = 0; i < 200; ++i)
    sum.values[3 * i + i % 3] = i < 2 ? 1e6f : 0.5f + 0.001f * static_cast<float>(i);
  const double exposure = exposure_of(sum);
  int above = 0;
  for (const float value : sum.values)
    above += static_cast<double>(value) * exposure > 3.1 * (1.0 + 1e-6) ? 1 : 0;
  EXPECT_EQ(above, 2);
  EXPECT_NEAR(exposure * static_cast<double>(0.5f + 0.001f * 199.0f), 3.1, 1e-5);
  for (float& value : sum.values) value *= 8.0f;
  EXPECT_NEAR(exposure_of(sum), exposure / 8.0, 1e-9);
}

/// A box on the ground under a sun, a spot and two points, one of them out of view, as a file has them.
struct Lit {
  Scene scene = box_on_ground();
  Camera camera = camera_on_box(kSize, kSize);
  std::vector<Box> boxes = boxes_of(scene);
  Renderer renderer{scene};
  FilterSettings filter = parse_filter("pcf").settings;
  LightOptions options;

  Lit() {
    scene.lights = {
        light_of_file("sun", DirectionalLight{kSlant}, {1, 0.9, 0.8}, 2.0),
        light_of_file("spot", SpotLight{{-4, 6, 4}, {0.6, -1, -0.5}, 0.6, 20.0}, {1, 0.3, 0.2}, 90.0),
        light_of_file("lamp", PointLight{{3, 3, 2}, 9.0}, {0.2, 0.4, 1}, 15.0),
        light_of_file("far", PointLight{{0, 3, 90}, 5.0}, {1, 1, 1}, 15.0)};
    options.pool_width = options.pool_height = 1024;
    options.most_size = 512;
    options.most_frames = 1;
    set_margin(filter, options.plan);
  }
  FloatImage sum_of(const LightPool& pool, const std::vector<DrawnLight>& lights) {
    FrameOptions frame;
    frame.time_passes = false;
    renderer.draw({pool.last(), lights}, camera, renderer.prepare(filter, Source::lights), frame);
    return renderer.light_sum();
  }
};

TEST(LightPool, of_all_lights_of_a_file_draws_the_sum_of_each_alone) {
  Lit lit;
  LightPool pool(lights_of(lit.scene), lit.options);
  const LightPlan& plan = pool.plan(lit.camera, {lit.boxes, lit.boxes});
  ASSERT_EQ(plan.mapped, 3);
  EXPECT_EQ(plan.lights[3].outcome, LightOutcome::without_receiver);
  const FloatImage all = lit.sum_of(pool, pool.drawn());
  std::vector<float> sum(all.values.size(), 0.0f);
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<DrawnLight> lights = pool.drawn();
    for (std::size_t k = 0; k < 4; ++k)
      if (k != i) lights[k].color = glm::vec3(0.0f);
    const FloatImage alone = lit.sum_of(pool, lights);
    float brightest = 0.0f;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] += alone.values[k];
      brightest = std::max(brightest, alone.values[k]);
    }
    EXPECT_EQ(brightest > 1e-4f, i < 3) << i;
  }
  for (std::size_t k = 0; k < sum.size(); ++k)
    ASSERT_NEAR(sum[k], all.values[k], 1e-5f * (1.0f + sum[k])) << k;
  // Twice the exposure is twice the light.
  const FloatImage twice = lit.sum_of(pool, pool.drawn(2.0));
  for (std::size_t k = 0; k < sum.size(); ++k)
    ASSERT_NEAR(twice.values[k], 2.0f * all.values[k], 1e-5f * (1.0f + sum[k])) << k;
}

TEST(LightPool, plans_each_light_as_a_pool_of_it_alone_where_both_have_the_same_size) {
  const Lit lit;
  LightPool pool(lights_of(lit.scene), lit.options);
  const LightPlan& plan = pool.plan(lit.camera, {lit.boxes, lit.boxes});
  for (std::size_t i = 0; i < 3; ++i) {
    const ShadowPlan alone = make_plan(lit.camera, pool.lights()[i].request.light, {lit.boxes, lit.boxes},
                                       light_options(lit.options, plan.lights[i]));
    ASSERT_GT(alone.map_count, 0) << i;
    ASSERT_EQ(pool.plans()[i].map_count, alone.map_count) << i;
    for (std::size_t k = 0; k < alone.maps().size(); ++k)
      EXPECT_EQ(pool.plans()[i].map[k].clip_from_world, alone.map[k].clip_from_world) << i << " " << k;
  }
}

TEST(LightPool, keeps_maps_that_are_not_due_from_frame_to_frame) {
  Lit lit;
  lit.options.most_frames = 8;
  lit.options.full_share = 1.0;  // only the sun is due in every frame
  LightPool pool(lights_of(lit.scene), lit.options);
  EXPECT_EQ(pool.plan(lit.camera, {lit.boxes, lit.boxes}).due, 3);
  const FloatImage first = lit.sum_of(pool, pool.drawn());
  int kept = 0;
  for (int frame = 0; frame < 8; ++frame) {
    const LightPlan& plan = pool.plan(lit.camera, {lit.boxes, lit.boxes});
    kept += plan.mapped - plan.due;
    EXPECT_EQ(lit.sum_of(pool, pool.drawn()).values, first.values) << frame;
  }
  EXPECT_GT(kept, 4);
}

// The lamp's light over that of the same lamp without a falloff by the square, at each pixel that it lights.
TEST(DrawnLight, by_the_inverse_square_has_its_color_at_one_unit) {
  Lit lit;
  const PointLight lamp{{3, 3, 2}, 9.0};
  for (const ClusterOptions& clusters : {ClusterOptions{}, ClusterOptions{0, 1}}) {
    LightPool pool({{{lamp}, glm::vec3(1.0f)}}, lit.options);
    (void)pool.plan(lit.camera, {lit.boxes, lit.boxes});
    std::vector<DrawnLight> lights = pool.drawn();
    FrameOptions frame;
    frame.time_passes = false;
    frame.light_clusters = clusters;
    const auto draw = [&](bool inverse_square) {
      lights[0].inverse_square = inverse_square;
      lit.renderer.draw({pool.last(), lights}, lit.camera, lit.renderer.prepare(lit.filter, Source::lights),
                        frame);
      return lit.renderer.light_sum();
    };
    const FloatImage faded = draw(false), square = draw(true), positions = lit.renderer.positions();
    std::size_t seen = 0;
    for (std::size_t i = 0; i < faded.values.size() / 3; ++i) {
      const float* at = &positions.values[4 * i];
      const double away = glm::length(glm::dvec3(at[0], at[1], at[2]) + lit.camera.position - lamp.position);
      const double part = away / lamp.range;
      if (faded.values[3 * i] < 1e-3f || part > 0.95) continue;
      const double fade = (1.0 - part) * (1.0 + part),
                   recommended = (1.0 - std::pow(part, 4.0)) / (away * away);
      ASSERT_NEAR(static_cast<double>(square.values[3 * i] / faded.values[3 * i]), recommended / fade,
                  1e-3 * recommended / fade);
      ++seen;
    }
    EXPECT_GT(seen, 1000u);
  }
}

}  // namespace
}  // namespace gnomon::render
