// The light over whole pixels against shares worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "gnomon/trace/reference.hpp"
#include "picture.hpp"
#include "render/test_scene.hpp"

namespace gnomon::trace {
namespace {

using render::add_quad;
using render::empty_scene;

const Light kOverhead = DirectionalLight{{0, -1, 0}};

/// Looks straight down on [-1,1] x [-1,1] from height 2: pixel column to world x, row to world z.
Camera overhead(int size) {
  return orthographic_camera({0, 2, 0}, {0, -1, 0}, {0, 0, -1}, 2.0, 1.0, 0.1, 3.0, size, size);
}

PixelReference reference_of(const Scene& scene, const Camera& camera, const Light& light,
                            int samples = kSoftSamples) {
  const Tracer tracer(scene);
  const Picture picture = picture_of(tracer, camera);
  return pixel_reference(tracer, camera,
                         surface_points(tracer, camera, light, picture.positions, picture.normals), light,
                         samples);
}

TEST(PixelReference, pixels_without_a_surface_that_faces_the_light_have_none) {
  Scene scene = empty_scene();
  for (const float value : reference_of(scene, overhead(4), kOverhead).pixels) EXPECT_EQ(value, -1.0f);
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  for (const float value : reference_of(scene, overhead(4), DirectionalLight{{0, 1, 0}}).pixels)
    EXPECT_EQ(value, -1.0f);
}

TEST(PixelReference, a_pixel_that_an_edge_cuts_in_half_is_half_lit) {
  Scene scene = empty_scene();
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  add_quad(scene, {-40, 4, 40}, {40, 0, 0}, {0, 0, -80});  // above the camera, over x < 0
  // Three columns: the edge runs along the middle of the second, between two columns of the 4 x 4 samples.
  const PixelReference light = reference_of(scene, overhead(3), kOverhead);
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_EQ(light.pixels[3 * row], 0.0f);
    EXPECT_EQ(light.pixels[3 * row + 1], 0.5f);
    EXPECT_EQ(light.pixels[3 * row + 2], 1.0f);
  }
  EXPECT_EQ(std::count(light.several.begin(), light.several.end(), 1), 0);
}

TEST(PixelReference, a_fence_finer_than_a_pixel_leaves_its_open_share) {
  Scene scene = empty_scene();
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  // 32 slats in each pixel, three quarters of them open.
  constexpr int kSize = 4, kSlatsOfPixel = 32;
  constexpr float kPeriod = 2.0f / (kSize * kSlatsOfPixel);
  for (int i = 0; i < kSize * kSlatsOfPixel; ++i)
    add_quad(scene, {-1.0f + kPeriod * static_cast<float>(i), 4, 2}, {0.25f * kPeriod, 0, 0}, {0, 0, -4});
  const PixelReference few = reference_of(scene, overhead(kSize), kOverhead, 64);
  double sum = 0.0;
  for (const float value : few.pixels) {
    // 64 samples of a share of 3/4: a standard deviation of 0.054, and four of them.
    EXPECT_NEAR(value, 0.75, 0.22);
    sum += static_cast<double>(value) / (kSize * kSize);
  }
  EXPECT_NEAR(sum, 0.75, 0.05);
}

TEST(PixelReference, pixels_of_several_surfaces_have_the_mean_of_what_the_light_reaches) {
  // The middle pixel reaches from x = -1/3 to 1/3.
  const auto middle = [](const Scene& scene) {
    const PixelReference light = reference_of(scene, overhead(3), kOverhead);
    return std::pair(light.pixels[4], light.several[4]);
  };
  Scene cut = empty_scene();
  add_quad(cut, {-2, 0, 2}, {2 + 1.0f / 6, 0, 0}, {0, 0, -4});
  // One of four columns of samples shows the sky, which has no part in the share.
  EXPECT_EQ(middle(cut), std::pair(1.0f, std::uint8_t{1}));
  Scene wall = cut;
  add_quad(wall, {1.0f / 6, 0, 2}, {0.2f, 1.9f, 0}, {0, 0, -4});  // steep, and in the light as well
  EXPECT_EQ(middle(wall), std::pair(1.0f, std::uint8_t{1}));
  Scene roofed = cut;
  add_quad(roofed, {1.0f / 6, 1, 2}, {2, 0, 0},
           {0, 0, -4});  // a step in the light; the ground lies in shadow
  add_quad(roofed, {-40, 4, 40}, {40 + 1.0f / 6, 0, 0}, {0, 0, -80});
  EXPECT_EQ(middle(roofed), std::pair(0.25f, std::uint8_t{1}));
  Scene flat = cut;
  add_quad(flat, {1.0f / 6, 0, 2}, {2, 0, 0}, {0, 0, -4});  // another triangle of the same plane
  EXPECT_EQ(middle(flat), std::pair(1.0f, std::uint8_t{0}));
}

TEST(PixelReference, looks_through_back_faces_as_a_picture_does) {
  Scene scene = empty_scene();
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  const Camera camera = overhead(3);
  const Tracer ground(scene);
  const Picture picture = picture_of(ground, camera);
  // A ceiling that faces down, between the camera and the ground: the picture shows the ground in its shadow.
  add_quad(scene, {-2, 1, -2}, {4, 0, 0}, {0, 0, 4});
  const auto light_with = [&](bool double_sided) {
    scene.materials[0].double_sided = double_sided;
    const Tracer tracer(scene);
    return pixel_reference(tracer, camera,
                           surface_points(tracer, camera, kOverhead, picture.positions, picture.normals),
                           kOverhead);
  };
  const PixelReference one_sided = light_with(false), double_sided = light_with(true);
  EXPECT_EQ(one_sided.pixels[4], 0.0f);
  EXPECT_EQ(one_sided.several[4], 0);
  EXPECT_EQ(double_sided.pixels[4], 1.0f) << "the ceiling's own light";
}

TEST(PixelReference, is_the_same_in_every_run_and_for_both_engines) {
  const Scene scene = render::box_on_ground();
  const Camera camera = render::camera_on_box(48, 32);
  const Light sun = DirectionalLight{{0.9, -1.0, 0.5}};
  const PixelReference first = reference_of(scene, camera, sun), second = reference_of(scene, camera, sun);
  EXPECT_EQ(first.pixels, second.pixels);
  EXPECT_EQ(first.several, second.several);
  int between = 0;
  for (const float value : first.pixels) between += value > 0.0f && value < 1.0f;
  EXPECT_GT(between, 10);
  const Tracer own(scene, Engine::own);
  const Picture picture = picture_of(own, camera);
  const PixelReference exact =
      pixel_reference(own, camera, surface_points(own, camera, sun, picture.positions, picture.normals), sun);
  int differ = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) differ += exact.pixels[i] != first.pixels[i];
  EXPECT_LE(differ, 3);  // rays that pass an edge within the engine's error
}

}  // namespace
}  // namespace gnomon::trace
