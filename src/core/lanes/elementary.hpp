// Elementary functions whose every bit is ours: the same for all compilers, processors and C libraries, so
// that equal input gives equal plans everywhere. A few units in the last place from the true value.
//
// A C library may pick other code for its exp on another processor, and a search that compares two values
// goes another way over one last bit. These use +, -, *, /, floor and bit patterns only, which IEEE 754
// fixes.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::elementary {
namespace detail {

inline constexpr double kLn2 = 0.6931471805599453;
// The leading 33 bits of ln 2 and the rest: k times the first is exact for |k| < 2^20.
inline constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;
// Pi / 2 in three parts of 33 bits each.
inline constexpr double kHalfPi1 = 1.57079632673412561417e+00, kHalfPi2 = 6.07710050630396597660e-11,
                        kHalfPi3 = 2.02226624879595063154e-21;
inline constexpr double kTwoOverPi = 0.63661977236758134308;

/// coefficient[0] + x (coefficient[1] + x (...)).
template <std::size_t N>
[[nodiscard]] constexpr double horner(const std::array<double, N>& coefficient, double x) noexcept {
  double sum = coefficient[N - 1];
  for (std::size_t i = N - 1; i > 0; --i) sum = sum * x + coefficient[i - 1];
  return sum;
}
/// 1 / first!, 1 / (first + step)!, ... with alternating signs where `sign` is -1.
template <std::size_t N>
[[nodiscard]] constexpr std::array<double, N> inverse_factorials(int first, int step, double sign) noexcept {
  std::array<double, N> c{};
  double factorial = 1.0, s = 1.0;
  int n = 1;
  for (; n <= first; ++n) factorial *= n;
  for (std::size_t i = 0; i < N; ++i) {
    c[i] = s / factorial;
    s *= sign;
    for (int k = 0; k < step; ++k) factorial *= n++;
  }
  return c;
}
/// 1, sign / 3, 1 / 5, sign / 7 ...: of atanh (sign 1) and atan (sign -1) in x^2.
template <std::size_t N>
[[nodiscard]] constexpr std::array<double, N> inverse_odds(double sign) noexcept {
  std::array<double, N> c{};
  double s = 1.0;
  for (std::size_t i = 0; i < N; ++i) {
    c[i] = s / static_cast<double>(2 * i + 1);
    s *= sign;
  }
  return c;
}

/// x 2^k, for a normal result.
[[nodiscard]] inline double scaled(double x, int k) noexcept {
  // Two steps, so that each power of two is a normal number.
  const int half = k / 2;
  const auto power = [](int e) { return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52); };
  return x * power(half) * power(k - half);
}

/// ln of 1 + f, f = 2 s / (1 - s), |s| <= 0.18.
[[nodiscard]] inline double log_near_one(double s) noexcept {
  static constexpr auto kTerms = inverse_odds<13>(1.0);
  return 2.0 * s * horner(kTerms, s * s);
}

struct Quadrant {
  double rest;
  int number;  // 0..3
};
[[nodiscard]] inline Quadrant quadrant(double x) noexcept {
  // Beyond this the parts of pi / 2 no longer hold; no angle of a plan comes near.
  constexpr double kLargest = 1e6, kTwoPi = 6.283185307179586;
  if (!(x > -kLargest && x < kLargest)) x = std::fmod(x, kTwoPi);
  const double k = std::floor(x * kTwoOverPi + 0.5);
  const double rest = ((x - k * kHalfPi1) - k * kHalfPi2) - k * kHalfPi3;
  return {rest, static_cast<int>(static_cast<std::int64_t>(k) & 3)};
}
[[nodiscard]] inline double sin_near_zero(double x) noexcept {
  static constexpr auto kTerms = inverse_factorials<10>(1, 2, -1.0);
  return x * horner(kTerms, x * x);
}
[[nodiscard]] inline double cos_near_zero(double x) noexcept {
  static constexpr auto kTerms = inverse_factorials<10>(0, 2, -1.0);
  return horner(kTerms, x * x);
}

}  // namespace detail

/// 0 below -708, infinite above 709.7: no subnormal results.
[[nodiscard]] inline double exp(double x) noexcept {
  static constexpr auto kTerms = detail::inverse_factorials<15>(0, 1, 1.0);
  if (x != x) return x;
  if (x > 709.782712893384) return std::numeric_limits<double>::infinity();
  if (x < -708.0) return 0.0;
  const double k = std::floor(x * (1.0 / detail::kLn2) + 0.5);
  const double rest = (x - k * detail::kLn2High) - k * detail::kLn2Low;
  return detail::scaled(detail::horner(kTerms, rest), static_cast<int>(k));
}

[[nodiscard]] inline double expm1(double x) noexcept {
  static constexpr auto kTerms = detail::inverse_factorials<16>(1, 1, 1.0);
  constexpr double kSeries = 0.5;
  return x > -kSeries && x < kSeries ? x * detail::horner(kTerms, x) : exp(x) - 1.0;
}

