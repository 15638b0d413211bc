// Is the traced shadow of a picture the one that can be worked out by hand?
#include "gnomon/trace/seen_shadow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/test_scene.hpp"

namespace gnomon::trace {
namespace {

using render::add_mesh;
using render::empty_scene;

/// 200 x 200 at height 0, and a roof of 4 x 2 at height 3 over x in [-2, 2], z in [-1, 1].
Scene roofed() {
  Scene scene = empty_scene();
  add_mesh(scene,
           {{-100, 0, 100}, {100, 0, 100}, {100, 0, -100}, {-100, 0, 100}, {100, 0, -100}, {-100, 0, -100}});
  add_mesh(scene, {{-2, 3, 1}, {2, 3, 1}, {2, 3, -1}, {-2, 3, 1}, {2, 3, -1}, {-2, 3, -1}});
  return scene;
}

constexpr int kWidth = 40, kHeight = 20;

TEST(SeenShadow, of_a_roof_lies_where_the_light_puts_it) {
  // From below the roof straight down: ten by five units, a quarter of one for each pixel.
  const Camera down =
      orthographic_camera({0, 2, 0}, {0, -1, 0}, {0, 0, -1}, 5.0, 2.0, 0.1, 50, kWidth, kHeight);
  const SeenShadow seen = seen_shadow(Tracer(roofed()), down, DirectionalLight{{1, -1, 0}});
  ASSERT_EQ(seen.mask.size(), static_cast<std::size_t>(kWidth * kHeight));
  int dark = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const double x = (i % kWidth + 0.5) * 0.25 - 5.0, z = (i / kWidth + 0.5) * 0.25 - 2.5;
    const bool in_shadow = x > 1.0 && x < 5.0 && std::abs(z) < 1.0;
    const auto pixel = static_cast<std::size_t>(i);
    EXPECT_EQ(seen.mask[pixel], in_shadow ? 0.0f : 1.0f) << x << ' ' << z;
    EXPECT_FLOAT_EQ(seen.view_depths[pixel], 2.0f);
    dark += in_shadow ? 1 : 0;
  }
  EXPECT_EQ(dark, 16 * 8);
  EXPECT_EQ(seen.picture().mask.data(), seen.mask.data());
  EXPECT_EQ(seen.picture().camera.width, kWidth);
}

/// What the search of a picture finds at a point.
double distance(const SeenShadow& seen, const glm::dvec3& point) {
  const OccluderSearch search = seen.picture().occluders;
  return search.distance(search.scene, point);
}

TEST(SeenShadow, finds_the_occluder_nearest_the_light) {
  Scene scene = roofed();
  // A second roof over the middle of the first, and a third beyond the near light.
  add_mesh(scene, {{-1, 5, 2}, {1, 5, 2}, {1, 5, -2}, {-1, 5, 2}, {1, 5, -2}, {-1, 5, -2}});
  add_mesh(scene, {{-9, 20, 9}, {9, 20, 9}, {9, 20, -9}, {-9, 20, 9}, {9, 20, -9}, {-9, 20, -9}});
  const Camera down =
      orthographic_camera({0, 2, 0}, {0, -1, 0}, {0, 0, -1}, 5.0, 2.0, 0.1, 50, kWidth, kHeight);
  const Tracer tracer(scene);
  const SeenShadow sun = seen_shadow(tracer, down, DirectionalLight{{0, -1, 0}});
  const SeenShadow near_light = seen_shadow(tracer, down, PointLight{{0, 12, 0}, 100.0});
  int by_low = 0, by_high = 0, lit = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const double x = (i % kWidth + 0.5) * 0.25 - 5.0, z = (i / kWidth + 0.5) * 0.25 - 2.5;
    const glm::dvec3 ground(x, 0.0, z);
    // The sun meets the highest roof first, which is over all that is seen.
    EXPECT_NEAR(distance(sun, ground), 20.0, 1e-9);
    // Of the way from the light down to the ground.
    const double way = std::sqrt(x * x + z * z + 144.0);
    const bool high = std::abs(x) < 12.0 / 7.0 && std::abs(z) < 24.0 / 7.0,
               low = std::abs(x) < 8.0 / 3.0 && std::abs(z) < 4.0 / 3.0;
    EXPECT_NEAR(distance(near_light, ground),
                high  ? way * 5.0 / 12.0
                : low ? way * 3.0 / 12.0
                      : 0.0,
                1e-9)
        << x << ' ' << z;
    (high ? by_high : low ? by_low : lit) += 1;
  }
  EXPECT_GT(by_high, 100);
  EXPECT_GT(by_low, 50);
  EXPECT_GT(lit, 100);
}

