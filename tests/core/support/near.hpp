// Comparing numbers: relative to their own size.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::test {

/// |a - b| over the larger of both; 0 where both are equal (infinities, too).
[[nodiscard]] inline double deviation(double a, double b) {
  if (a == b) return 0.0;
  return std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}

}  // namespace gnomon::test

/// Relative: |actual - expected| <= tolerance * the larger magnitude.
#define EXPECT_CLOSE(actual, expected, tolerance)                                    \
  EXPECT_LE(::gnomon::test::deviation((actual), (expected)), (tolerance)) << #actual \
      " = " << ::testing::PrintToString(actual) << ", expected " << ::testing::PrintToString(expected)
