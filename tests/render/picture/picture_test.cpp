// Pictures that explain themselves: are their colours and their edges right?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "gnomon/render/picture.hpp"
#include "gnomon/render/renderer.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

int warmth(Color c) {
  return int{c.x} - int{c.z};
}

Color pixel(const Image& image, int x, int y) {
  const auto i = static_cast<std::size_t>(y * image.width + x) * 4;
  return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
}

TEST(HeatColor, is_defined_for_every_number) {
  EXPECT_EQ(heat_color(0.0), heat_color(1.0 / 16.0));
  EXPECT_EQ(heat_color(-1.0), heat_color(1.0 / 16.0));
  EXPECT_EQ(heat_color(std::numeric_limits<double>::quiet_NaN()), heat_color(1.0 / 16.0));
  EXPECT_EQ(heat_color(std::numeric_limits<double>::infinity()), heat_color(16.0));
}

TEST(HeatColor, is_neutral_at_one_warm_above_and_cold_below) {
  EXPECT_LT(std::abs(warmth(heat_color(1.0))), 8);
  for (double m = 1.2; m <= 16.0; m *= 1.3) EXPECT_GT(warmth(heat_color(m)), 15) << m;
  for (double m = 0.8; m >= 1.0 / 16.0; m /= 1.3) EXPECT_LT(warmth(heat_color(m)), -15) << m;
}

TEST(Pictures, clip_drawing_at_their_edges) {
  Image image = blank_image(4, 3, {10, 20, 30});
  fill_rectangle(image, -5, -5, 6, 6, {1, 2, 3});
  EXPECT_EQ(pixel(image, 0, 0), Color(1, 2, 3));
  EXPECT_EQ(pixel(image, 1, 0), Color(10, 20, 30));
  paste(image, blank_image(3, 3, {7, 7, 7}), 3, 2);
  EXPECT_EQ(pixel(image, 3, 2), Color(7, 7, 7));
  EXPECT_EQ(pixel(image, 2, 2), Color(10, 20, 30));
  paste(image, blank_image(2, 2, {9, 9, 9}), 100, 100);
  draw_text(image, -3, -3, "\x01 text far too long", {255, 255, 255});
  EXPECT_EQ(image.rgba.size(), 4u * 3u * 4u);
}

TEST(Pictures, shrink_to_the_mean_of_what_each_pixel_covers) {
  Image image = blank_image(4, 2, {0, 0, 0});
  fill_rectangle(image, 0, 0, 1, 2, {200, 100, 40});
  const Image small = shrunk(image, 2, 1);
  EXPECT_EQ(pixel(small, 0, 0), Color(100, 50, 20));
  EXPECT_EQ(pixel(small, 1, 0), Color(0, 0, 0));
}

TEST(Text, is_as_wide_and_high_as_it_says) {
  Image image = blank_image(64, 16, {0, 0, 0});
  draw_text(image, 2, 3, "Hj", {255, 255, 255});
  int right = 0, bottom = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (pixel(image, x, y).x == 0) continue;
      right = std::max(right, x);
      bottom = std::max(bottom, y);
    }
  }
  // The j hangs below the line, and leaves a dot free on its right.
  EXPECT_EQ(right, 2 + text_width("HI") - 1 - 1);
  EXPECT_EQ(bottom, 3 + text_height() - 1);
  EXPECT_EQ(text_width(""), 0);
}

TEST(HeatLegend, is_whole_for_pictures_of_every_width) {
  for (const int width : {1, 320, 640, 1280, 1920, 3840}) {
    const Image legend = heat_legend(width);
    const double dot = 0.5 / (30.0 * std::max(1, width / 640));  // half a pixel of the scale
    bool cold = false, warm = false;
    int last_row = 0;
    for (int y = 0; y < legend.height; ++y) {
      for (int x = 0; x < legend.width; ++x) {
        cold = cold || pixel(legend, x, y) == heat_color(std::exp2(-3.5 + dot));
        warm = warm || pixel(legend, x, y) == heat_color(std::exp2(3.5 + dot));
        if (pixel(legend, x, y) == heat_color(3.0)) last_row = y;
      }
    }
    EXPECT_TRUE(cold && warm) << width;
    // The words below the scale end with a row of the panel to spare.
    EXPECT_LT(last_row, legend.height - 1) << width;
    EXPECT_GT(last_row, legend.height / 2) << width;
  }
}

TEST(HeatLegend, shows_the_colours_of_the_scale_in_order) {
  Image image = blank_image(640, 360, {0, 0, 0});
  draw_heat_legend(image);
  // Along some row of the legend lie all colours from the cold end to the warm one.
  bool found = false;
  for (int y = 0; y < image.height && !found; ++y) {
    int cold = -1, neutral = -1, warm = -1;
    for (int x = 0; x < image.width; ++x) {
      if (pixel(image, x, y) == heat_color(std::exp2(-3.5 + 0.5 / 30))) cold = x;
      if (pixel(image, x, y) == heat_color(std::exp2(0.5 / 30))) neutral = x;
      if (pixel(image, x, y) == heat_color(std::exp2(3.5 + 0.5 / 30))) warm = x;
    }
    found = cold >= 0 && cold < neutral && neutral < warm;
  }
  EXPECT_TRUE(found);
}

