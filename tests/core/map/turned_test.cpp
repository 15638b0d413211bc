// Is the rectangle's turn the one with the least area, against all turns?
#include "map/turned.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/seeded_input.hpp"

namespace gnomon::test {
namespace {

double area(const std::vector<glm::dvec2>& points, const glm::dvec2& side) {
  double low_a = std::numeric_limits<double>::infinity(), high_a = -low_a, low_b = low_a, high_b = -low_a;
  for (const glm::dvec2& p : points) {
    const double a = p.x * side.x + p.y * side.y, b = p.y * side.x - p.x * side.y;
    low_a = std::min(low_a, a);
    high_a = std::max(high_a, a);
    low_b = std::min(low_b, b);
    high_b = std::max(high_b, b);
  }
  return (high_a - low_a) * (high_b - low_b);
}

TEST(LeastRectangle, none_and_single_points_and_lines_along_x_are_not_turned) {
  EXPECT_EQ(least_rectangle_side({}), glm::dvec2(1.0, 0.0));
  const std::vector<glm::dvec2> one = {{3.0, 4.0}}, line = {{0.0, 2.0}, {5.0, 2.0}, {1.0, 2.0}};
  EXPECT_EQ(least_rectangle_side(one), glm::dvec2(1.0, 0.0));
  EXPECT_EQ(least_rectangle_side(line), glm::dvec2(1.0, 0.0));
}

TEST(LeastRectangle, a_turned_square_is_turned_back_whatever_lies_inside_it) {
  const std::vector<glm::dvec2> points = {{0.0, -5.0}, {5.0, 0.0},  {0.0, 5.0},
                                          {-5.0, 0.0}, {1.0, -1.5}, {-0.5, 2.0}};
  const glm::dvec2 side = least_rectangle_side(points);
  EXPECT_NEAR(std::abs(side.x), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(std::abs(side.y), std::sqrt(0.5), 1e-12);
}

TEST(LeastRectangle, no_turn_of_four_thousand_has_less_area) {
  constexpr int kTurns = 4000;
  constexpr double kQuarter = 1.5707963267948966;
  int gained = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SeededNumbers random(seed);
    const double wide = random.power_of_two(-3, 3), turn = random.between(0.0, kQuarter);
    std::vector<glm::dvec2> points;
    for (int count = 3 + random.pick(12); count > 0; --count) {
      const glm::dvec3 v = random.vector();
      points.emplace_back(v.x * wide * std::cos(turn) - v.y * std::sin(turn),
                          v.x * wide * std::sin(turn) + v.y * std::cos(turn));
    }
    const glm::dvec2 side = least_rectangle_side(points);
    EXPECT_NEAR(side.x * side.x + side.y * side.y, 1.0, 1e-12);
    EXPECT_GE(side.x, std::abs(side.y) - 1e-12) << seed;
    const double least = area(points, side);
    for (int i = 0; i < kTurns; ++i) {
      const double angle = kQuarter * i / kTurns;
      ASSERT_GE(area(points, {std::cos(angle), std::sin(angle)}), least * (1.0 - 1e-9)) << seed << ' ' << i;
    }
    gained += least < 0.99 * area(points, {1.0, 0.0}) ? 1 : 0;
  }
  EXPECT_GT(gained, 100);
}

}  // namespace
}  // namespace gnomon::test
