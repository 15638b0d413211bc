// Two numbers at once: is each operation the scalar one on both, to the last bit?
#include "lanes/pair.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "lanes/point_pair.hpp"

namespace gnomon::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 10> kNumbers = {0.0,  -0.0,  1.0,       -1.5,       0.1,
                                             1e30, 1e-30, kInfinity, -kInfinity, kNan};

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(Pair, arithmetic_is_that_of_two_numbers) {
  for (const double a : kNumbers) {
    for (const double b : kNumbers) {
      const Pair left(a, b), right(b, 3.0);
      const auto expect = [&](Pair pair, double low, double high) {
        EXPECT_TRUE(same(pair.low(), low)) << a << ' ' << b;
        EXPECT_TRUE(same(pair.high(), high)) << a << ' ' << b;
      };
      expect(left + right, a + b, b + 3.0);
      expect(left - right, a - b, b - 3.0);
      expect(left * right, a * b, b * 3.0);
      expect(left / right, a / b, b / 3.0);
      expect(abs(left), std::abs(a), std::abs(b));
      expect(min_of(left, right), a < b ? a : b, b < 3.0 ? b : 3.0);
      expect(max_of(left, right), a > b ? a : b, b > 3.0 ? b : 3.0);
      expect(lows(left, right), a, b);
      expect(highs(left, right), b, 3.0);
      EXPECT_EQ(below(left, right), (a < b ? 1u : 0u) | (b < 3.0 ? 2u : 0u)) << a << ' ' << b;
      EXPECT_EQ(at_least(left, right), (a >= b ? 1u : 0u) | (b >= 3.0 ? 2u : 0u)) << a << ' ' << b;
    }
    if (a >= 0.0) {
      EXPECT_TRUE(same(sqrt(Pair(4.0, a)).high(), std::sqrt(a))) << a;
    }
  }
}

TEST(Pair, memory_holds_the_low_number_first) {
  const double from[2] = {1.0, 2.0};
  double to[2] = {};
  Pair::from(from).to(to);
  EXPECT_EQ(to[0], 1.0);
  EXPECT_EQ(to[1], 2.0);
}

TEST(Pair, the_last_of_an_odd_number_comes_with_itself) {
  std::vector<WarpInput::Point> points;
  for (const double x : {1.0, 2.0, 3.0}) points.push_back({x, 10.0 + x, 20.0 + x, 30.0 + x});
  std::vector<std::array<double, 8>> found;
  for_each_two<PointPair>(points, [&](std::size_t i, const PointPair& p) {
    EXPECT_EQ(i, 2 * found.size());
    found.push_back(
        {p.x.low(), p.x.high(), p.y.low(), p.y.high(), p.z.low(), p.z.high(), p.depth.low(), p.depth.high()});
  });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], (std::array<double, 8>{1, 2, 11, 12, 21, 22, 31, 32}));
  EXPECT_EQ(found[1], (std::array<double, 8>{3, 3, 13, 13, 23, 23, 33, 33}));
  for_each_two<PointPair>({}, [](std::size_t, const PointPair&) { FAIL(); });
}

TEST(Pair, vertices_have_the_dot_product_of_each) {
  std::vector<Polytope::Vertex> vertices(2);
  vertices[0].position = {0.1, 0.2, 0.3};
  vertices[1].position = {-4.0, 5.0, 6.0};
  const glm::dvec3 direction{0.3, -0.7, 0.2};
  for_each_two<VertexPair>(vertices, [&](std::size_t, const VertexPair& two) {
    const Pair dot = DotPair(direction)(two);
    const auto of = [&](const glm::dvec3& p) {
      return p.x * direction.x + p.y * direction.y + p.z * direction.z;
    };
    EXPECT_EQ(dot.low(), of(vertices[0].position));
    EXPECT_EQ(dot.high(), of(vertices[1].position));
  });
}

}  // namespace
}  // namespace gnomon::test