/// -infinity at 0, NaN below it.
[[nodiscard]] inline double log(double x) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kSqrtHalf = 0.7071067811865476;
  if (!(x > 0.0)) return x == 0.0 ? -kInfinity : std::numeric_limits<double>::quiet_NaN();
  if (x == kInfinity) return x;
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1022;
  double mantissa =
      std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3fe0000000000000ULL);  // [0.5, 1)
  if (mantissa < kSqrtHalf) {
    mantissa *= 2.0;
    --exponent;
  }
  const double f = mantissa - 1.0;
  return exponent * detail::kLn2High + (detail::log_near_one(f / (2.0 + f)) + exponent * detail::kLn2Low);
}

[[nodiscard]] inline double log1p(double x) noexcept {
  constexpr double kSeries = 0.3;
  return x > -kSeries && x < kSeries ? detail::log_near_one(x / (2.0 + x)) : log(1.0 + x);
}

/// x^y for x > 0: as exact as exp(y ln x), which loses log2 |y ln x| bits.
[[nodiscard]] inline double pow(double x, double y) noexcept {
  return exp(y * log(x));
}

[[nodiscard]] inline double sin(double x) noexcept {
  const detail::Quadrant q = detail::quadrant(x);
  const double value = (q.number & 1) != 0 ? detail::cos_near_zero(q.rest) : detail::sin_near_zero(q.rest);
  return (q.number & 2) != 0 ? -value : value;
}
[[nodiscard]] inline double cos(double x) noexcept {
  const detail::Quadrant q = detail::quadrant(x);
  const double value = (q.number & 1) != 0 ? detail::sin_near_zero(q.rest) : detail::cos_near_zero(q.rest);
  return q.number == 1 || q.number == 2 ? -value : value;
}
[[nodiscard]] inline double tan(double x) noexcept {
  return sin(x) / cos(x);
}

/// In -pi / 2 .. pi / 2.
[[nodiscard]] inline double atan(double x) noexcept {
  // atan of 0, 1/8, ... 1: what is left is at most 1/16.
  static constexpr std::array<double, 9> kEighths = {0.0,
                                                     0.12435499454676144,
                                                     0.24497866312686414,
                                                     0.35877067027057225,
                                                     0.4636476090008061,
                                                     0.5585993153435624,
                                                     0.6435011087932844,
                                                     0.7188299996216245,
                                                     0.7853981633974483};
  static constexpr auto kTerms = detail::inverse_odds<8>(-1.0);
  constexpr double kHalfPi = 1.5707963267948966;
  if (x != x) return x;
  const double size = x < 0.0 ? -x : x;
  const bool steep = size > 1.0;
  // Compilers may divide before they choose: never by 0.
  const double slope = steep ? 1.0 / (size + (steep ? 0.0 : 1.0)) : size;
  const double eighth = std::floor(slope * 8.0 + 0.5);
  const double at = eighth * 0.125, rest = (slope - at) / (1.0 + slope * at);
  const double angle =
      kEighths[static_cast<std::size_t>(eighth)] + rest * detail::horner(kTerms, rest * rest);
  const double value = steep ? kHalfPi - angle : angle;
  return x < 0.0 ? -value : value;
}
/// Angle of (x, y) in -pi .. pi; 0 for the zero vector.
[[nodiscard]] inline double atan2(double y, double x) noexcept {
  constexpr double kPi = 3.141592653589793;
  if (x == 0.0 && y == 0.0) return 0.0;
  const double height = y < 0.0 ? -y : y, width = x < 0.0 ? -x : x;
  // One division: of two, compilers may do both before they choose, and by 0.
  const bool steep = height > width;
  const double angle = atan((steep ? width : height) / (steep ? height : width));
  const double first = steep ? 0.5 * kPi - angle : angle;
  const double upper = x < 0.0 ? kPi - first : first;
  return y < 0.0 ? -upper : upper;
}

/// The largest power of two not above x; x > 0 and normal.
[[nodiscard]] inline double power_of_two_below(double x) noexcept {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000ULL);
}
[[nodiscard]] inline double exp2(double x) noexcept {
  const double whole = std::floor(x);
  if (!(whole > -1022.0 && whole < 1024.0))
    return whole < 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  return detail::scaled(exp((x - whole) * detail::kLn2), static_cast<int>(whole));
}
/// Exact at powers of two.
[[nodiscard]] inline double log2(double x) noexcept {
  if (!(x >= std::numeric_limits<double>::min() && x <= std::numeric_limits<double>::max()))
    return log(x) / detail::kLn2;
  const double power = power_of_two_below(x);
  const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(power) >> 52) - 1023;
  return exponent + log(x / power) / detail::kLn2;
}

}  // namespace gnomon::elementary

// Without a branch, for loops that work on several numbers at once, which are known to be in range.
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
