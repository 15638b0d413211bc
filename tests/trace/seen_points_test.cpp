// Are the points that rays find those that the camera sees and the light can reach?
#include "gnomon/trace/seen_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/test_scene.hpp"

namespace gnomon::trace {
namespace {

using render::add_mesh;
using render::empty_scene;

/// 200 x 200 at height 0, turned upwards.
Scene ground() {
  Scene scene = empty_scene();
  add_mesh(scene,
           {{-100, 0, 100}, {100, 0, 100}, {100, 0, -100}, {-100, 0, 100}, {100, 0, -100}, {-100, 0, -100}});
  return scene;
}

const Light kSun = DirectionalLight{{0.2, -1, 0.1}};

TEST(SeenPoints, lie_where_the_rays_of_the_pixels_meet_the_ground) {
  const Camera down = perspective_camera({3, 10, 5}, {0, -1, 0}, {0, 0, -1}, 1.0, 1.0, 0.1, 100, 400, 400);
  const std::vector<glm::dvec3> seen = seen_points(Tracer(ground()), down, kSun, 4, 2);
  ASSERT_EQ(seen.size(), 8u);
  const double half = 10.0 * std::tan(0.5);
  for (std::size_t i = 0; i < 8; ++i) {
    const double x = (static_cast<double>(i % 4) + 0.5) / 4.0 * 2.0 - 1.0, y = i < 4 ? 0.5 : -0.5;
    EXPECT_NEAR(seen[i].x, 3.0 + half * x, 1e-9);
    EXPECT_NEAR(seen[i].y, 0.0, 1e-9);
    EXPECT_NEAR(seen[i].z, 5.0 - half * y, 1e-9);
  }
}

TEST(SeenPoints, orthographic_rays_are_parallel) {
  const Camera down = orthographic_camera({3, 10, 5}, {0, -1, 0}, {0, 0, -1}, 8, 1, 0.1, 100, 400, 400);
  const std::vector<glm::dvec3> seen = seen_points(Tracer(ground()), down, kSun, 2, 1);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_NEAR(seen[0].x, 3.0 - 2.0, 1e-9);
  EXPECT_NEAR(seen[1].x, 3.0 + 2.0, 1e-9);
  EXPECT_NEAR(seen[0].z, 5.0, 1e-9);
}

TEST(SeenPoints, sky_and_what_lies_beyond_the_cameras_depths_are_not_seen) {
  // Level: the upper half is sky.
  Camera level = perspective_camera({0, 2, 90}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.0, 0.1, 1000, 400, 400);
  const Tracer tracer(ground());
  const std::vector<glm::dvec3> all = seen_points(tracer, level, kSun, 16, 16);
  EXPECT_GT(all.size(), 64u);
  EXPECT_LE(all.size(), 128u);
  level.far_depth = 10;
  const std::vector<glm::dvec3> near_ones = seen_points(tracer, level, kSun, 16, 16);
  EXPECT_LT(near_ones.size(), all.size());
  for (const glm::dvec3& point : near_ones) EXPECT_GE(point.z, 80.0);
}

TEST(SeenPoints, points_that_the_light_cannot_reach_are_omitted) {
  const Camera down = perspective_camera({0, 10, 0}, {0, -1, 0}, {0, 0, -1}, 1.0, 1.0, 0.1, 100, 400, 400);
  const Tracer tracer(ground());
  EXPECT_TRUE(seen_points(tracer, down, DirectionalLight{{0, 1, 0}}, 8, 8).empty()) << "from below";
  EXPECT_TRUE(seen_points(tracer, down, PointLight{{0, 5, 0}, 4}, 8, 8).empty()) << "out of range";
  const std::vector<glm::dvec3> lit = seen_points(tracer, down, PointLight{{0, 3, 0}, 4}, 8, 8);
  EXPECT_FALSE(lit.empty());
  EXPECT_LT(lit.size(), 64u);
}

TEST(SeenPoints, no_pixels_and_no_scene_give_none) {
  const Camera down = perspective_camera({0, 10, 0}, {0, -1, 0}, {0, 0, -1}, 1.0, 1.0, 0.1, 100, 400, 400);
  EXPECT_TRUE(seen_points(Tracer(ground()), down, kSun, 0, 5).empty());
  EXPECT_TRUE(seen_points(Tracer(ground()), down, kSun, -3, -5).empty());
  EXPECT_TRUE(seen_points(Tracer(empty_scene()), down, kSun, 4, 4).empty());
}

}  // namespace
}  // namespace gnomon::trace
