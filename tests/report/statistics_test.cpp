// Medians, intervals and fronts of numbers that fit on one line.
#include "gnomon/report/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gnomon::report {
namespace {

TEST(Statistics, of_nothing_and_of_one_value) {
  EXPECT_EQ(median({}), 0.0);
  EXPECT_EQ(estimate({}), Estimate{});
  const std::vector<double> one{3.0};
  EXPECT_EQ(estimate(one), (Estimate{3.0, 3.0, 3.0}));
  EXPECT_EQ(geometric_mean({}, 1.0), 0.0);
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Statistics, median_of_odd_and_even_counts) {
  EXPECT_EQ(median(std::vector<double>{5, 1, 3}), 3.0);
  EXPECT_EQ(median(std::vector<double>{5, 1, 3, 100}), 4.0);
}

TEST(Statistics, the_interval_holds_the_true_median_about_as_often_as_it_says) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(10.0, 2.0);
  int held = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values(25);
    for (double& value : values) value = normal(random);
    const Estimate e = estimate(values);
    EXPECT_LE(e.low, e.median);
    EXPECT_GE(e.high, e.median);
    held += e.low <= 10.0 && 10.0 <= e.high;
  }
  // 95 % with a standard deviation of 1.3 % over 300 trials, and the bootstrap of a median is no exact one.
  EXPECT_GE(held, kTrials * 89 / 100);
  EXPECT_LE(held, kTrials * 99 / 100);
}

TEST(Statistics, estimates_are_the_same_in_every_run) {
  const std::vector<double> values{4, 8, 15, 16, 23, 42};
  EXPECT_EQ(estimate(values), estimate(values));
  EXPECT_LT(estimate(values).low, estimate(values).high);
}

TEST(Statistics, a_sign_test_is_that_of_a_fair_coin) {
  EXPECT_EQ(sign_test({}, {}), (SignTest{0, 0, 1.0}));
  const std::vector<double> low{1, 2, 3, 4, 5, 7}, high{2, 3, 4, 5, 6, 7};
  const SignTest five = sign_test(low, high);
  EXPECT_EQ(five.less, 5u);
  EXPECT_EQ(five.more, 0u);
  EXPECT_NEAR(five.chance, 2.0 / 32.0, 1e-12);
  EXPECT_NEAR(sign_test(high, low).chance, 2.0 / 32.0, 1e-12);
  // One of five: 2 (1 + 5) / 32.
  const std::vector<double> mixed{3, 2, 3, 4, 5, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_NEAR(sign_test(mixed, high).chance, 12.0 / 32.0, 1e-12);
  EXPECT_EQ(sign_test(low, low).chance, 1.0);
}

TEST(Statistics, geometric_mean_by_hand) {
  EXPECT_DOUBLE_EQ(geometric_mean(std::vector<double>{2, 8}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(geometric_mean(std::vector<double>{0, 4}, 0.25), 1.0);
}

TEST(Statistics, rank_correlation_goes_by_the_order_alone) {
  const std::vector<double> values{1, 2, 3, 4}, squares{1, 4, 9, 16}, falling{9, 7, 5, 1};
  EXPECT_DOUBLE_EQ(rank_correlation(values, squares), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(values, falling), -1.0);
  // Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4.
  EXPECT_NEAR(rank_correlation(values, std::vector<double>{0, 6, 6, 8}), 4.5 / std::sqrt(5.0 * 4.5), 1e-12);
  EXPECT_TRUE(std::isnan(rank_correlation(values, std::vector<double>{3, 3, 3, 3})));
  EXPECT_TRUE(std::isnan(rank_correlation({}, {})));
}

TEST(Statistics, the_front_is_what_nothing_beats) {
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<Choice> choices{{3, 1}, {1, 5}, {2, 5}, {2, 3}, {2, 3}, {4, 1}, {0.5, infinite}, {1, 6}};
  EXPECT_EQ(pareto_front(choices), (std::vector<std::size_t>{1, 3, 0}));
}

TEST(Statistics, no_choice_beats_one_of_the_front) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> small(0, 9);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Choice> choices(12);
    for (Choice& choice : choices) choice = {1.0 * small(random), 1.0 * small(random)};
    const std::vector<std::size_t> front = pareto_front(choices);
    ASSERT_FALSE(front.empty());
    for (const std::size_t i : front) {
      for (const Choice& other : choices) {
        const bool beats = other.cost <= choices[i].cost && other.error <= choices[i].error &&
                           (other.cost < choices[i].cost || other.error < choices[i].error);
        EXPECT_FALSE(beats);
      }
    }
  }
}

TEST(Statistics, the_interval_sees_every_value) {
  // A quarter of the samples of two values hold the first alone, and a quarter the last.
  const Estimate e = estimate(std::vector<double>{0.0, 1.0});
  EXPECT_EQ(e.low, 0.0);
  EXPECT_EQ(e.high, 1.0);
}

}  // namespace
}  // namespace gnomon::report
