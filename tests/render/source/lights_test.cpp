// Is the picture of many lights the sum of each one's, with the shadows that its own maps have?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gnomon/render/renderer.hpp"
#include "mask_frame.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

FilterSettings settings_of(const char* text) {
  return parse_filter(text).settings;
}

/// Other points are dark whatever the mask holds.
bool in_range(const Light& light, const glm::dvec3& point) {
  if (const auto* point_light = std::get_if<PointLight>(&light))
    return glm::distance(point_light->position, point) < point_light->range;
  const auto* spot = std::get_if<SpotLight>(&light);
  if (spot == nullptr) return true;
  const glm::dvec3 offset = point - spot->position;
  return glm::length(offset) < spot->range &&
         glm::dot(glm::normalize(offset), glm::normalize(spot->direction)) > std::cos(spot->outer_radians);
}

/// A box on the ground under a weak sun, a spot and two point lights, one of them out of view.
struct Stage {
  Scene scene = box_on_ground();
  Camera camera = camera_on_box(kSize, kSize);
  std::vector<Box> boxes = boxes_of(scene);
  std::vector<LightRequest> requests{{DirectionalLight{kSlant}},
                                     {SpotLight{{-4, 6, 4}, {0.6, -1, -0.5}, 0.6, 20.0}},
                                     {PointLight{{3, 3, 2}, 9.0}},
                                     {PointLight{{0, 3, 90}, 5.0}}};
  Renderer renderer{scene};
  std::vector<std::byte> memory = std::vector<std::byte>(light_memory(requests.size(), 0));
  std::vector<LightState> states = std::vector<LightState>(requests.size());
  LightHistory history{states, 0, {}};
  LightOptions pool;
  LightPlan plan;
  std::vector<ShadowPlan> own = std::vector<ShadowPlan>(requests.size());

  explicit Stage(const FilterSettings& filter) {
    pool.pool_width = 2048;
    pool.pool_height = 1024;
    pool.most_size = 512;
    set_margin(filter, pool.plan);
  }
  /// Makes room for requests that were added.
  void grow() {
    memory.resize(light_memory(requests.size(), 0));
    states.assign(requests.size(), {});
    history = {states, 0, {}};
    own.resize(requests.size());
  }
  void replan() {
    plan = plan_lights(camera, requests, {boxes, boxes}, pool, memory, &history);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const LightMaps& maps = plan.lights[i];
      if (!maps.due) continue;
      const Light& light = requests[i].light;
      own[i] = make_plan(maps.frames > 1 ? camera_round(light, camera) : camera, light, {boxes, boxes},
                         light_options(pool, maps));
    }
  }
  /// All lights, or one alone.
  [[nodiscard]] std::vector<DrawnLight> lights(int only = -1) const {
    std::vector<DrawnLight> drawn;
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const bool shines = only < 0 || static_cast<int>(i) == only;
      drawn.push_back(
          {requests[i].light, &own[i], glm::vec3(shines ? 0.5f + 0.1f * static_cast<float>(i) : 0.0f)});
    }
    return drawn;
  }
  FrameStats draw(const FilterSettings& filter, int only = -1, const ClusterOptions& clusters = {}) {
    FrameOptions frame;
    frame.light_clusters = clusters;
    frame.time_passes = false;
    return renderer.draw({plan, lights(only)}, camera, renderer.prepare(filter, Source::lights), frame);
  }
};

TEST(LightsRender, the_picture_is_the_sum_of_each_light_alone) {
  const FilterSettings filter = settings_of("pcf");
  Stage stage(filter);
  stage.replan();
  ASSERT_EQ(stage.plan.mapped, 3);
  stage.draw(filter);
  const FloatImage all = stage.renderer.light_sum();
  std::vector<float> sum(all.values.size(), 0.0f);
  for (int i = 0; i < 4; ++i) {
    stage.draw(filter, i);
    const FloatImage alone = stage.renderer.light_sum();
    float brightest = 0.0f;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] += alone.values[k];
      brightest = std::max(brightest, alone.values[k]);
    }
    EXPECT_EQ(brightest > 0.01f, i < 3) << i;
  }
  for (std::size_t k = 0; k < sum.size(); ++k)
    ASSERT_NEAR(sum[k], all.values[k], 1e-5f * (1.0f + sum[k])) << k;
}

TEST(LightsRender, clusters_give_the_bits_of_a_walk_over_all_lights) {
  for (const char* name : {"hard", "pcf"}) {
    const FilterSettings filter = settings_of(name);
    Stage stage(filter);
    // The eye within a light, a light behind the eye, and many small ones.
    stage.requests.push_back({PointLight{stage.camera.position, 6.0}});
    const glm::dvec3 forward = camera_axes(stage.camera).forward;
    stage.requests.push_back({PointLight{stage.camera.position - 8.0 * forward, 3.0}});
    for (int i = 0; i < 40; ++i)
      stage.requests.push_back({PointLight{{-8.0 + 2.0 * (i % 8), 1.0, -4.0 + 2.0 * (i / 8)}, 2.5}});
    stage.grow();
    stage.replan();
    ASSERT_GT(stage.plan.mapped, 20);
    constexpr ClusterOptions kAll{1 << 16, 1}, kEach{0, 1};
    stage.draw(filter, -1, kAll);
    const FloatImage all = stage.renderer.light_sum(), mask = stage.renderer.mask();
    for (const ClusterOptions& clusters : {ClusterOptions{}, ClusterOptions{8, 40}, ClusterOptions{64, 1}}) {
      stage.draw(filter, -1, clusters);
      EXPECT_EQ(stage.renderer.light_sum().values, all.values) << clusters.tile_pixels;
      EXPECT_EQ(stage.renderer.mask().values, mask.values) << clusters.tile_pixels;
    }
    stage.draw(filter, -1, kEach);
    const FloatImage each = stage.renderer.light_sum();
    for (std::size_t k = 0; k < all.values.size(); ++k)
      ASSERT_NEAR(each.values[k], all.values[k], 1e-5f * (1.0f + all.values[k])) << k;
  }
}

