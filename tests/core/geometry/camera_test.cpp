// Do a camera's axes and matrices mean what its numbers say?
#include "gnomon/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kRounding = 1e-12;

void expect_orthonormal(const CameraAxes& a) {
  EXPECT_NEAR(glm::length(a.right), 1.0, kRounding);
  EXPECT_NEAR(glm::length(a.up), 1.0, kRounding);
  EXPECT_LE(glm::length(glm::cross(a.right, a.up) + a.forward), kRounding);
}

TEST(Camera, axes_are_defined_where_up_is_zero_or_along_the_view) {
  for (const glm::dvec3& up : {glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -7), glm::dvec3(0, 0, 3)}) {
    Camera camera;
    camera.up = up;
    expect_orthonormal(camera_axes(camera));
    EXPECT_EQ(camera_axes(camera).forward, glm::dvec3(0, 0, -1));
  }
}

TEST(Camera, axes_do_not_overflow_or_vanish_with_the_length_of_the_directions) {
  for (const double length : {1e-150, 1e150}) {
    Camera camera;
    camera.forward = glm::dvec3(1, -2, 3) * length;
    camera.up = glm::dvec3(0, 1, 0) / length;
    expect_orthonormal(camera_axes(camera));
    EXPECT_LE(glm::length(camera_axes(camera).forward - glm::normalize(glm::dvec3(1, -2, 3))), kRounding);
  }
}

TEST(Camera, a_field_of_view_of_ninety_degrees_sees_as_far_up_as_forward) {
  const Camera c =
      perspective_camera({}, {0, 0, -1}, {0, 1, 0}, std::numbers::pi / 2, 2.0, 0.1, 10, 200, 100);
  EXPECT_NEAR(c.top, 1.0, kRounding);
  EXPECT_NEAR(c.bottom, -1.0, kRounding);
  EXPECT_NEAR(c.right, 2.0, kRounding);
  EXPECT_FALSE(c.orthographic);
  const Camera o = orthographic_camera({}, {0, 0, -1}, {0, 1, 0}, 6.0, 2.0, 0.1, 10, 200, 100);
  EXPECT_EQ(o.top, 3.0);
  EXPECT_EQ(o.left, -6.0);
  EXPECT_TRUE(o.orthographic);
}

TEST(CameraProperty, a_point_at_an_image_position_and_depth_projects_back_onto_both) {
  for_all(500, [&] {
    const Camera c = draw_case({.max_depth_ratio = 1e3}).camera;
    expect_orthonormal(camera_axes(c));
    const double x = between(-1, 1), y = between(-1, 1), t = unit();
    const double depth = c.near_depth + (c.far_depth - c.near_depth) * t;
    const glm::dvec4 clip =
        clip_from_view(c) * view_from_world(c) * glm::dvec4(point_at(c, x, y, depth), 1.0);
    require(clip.w > 0.0, "w", clip.w);
    // Positions a few frustum lengths from the origin, seen through narrow frusta.
    require(std::abs(clip.x / clip.w - x) < 1e-7 && std::abs(clip.y / clip.w - y) < 1e-7, "ndc",
            clip.x / clip.w, clip.y / clip.w, "expected", x, y);
    const double n = c.near_depth, f = c.far_depth;
    const double z = c.orthographic ? 2.0 * t - 1.0 : (f + n) / (f - n) - 2.0 * f * n / ((f - n) * depth);
    require(std::abs(clip.z / clip.w - z) < 1e-7, "ndc depth", clip.z / clip.w, "expected", z);
  });
}

}  // namespace
}  // namespace gnomon::test