// The far plane lies close behind a single object: what has no distance has no air before it either.
TEST(Air, leaves_a_single_object_its_colours_wherever_the_far_plane_is) {
  Scene scene = empty_scene();
  scene.materials.front().base_color = {0.2f, 0.02f, 0.02f, 1.0f};  // far from the horizon's
  add_box(scene, kBoxMin, kBoxMax);
  Renderer renderer(scene);
  const PreparedFilter filter = renderer.prepare(filters::hard);
  std::vector<Color> middle;
  for (const double far_depth : {1.0, 100.0}) {
    Camera camera = camera_on_box(64, 64);
    const double away = glm::distance(camera.position, 0.5 * (glm::dvec3(kBoxMin) + glm::dvec3(kBoxMax)));
    camera.far_depth = far_depth * (away + 3.0);
    renderer.draw(plan_for(scene, camera, {0.3, -1.0, -0.5}, {}), camera, filter);
    middle.push_back(pixel(renderer.image(), 32, 32));
  }
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(middle[0][i], middle[1][i], 4) << i;
}

TEST(HeatColor, is_the_colour_that_shaders_give_a_pixel) {
  const Scene scene = boxes_on_ground();
  const Camera camera = going(0.0);
  PlanOptions options;
  options.cascades = 3;
  options.resolution.max_size = 256;
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.3, -1.0, -0.5));
  Renderer renderer(scene);
  renderer.draw(plan_for(scene, camera, light, options), camera, renderer.prepare(filters::hard));
  const Image heat = renderer.heat_map();
  const FloatImage aliasing = renderer.aliasing(), normals = renderer.normals(), mask = renderer.mask();
  const auto mask_channels = static_cast<std::size_t>(mask.channels);
  int compared = 0;
  for (std::size_t i = 0; i < heat.rgba.size() / 4; ++i) {
    if (!(aliasing.values[4 * i] > 0.0f)) continue;
    const glm::dvec3 normal(normals.values[4 * i], normals.values[4 * i + 1], normals.values[4 * i + 2]);
    const double shape =
        0.90 + 0.10 * static_cast<double>(mask.values[mask_channels * i]) * -glm::dot(normal, light);
    const Color expected = heat_color(static_cast<double>(aliasing.values[4 * i]));
    for (int k = 0; k < 3; ++k)
      ASSERT_NEAR(heat.rgba[4 * i + static_cast<std::size_t>(k)], expected[k] * shape, 2.0) << i;
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

TEST(CascadeColors, are_those_that_shaders_tint_the_maps_with) {
  Scene scene = boxes_on_ground();
  const Camera camera = going(0.0);
  PlanOptions options;
  options.cascades = kMaxMaps;
  options.split.scheme = SplitScheme::uniform;
  Renderer renderer(scene);
  renderer.draw(plan_for(scene, camera, {0.3, -1.0, -0.5}, options), camera, renderer.prepare(filters::hard));
  const Image tinted = renderer.cascade_tint();
  const FloatImage mask = renderer.mask();
  const auto mask_channels = static_cast<std::size_t>(mask.channels);
  // White surfaces take the tint's order of channels, where these differ beyond what air adds.
  constexpr int kApart = 40;
  int compared = 0;
  for (std::size_t i = 0; i < tinted.rgba.size() / 4; ++i) {
    const int map = static_cast<int>(mask.values[mask_channels * i + 1]);
    if (map < 0 || mask.values[mask_channels * i] < 1.0f) continue;
    const Color shown(tinted.rgba[4 * i], tinted.rgba[4 * i + 1], tinted.rgba[4 * i + 2]),
        expected = cascade_color(map);
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 2}}) {
      const int apart = expected[a] - expected[b];
      ASSERT_TRUE(std::abs(apart) < kApart || (shown[a] < shown[b]) == (apart < 0)) << map << " " << i;
    }
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

TEST(CascadeColors, differ_between_neighbouring_maps) {
  for (int map = 0; map < 15; ++map) EXPECT_NE(cascade_color(map), cascade_color(map + 1));
}

TEST(Pictures, shrink_to_the_nearest_of_eight_bits) {
  Image image = blank_image(2, 1, {0, 0, 0});
  fill_rectangle(image, 1, 0, 1, 1, {255, 3, 1});
  EXPECT_EQ(pixel(shrunk(image, 1, 1), 0, 0), Color(128, 2, 1));
}

}  // namespace
}  // namespace gnomon::render
