// What loops over several numbers at once are made of: does each part give what one number at a time would?
#include "lanes/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "lanes/elementary.hpp"

namespace gnomon::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Lanes, lists_are_filled_up_to_whole_vectors) {
  EXPECT_EQ(whole_lanes(0), 0u);
  EXPECT_EQ(whole_lanes(1), kDoubleLanes);
  EXPECT_EQ(whole_lanes(kDoubleLanes), kDoubleLanes);
  EXPECT_EQ(whole_lanes(kDoubleLanes + 1), 2 * kDoubleLanes);
}

TEST(Lanes, a_divisor_is_the_larger_of_both_to_the_last_bit_and_never_zero) {
  for (const double x : {1e-3, 1.0, 7.0, 1e30}) {
    EXPECT_EQ(divisor(x, 1e-6), x);
    EXPECT_EQ(divisor(0.0, x), x);
  }
  EXPECT_GT(divisor(0.0, 1e-300), 0.0);
  EXPECT_EQ(divisor(2.0F, 1e-6F), 2.0F);
}

TEST(Lanes, the_inverse_of_zero_is_zero) {
  EXPECT_EQ(inverse_or_0(0.0), 0.0);
  EXPECT_EQ(inverse_or_0(4.0), 0.25);
  EXPECT_EQ(inverse_or_0(-0.5), -2.0);
}

TEST(Lanes, the_range_is_that_of_the_sorted_list) {
  std::mt19937_64 engine(3);
  for (const std::size_t count : {kDoubleLanes, 2 * kDoubleLanes, 9 * kDoubleLanes}) {
    for (int round = 0; round < 50; ++round) {
      std::vector<double> numbers(count);
      for (double& v : numbers) v = std::ldexp(static_cast<double>(engine() >> 11), -53) - 0.5;
      const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
      const LaneRange range = lane_range(numbers.data(), count, kDoubleLanes);
      EXPECT_EQ(range.low, *low);
      EXPECT_EQ(range.high, *high);
    }
  }
}

TEST(Lanes, the_first_lane_within_rounding_of_the_least_is_taken) {
  constexpr float kSame = 1.0F - 1e-5F;
  FloatLanes values{};
  for (std::size_t least = 0; least < values.size(); ++least) {
    for (std::size_t l = 0; l < values.size(); ++l) values[l] = l == least ? 1.0F : 2.0F;
    EXPECT_EQ(first_of_least_lane(values, kSame), least);
    values[least / 2] = 1.0F + 5e-6F;
    EXPECT_EQ(first_of_least_lane(values, kSame), least / 2);
  }
}

TEST(Lanes, without_a_branch_the_logarithm_has_the_same_bits) {
  std::mt19937_64 engine(5);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::ldexp(1.0 + std::ldexp(static_cast<double>(engine() >> 12), -52),
                                static_cast<int>(engine() % 600) - 300);
    ASSERT_EQ(lane::log(x), elementary::log(x)) << x;
  }
}

TEST(Lanes, without_a_branch_the_exponential_is_as_near) {
  // Both round once in the last step: two units in the last place apart at most.
  constexpr double kTwoUnits = 2.0 * std::numeric_limits<double>::epsilon();
  std::mt19937_64 engine(7);
  for (int i = 0; i < 20000; ++i) {
    const double x = (std::ldexp(static_cast<double>(engine() >> 11), -53) - 0.5) * 1390.0;
    const double value = elementary::exp(x);
    ASSERT_LE(std::abs(lane::exp(x) - value), kTwoUnits * value) << x;
  }
  EXPECT_EQ(lane::exp(0.0), 1.0);
  EXPECT_LT(lane::exp(700.0), kInfinity);
}

}  // namespace
}  // namespace gnomon::test
