// Elementary functions without a branch, for loops that work on several numbers at once: for numbers that are
// known to be in range. Every bit is the same as of every other compiler, as in elementary.hpp.
#pragma once

#include "geometry/elementary.hpp"

namespace gnomon::lane {

/// Adding this leaves a number's whole part in the lowest bits.
inline constexpr double kWhole = 0x1.8p52;

/// ln x, for a normal x above 0.
[[nodiscard]] inline double log(double x) noexcept {
  constexpr double kSqrtHalf = 0.7071067811865476, kTwoTo52 = 0x1p52;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const double half = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3fe0000000000000ULL);
  const double whole = std::bit_cast<double>((bits >> 52) | 0x4330000000000000ULL) - (kTwoTo52 + 1022.0);
  const double mantissa = half < kSqrtHalf ? half + half : half;
  const double exponent = half < kSqrtHalf ? whole - 1.0 : whole;
  const double f = mantissa - 1.0;
  return exponent * elementary::detail::kLn2High +
         (elementary::detail::log_near_one(f / (2.0 + f)) + exponent * elementary::detail::kLn2Low);
}

/// e^x, for -700 <= x <= 700.
[[nodiscard]] inline double exp(double x) noexcept {
  constexpr auto kTerms = elementary::detail::inverse_factorials<15>(0, 1, 1.0);
  const double shifted = x * (1.0 / elementary::detail::kLn2) + kWhole, k = shifted - kWhole;
  const double rest = (x - k * elementary::detail::kLn2High) - k * elementary::detail::kLn2Low;
  // The power of two: the whole part, in the place of the exponent.
  const double power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
  return elementary::detail::horner(kTerms, rest) * power;
}

}  // namespace gnomon::lane