TEST(SeenShadow, searches_between_any_point_and_the_light) {
  const Camera down =
      orthographic_camera({0, 2, 0}, {0, -1, 0}, {0, 0, -1}, 5.0, 2.0, 0.1, 50, kWidth, kHeight);
  const Tracer tracer(roofed());
  const SeenShadow sun = seen_shadow(tracer, down, DirectionalLight{{0, -2, 0}});
  EXPECT_NEAR(distance(sun, {1.5, 1.0, 0.5}), 2.0, 1e-9);   // under the roof
  EXPECT_NEAR(distance(sun, {1.5, 4.0, 0.5}), -1.0, 1e-9);  // over it
  EXPECT_NEAR(distance(sun, {2.5, 0.25, 0.5}), -0.25, 1e-9);
  EXPECT_EQ(distance(sun, {500.0, 1.0, 0.5}), -std::numeric_limits<double>::infinity());
  const SeenShadow lamp = seen_shadow(tracer, down, PointLight{{0, 6, 0}, 100.0});
  EXPECT_NEAR(distance(lamp, {3.0, 0.0, 0.0}), 0.5 * std::sqrt(45.0), 1e-9);
  EXPECT_NEAR(distance(lamp, {0.0, 5.0, 0.0}), -2.0, 1e-9);
  ASSERT_EQ(sun.normals_world.size(), sun.mask.size());
  for (const glm::vec3& normal : sun.picture().normals_world) EXPECT_EQ(normal, glm::vec3(0, 1, 0));
  EXPECT_EQ(SeenShadow{}.picture().occluders.distance, nullptr);
}

TEST(SeenShadow, is_the_same_of_points_that_were_found) {
  const Camera down = orthographic_camera({0, 2, 0}, {0, -1, 0}, {0, 0, -1}, 5.0, 2.0, 0.1, 50, 2, 1);
  const Tracer tracer(roofed());
  const DirectionalLight sun{{0, -1, 0}};
  SurfacePoints points{2, 1, {{}, {}}};
  points.pixels[1].state = PixelState::facing;
  points.pixels[1].position = {2.5, 0, 0};
  points.pixels[1].normal = {0, 1, 0};
  const SeenShadow found = seen_shadow(tracer, down, sun, points, {-1.0f, 1.0f}),
                   traced = seen_shadow(tracer, down, sun);
  EXPECT_EQ(found.mask, (std::vector<float>{-1.0f, 1.0f}));
  EXPECT_EQ(found.view_depths, (std::vector<float>{0.0f, 2.0f}));
  EXPECT_EQ(found.view_depths[1], traced.view_depths[1]);
  EXPECT_EQ(found.normals_world[1], traced.normals_world[1]);
  EXPECT_NEAR(distance(found, {1.5, 1.0, 0.5}), 2.0, 1e-9);
  EXPECT_TRUE(found.picture().is_whole());
}

TEST(SeenShadow, sky_has_no_depth_and_what_the_light_does_not_reach_does_not_count) {
  const Camera level =
      perspective_camera({0, 2, 90}, {0, 0, -1}, {0, 1, 0}, 1.0, 2.0, 0.1, 1000, kWidth, kHeight);
  const SeenShadow from_below = seen_shadow(Tracer(roofed()), level, DirectionalLight{{0, 1, 0.1}});
  const SeenShadow near_light = seen_shadow(Tracer(roofed()), level, PointLight{{0, 5, 80}, 6.0});
  int sky = 0, ground = 0, reached = 0;
  for (std::size_t i = 0; i < from_below.mask.size(); ++i) {
    EXPECT_EQ(from_below.mask[i], -1.0f);
    EXPECT_EQ(from_below.view_depths[i], near_light.view_depths[i]);
    (from_below.view_depths[i] > 0.0f ? ground : sky) += 1;
    reached += near_light.mask[i] > 0.0f ? 1 : 0;
  }
  EXPECT_GT(sky, 300);
  EXPECT_GT(ground, 300);
  EXPECT_GT(reached, 0);
  EXPECT_LT(reached, ground);
  Camera none = level;
  none.width = 0;
  EXPECT_TRUE(seen_shadow(Tracer(roofed()), none, DirectionalLight{{0, -1, 0}}).mask.empty());
}

}  // namespace
}  // namespace gnomon::trace
