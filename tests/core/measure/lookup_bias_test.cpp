// Is the length of a look-up's bias the one that can be worked out by hand?
#include "measure/lookup_bias.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon::test {
namespace {

constexpr double kRounding = 1e-12;
const glm::dvec3 kDown{0, -1, 0};
const BiasOptions kEach{0.01, 1.0, 100.0, 8.0};

/// A map of two units by two over 4 x 4 texels from above: texels of half a unit. `growth`: of w along z.
TexelJacobian overhead(double growth, const glm::dvec3& point) {
  glm::dmat4 m(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, -1, 0, growth),
               glm::dvec4(0, 0, 0, 1));
  TexelGrid grid;
  grid.width = grid.height = 4;
  return texel_jacobian(m, grid, point);
}

double bias(const glm::dvec3& normal, const BiasOptions& options = kEach) {
  return lookup_bias_world(options, overhead(0.0, glm::dvec3(0.0)), glm::normalize(normal), kDown);
}

TEST(LookupBias, adds_the_constant_the_slope_and_the_lift_of_the_offset) {
  EXPECT_NEAR(bias({0, 1, 0}), 0.01 * 0.5, kRounding);
  // Rises by a texel's side over a texel along x: half a unit.
  EXPECT_NEAR(bias({1, 1, 0}), 0.005 + 0.5 + 50.0, kRounding);
  // By two sides along y.
  EXPECT_NEAR(bias({0, 1, -2}), 0.005 + 1.0 + 100.0, 1e-10);
  // By one along x and two along y; steep by the root of five.
  EXPECT_NEAR(bias({-1, 1, 2}), 0.005 + 1.5 + 50.0 * std::sqrt(5.0), 1e-10);
}

TEST(LookupBias, caps_the_slope_alone) {
  BiasOptions capped = kEach;
  capped.max_slope = 1.0;
  EXPECT_NEAR(bias({1, 1, 0}, capped), bias({1, 1, 0}), kRounding);
  EXPECT_NEAR(bias({0, 1, -2}, capped), 0.005 + 0.5 + 100.0, 1e-10);
  capped.max_slope = 1e9;
  capped.normal_offset_texels = 0.0;
  EXPECT_NEAR(bias({0, 1e-4, 1}, capped), 0.005 + 0.5 * kSteepestPlane, 1e-6);
}

TEST(LookupBias, is_nothing_edge_on_turned_away_and_where_the_map_is_singular) {
  EXPECT_EQ(bias({1, 0, 0}), 0.0);
  EXPECT_EQ(bias({1, 1e-9, 0}), 0.0);
  EXPECT_EQ(bias({0, -1, 0}), 0.0);
  TexelJacobian flat = overhead(0.0, glm::dvec3(0.0));
  flat.y = 2.0 * flat.x;
  EXPECT_EQ(lookup_bias_world(kEach, flat, {0, 1, 0}, kDown), 0.0);
}

TEST(LookupBias, goes_by_ways_across_the_light_under_a_warp_and_a_slanting_sun) {
  const glm::dvec3 point{0.3, 0.1, 0.2}, light = glm::normalize(glm::dvec3(0.4, -1.0, 0.3)),
                                         normal = glm::normalize(glm::dvec3(-0.2, 1.0, 0.5));
  const TexelJacobian texel = overhead(0.6, point);
  // Two ways across the light that move by one texel along x and along y, each by Cramer's rule.
  const glm::dvec3 a = glm::normalize(glm::cross(light, {1, 0, 0})), b = glm::cross(light, a);
  const glm::dmat2 moved(glm::dot(texel.x, a), glm::dot(texel.y, a), glm::dot(texel.x, b),
                         glm::dot(texel.y, b));
  const glm::dmat2 ways = glm::inverse(moved);
  double rise = 0.0, longest = 0.0;
  for (int i = 0; i < 2; ++i) {
    const glm::dvec3 way = a * ways[i].x + b * ways[i].y;
    // Up the light to the plane.
    rise += std::abs(glm::dot(way, normal) / glm::dot(light, normal));
    longest = std::max(longest, glm::length(way));
  }
  const double cosine = -glm::dot(light, normal), tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
  const BiasOptions options;
  ASSERT_LT(tangent, options.max_slope);
  EXPECT_NEAR(lookup_bias_world(options, texel, normal, light),
              options.slope_texels * rise +
                  longest * (options.constant_texels + options.normal_offset_texels * tangent),
              1e-12);
}

}  // namespace
}  // namespace gnomon::test
