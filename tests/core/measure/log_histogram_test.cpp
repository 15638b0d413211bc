// Percentiles from counts: the same as from all bins, wherever the numbers lie.
#include "measure/log_histogram.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr std::array<double, 2> kShares = {0.5, 0.95};
using Histogram = LogHistogram<10, 8>;  // half an octave

/// By a count of every bin.
double reference(const std::vector<double>& values, double share) {
  std::map<std::int64_t, std::uint64_t> bins;
  double largest = 0.0;
  constexpr double kLowest = 0x1p-40, kHighest = 0x1p40;
  constexpr int kPerOctave = 1024;
  for (const double v : values) {
    largest = std::max(largest, v);
    const double inside = v >= kLowest ? std::min(v, std::nextafter(kHighest, 0.0)) : kLowest;
    const int exponent = std::ilogb(inside);
    const double part = std::ldexp(inside, -exponent) - 1.0;
    ++bins[std::int64_t{exponent} * kPerOctave + static_cast<std::int64_t>(part * kPerOctave)];
  }
  double seen = 0.0;
  for (const auto& [bin, count] : bins) {
    seen += static_cast<double>(count);
    if (seen < share * static_cast<double>(values.size())) continue;
    const std::int64_t exponent = bin >= 0 ? bin / kPerOctave : -((kPerOctave - 1 - bin) / kPerOctave);
    const double part = (static_cast<double>(bin - exponent * kPerOctave) + 0.5) / kPerOctave;
    return std::min(std::ldexp(1.0 + part, static_cast<int>(exponent)), largest);
  }
  return largest;
}

/// Whether the numbers had to be counted twice.
bool check(const std::vector<double>& values) {
  Histogram histogram;
  for (const double v : values) histogram.add(v);
  const bool again = !histogram.knows(kShares);
  if (again) {
    histogram.count_again(kShares);
    for (const double v : values) histogram.add(v);
    EXPECT_TRUE(histogram.knows(kShares));
  }
  EXPECT_EQ(histogram.count(), values.size());
  for (const double share : kShares)
    EXPECT_EQ(histogram.percentile(share), reference(values, share)) << share << " of " << values.size();
  return again;
}

TEST(LogHistogram, holds_no_number_and_numbers_beyond_its_range) {
  EXPECT_TRUE(Histogram().knows(kShares));
  EXPECT_EQ(Histogram().percentile(0.5), 0.0);
  EXPECT_FALSE(check({1.0}));
  EXPECT_FALSE(check({0.0, -1.0, 1e-300, 1e-20}));
  EXPECT_FALSE(check({1e300, 2e300, 1e13, std::numeric_limits<double>::infinity()}));
}

TEST(LogHistogram, percentiles_are_those_of_all_bins_whatever_came_first) {
  Random random(7);
  int once = 0, twice = 0;
  for (int round = 0; round < 400; ++round) {
    const double octaves = std::exp2(random.between(-3.0, 6.5)), middle = random.between(-3.0, 3.0);
    std::vector<double> values;
    const int count = 1 + random.pick(3000);
    for (int i = 0; i < count; ++i)
      values.push_back(std::exp2(middle + octaves * (random.unit() + random.unit() - 1.0)));
    ++(check(values) ? twice : once);
  }
  EXPECT_GT(once, 50);
  EXPECT_GT(twice, 50);
}

TEST(LogHistogram, a_bin_holds_more_than_its_counter) {
  std::vector<double> values(70000, 1.0);
  values.insert(values.end(), 200000, 1.001);
  values.insert(values.end(), 65536, 1.3);
  EXPECT_FALSE(check(values));
  // Here the same in groups that came too late for bins of their own.
  std::vector<double> late;
  for (int i = 0; i < 16; ++i) late.push_back(std::exp2(-20.0 + i));
  late.insert(late.end(), values.begin(), values.end());
  EXPECT_TRUE(check(late));
}

}  // namespace
}  // namespace gnomon::test