TEST(LightsRender, a_parallel_view_shows_what_a_walk_over_all_lights_shows) {
  const FilterSettings filter = settings_of("hard");
  Stage stage(filter);
  const Camera& eye = stage.camera;
  stage.camera = orthographic_camera(eye.position, eye.forward, eye.up, 24.0, 1.0, 0.5, 60.0, kSize, kSize);
  stage.requests.push_back({PointLight{{-4.0, 1.5, -3.0}, 3.0}});  // all of it in front of the eye
  stage.grow();
  stage.replan();
  ASSERT_GE(stage.plan.mapped, 3);
  stage.draw(filter, -1, {1 << 16, 1});
  const FloatImage all = stage.renderer.light_sum();
  stage.draw(filter, -1, {0, 1});  // each in the pixels that it can light
  const FloatImage each = stage.renderer.light_sum();
  for (std::size_t k = 0; k < all.values.size(); ++k)
    ASSERT_NEAR(each.values[k], all.values[k], 1e-5f * (1.0f + all.values[k])) << k;
}

TEST(LightsRender, lights_without_a_range_light_nothing) {
  const FilterSettings filter = settings_of("hard");
  Stage stage(filter);
  stage.replan();
  stage.draw(filter);
  const FloatImage before = stage.renderer.light_sum();
  std::vector<DrawnLight> lights = stage.lights();
  // Another light than the plan was made for, in the place of the last one, which is out of view.
  lights[3].light = PointLight{{0, 1, 0}, 0.0};
  FrameOptions frame;
  frame.time_passes = false;
  for (const int tile : {32, 0}) {
    frame.light_clusters.tile_pixels = tile;
    stage.renderer.draw({stage.plan, lights}, stage.camera, stage.renderer.prepare(filter, Source::lights),
                        frame);
    const FloatImage after = stage.renderer.light_sum();
    for (std::size_t k = 0; k < before.values.size(); ++k)
      ASSERT_NEAR(after.values[k], before.values[k], 1e-5f * (1.0f + before.values[k])) << tile;
  }
}

TEST(LightsRender, each_mask_is_that_of_the_light_s_own_plan) {
  for (const char* name : {"hard", "pcf", "pcss"}) {
    const FilterSettings filter = settings_of(name);
    Stage stage(filter);
    stage.replan();
    for (std::size_t i = 0; i < 3; ++i) {
      stage.draw(filter, static_cast<int>(i));
      const FloatImage pooled = stage.renderer.mask();
      const Frame single = render::draw(stage.renderer, stage.camera, stage.own[i], filter);
      std::size_t seen = 0, shadowed = 0, other = 0;
      for (std::size_t k = 0; k < single.pixels(); ++k) {
        if (!single.surface(k) || !in_range(stage.requests[i].light, single.point(k))) continue;
        ++seen;
        shadowed += single.lit(k) < 0.5f;
        other += std::abs(single.lit(k) - pooled.values[2 * k]) > 0.01f;
      }
      EXPECT_GT(seen, 1000u) << name << i;
      EXPECT_GT(shadowed, 50u) << name << i;
      // Rounding of another matrix decides a few.
      EXPECT_LE(other, seen / 500) << name << i;
    }
  }
}

TEST(LightsRender, a_pool_keeps_the_maps_that_are_not_due) {
  const FilterSettings filter = settings_of("hard");
  Stage stage(filter);
  stage.pool.full_share = 1.0;  // only the sun is due in every frame
  stage.replan();
  EXPECT_EQ(stage.draw(filter).lights_drawn, 3);
  const FloatImage first = stage.renderer.light_sum();
  int kept = 0;
  for (int frame = 0; frame < 8; ++frame) {
    stage.replan();
    const FrameStats stats = stage.draw(filter);
    EXPECT_EQ(stats.lights_drawn, stage.plan.due);
    kept += stage.plan.mapped - stage.plan.due;
    EXPECT_EQ(stage.renderer.light_sum().values, first.values) << frame;
  }
  EXPECT_GT(kept, 4);
  // Another frame takes the texels: all lights are drawn again.
  render::draw(stage.renderer, stage.camera, stage.own[1], filter);
  stage.replan();
  EXPECT_EQ(stage.draw(filter).lights_drawn, 3);
  EXPECT_EQ(stage.renderer.light_sum().values, first.values);
}

TEST(LightsRender, filters_that_store_texels_are_refused_and_no_lights_are_dark) {
  const FilterSettings filter = settings_of("hard");
  Stage stage(filter);
  EXPECT_THROW(static_cast<void>(stage.renderer.prepare(settings_of("vsm"), Source::lights)), RenderError);
  const PreparedFilter prepared = stage.renderer.prepare(filter, Source::lights);
  stage.renderer.draw({LightPlan{}, {}}, stage.camera, prepared);
  const FloatImage sum = stage.renderer.light_sum();
  EXPECT_TRUE(std::all_of(sum.values.begin(), sum.values.end(), [](float v) { return v == 0.0f; }));
}

}  // namespace
}  // namespace gnomon::render
