// Does the logarithmic perspective map land where its formula says, and spread the error evenly?
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/study/dpds.hpp"
#include "gnomon/study/log_perspective.hpp"
#include "support/golden.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

constexpr double kNear = 1.0, kFar = 100.0;
// Double against double: a logarithm's few units in the last place, and the body's rounding.
constexpr double kFormula = 1e-11;
// Square pixels of a square image: 2 tan(fov / 2) / 512 each per unit of depth.
constexpr int kPixels = 512, kSize = 1024;
constexpr double kFov = 1.0471975511965976;

Camera overhead_camera() {
  return perspective_camera({3, 5, 7}, {0, 0, -1}, {0, 1, 0}, kFov, 1.0, kNear, kFar, kPixels, kPixels);
}
const Box kEverywhere{{-1e4, -1e4, -1e4}, {1e4, 1e4, 1e4}};
SceneBounds everywhere() {
  return {{&kEverywhere, 1}, {&kEverywhere, 1}};
}

LogPerspectiveMap overhead() {
  return log_perspective_map(overhead_camera(), {{0, -1, 0}}, everywhere(), kSize);
}
glm::dvec3 ahead(double depth, double up = 0.0) {
  return {3, 5 + up * depth, 7 - depth};
}

TEST(LogPerspective, broken_input_and_an_empty_view_give_no_map) {
  Camera broken = overhead_camera();
  broken.near_depth = -1.0;
  EXPECT_FALSE(log_perspective_map(broken, {{0, -1, 0}}, everywhere(), kSize).valid);
  EXPECT_FALSE(log_perspective_map(overhead_camera(), {{0, -1, 0}}, everywhere(), 3).valid);
  const Box behind{{0, 0, 50}, {1, 1, 60}};
  const LogPerspectiveMap none =
      log_perspective_map(overhead_camera(), {{0, -1, 0}}, {{&behind, 1}, {&behind, 1}}, kSize);
  EXPECT_FALSE(none.valid);
  EXPECT_EQ(measure(none, overhead_camera(), everywhere()).samples, 0u);
  EXPECT_EQ(measure_perspective(none, overhead_camera(), {0, 0, 0}).status, PointAliasing::Status::outside);
}

TEST(LogPerspective, a_light_along_the_view_and_an_orthographic_camera_leave_the_map_uniform) {
  EXPECT_EQ(log_perspective_map(overhead_camera(), {{0, 0, -1}}, everywhere(), kSize).kappa, 0.0);
  const Camera parallel = orthographic_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 10, 1, 1, 100, 64, 64);
  const LogPerspectiveMap map = log_perspective_map(parallel, {{0, -1, 0}}, everywhere(), kSize);
  ASSERT_TRUE(map.valid);
  EXPECT_EQ(map.kappa, 0.0);
  EXPECT_CLOSE(log_perspective_texel(map, {0, 0, -50.5}).y, 0.5 * kSize, kFormula);
}

TEST(LogPerspective, an_overhead_light_spreads_depths_by_their_logarithm_as_the_golden_rows_say) {
  const LogPerspectiveMap map = overhead();
  ASSERT_TRUE(map.valid);
  EXPECT_CLOSE(map.kappa, 1.0 / kNear, kFormula);
  for (const Json& row : golden("extra").at("logpsm")) {
    const double t = log_perspective_texel(map, ahead(number(row.at("z")))).y / kSize;
    EXPECT_NEAR(t, number(row.at("t_expected")), kFormula);
  }
}

TEST(LogPerspective, overhead_every_depth_has_the_same_error_and_the_storage_is_the_logarithm_of_the_ratio) {
  const LogPerspectiveMap map = overhead();
  const double pixels_per_slope = kPixels / (2.0 * std::tan(0.5 * kFov));
  for (const double depth : {1.0, 2.0, 5.0, 10.0, 33.0, 100.0}) {
    const PointAliasing a = measure_perspective(map, overhead_camera(), ahead(depth));
    ASSERT_EQ(a.status, PointAliasing::Status::ok) << depth;
    // dp/ds with the image plane at distance 1.
    EXPECT_CLOSE(a.m_t * kSize / pixels_per_slope, dpds::logarithmic(depth, kNear, kFar), kFormula);
    EXPECT_CLOSE(a.m_s * kSize / kPixels, 1.0, kFormula);
    EXPECT_CLOSE(a.m_s * a.m_t * kSize * kSize / (pixels_per_slope * kPixels), std::log(kFar / kNear),
                 kFormula);
  }
}

TEST(LogPerspective, the_jacobian_is_the_derivative_of_the_texel) {
  const Camera camera =
      perspective_camera({1, 2, 3}, {0.3, -0.4, -1}, {0, 1, 0}, 1.2, 1.5, 0.5, 80, 300, 200);
  const LogPerspectiveMap map = log_perspective_map(camera, {{0.5, -1, 0.3}}, everywhere(), kSize);
  ASSERT_TRUE(map.valid);
  ASSERT_GT(map.kappa, 0.0);
  // Central differences lose about two thirds of the digits.
  constexpr double kDifference = 1e-6, kStep = 1e-4;
  const glm::dvec3 axis_of[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const CameraAxes axes = camera_axes(camera);
  for (const double depth : {2.0, 10.0, 60.0}) {
    const glm::dvec3 p = camera.position + axes.forward * depth + axes.right * (0.3 * depth);
    const LogPerspectiveJacobian j = log_perspective_jacobian(map, p);
    const double scale = glm::length(j.x) + glm::length(j.y);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 change = (log_perspective_texel(map, p + axis_of[k] * kStep) -
                                 log_perspective_texel(map, p - axis_of[k] * kStep)) /
                                (2.0 * kStep);
      EXPECT_NEAR(change.x, j.x[k], kDifference * scale);
      EXPECT_NEAR(change.y, j.y[k], kDifference * scale);
    }
    // Nothing changes along the light.
    EXPECT_NEAR(glm::dot(j.x, map.light_direction), 0.0, kFormula * scale);
    EXPECT_NEAR(glm::dot(j.y, map.light_direction), 0.0, kFormula * scale);
  }
}

TEST(LogPerspective, measured_over_the_view_it_beats_the_best_drawn_map_overhead) {
  const Box ground{{-50, 0, -90}, {50, 1, 10}};
  const SceneBounds bounds{{&ground, 1}, {&ground, 1}};
  PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = kSize;
  options.filter.texels = 0.0;
  const AliasingStats drawn =
      measure(make_plan(overhead_camera(), DirectionalLight{}, bounds, options), overhead_camera(), bounds);
  const AliasingStats ideal =
      measure(log_perspective_map(overhead_camera(), {}, bounds, kSize), overhead_camera(), bounds);
  EXPECT_EQ(ideal.samples, drawn.samples);
  EXPECT_EQ(ideal.outside, 0u);
  EXPECT_LT(ideal.storage, 0.7 * drawn.storage);
}

}  // namespace
}  // namespace gnomon::test
