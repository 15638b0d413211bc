// Medians with their confidence, and which of many choices nothing else beats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::report {

/// The middle value; the mean of the two middle ones for an even count; 0 for none.
[[nodiscard]] double median(std::span<const double> values);

/// A median and the interval that holds the true one with 95 % confidence.
struct Estimate {
  double median = 0.0, low = 0.0, high = 0.0;  ///< low <= median <= high
  /// Equal in all members.
  bool operator==(const Estimate&) const = default;
};
/// By the percentile bootstrap (Efron 1979) over 1000 resamples drawn with a fixed seed. One value is its own
/// interval.
[[nodiscard]] Estimate estimate(std::span<const double> values);

/// The geometric mean; values at or below zero count as `floor`, which is above zero. 0 for none.
[[nodiscard]] double geometric_mean(std::span<const double> values, double floor);

/// Spearman's rank correlation of two equally long lists, in [-1,1]; equal values share their ranks. Not a
/// number where one list has fewer than two different values.
[[nodiscard]] double rank_correlation(std::span<const double> a, std::span<const double> b);

/// How two lists compare, pair by pair.
struct SignTest {
  std::size_t less = 0, more = 0;  ///< pairs whose first value is the smaller one, and the larger one
  double chance = 1.0;             ///< that a fair coin is as uneven, on either side; 1 where no pair differs
  /// Equal in all members.
  bool operator==(const SignTest&) const = default;
};
/// The exact sign test. The lists are equally long; equal pairs, and those with a value that is not finite,
/// do not count.
[[nodiscard]] SignTest sign_test(std::span<const double> first, std::span<const double> second);

/// A choice: both are to be made small.
struct Choice {
  double cost = 0.0, error = 0.0;  ///< any units
};
/// Indices of the choices that no other beats, by rising cost. None costs no more and errs no more while
/// being better in one of them. The first of equal choices is taken. Choices with a value that is not finite
/// take no part.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const Choice> choices);

}  // namespace gnomon::report
