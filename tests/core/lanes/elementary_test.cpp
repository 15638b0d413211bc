// Are the elementary functions within a few units in the last place of the truth, everywhere they are used?
#include "lanes/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gnomon::test {
namespace {

namespace el = elementary;

/// Units in the last place of the wider result, against long double.
double ulps(double value, long double truth) {
  const double nearest = static_cast<double>(truth);
  if (value == nearest) return 0.0;
  const double unit = std::abs(std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest);
  return static_cast<double>(std::abs(static_cast<long double>(value) - truth)) / unit;
}

struct Worst {
  double ulps = 0.0, at = 0.0;
  void see(double x, double value, long double truth) {
    const double u = test::ulps(value, truth);
    if (u <= ulps) return;
    ulps = u;
    at = x;
  }
};

template <typename Use>
void for_numbers(double low, double high, Use&& use) {
  std::mt19937_64 engine(17);
  for (int i = 0; i < 200000; ++i) {
    const double t = static_cast<double>(engine() >> 11) * 0x1p-53;
    use(low + (high - low) * t);
  }
}

// Derived: one rounding of the sum, one of the reduced argument, half of each of two products.
constexpr double kFew = 2.5;

TEST(Elementary, special_values_are_what_the_standard_says) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  EXPECT_EQ(el::exp(0.0), 1.0);
  EXPECT_EQ(el::exp(infinity), infinity);
  EXPECT_EQ(el::exp(-infinity), 0.0);
  EXPECT_TRUE(std::isnan(el::exp(nan)));
  EXPECT_EQ(el::log(1.0), 0.0);
  EXPECT_EQ(el::log(0.0), -infinity);
  EXPECT_EQ(el::log(infinity), infinity);
  EXPECT_TRUE(std::isnan(el::log(-1.0)));
  EXPECT_EQ(el::expm1(0.0), 0.0);
  EXPECT_EQ(el::log1p(0.0), 0.0);
  EXPECT_EQ(el::sin(0.0), 0.0);
  EXPECT_EQ(el::cos(0.0), 1.0);
  EXPECT_EQ(el::atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(el::atan2(0.0, -1.0), 3.141592653589793);
  EXPECT_EQ(el::atan2(1.0, 0.0), 1.5707963267948966);
  EXPECT_EQ(el::atan2(-1.0, 0.0), -1.5707963267948966);
  for (int k = -1000; k < 1000; ++k) {
    EXPECT_EQ(el::log2(std::ldexp(1.0, k)), k);
    EXPECT_EQ(el::exp2(k), std::ldexp(1.0, k));
    EXPECT_EQ(el::power_of_two_below(std::ldexp(1.75, k)), std::ldexp(1.0, k));
  }
}

TEST(Elementary, exponentials_and_logarithms_are_right_to_a_few_last_places) {
  Worst exp, log, expm1, log1p, tiny;
  for_numbers(-700.0, 700.0,
              [&](double x) { exp.see(x, el::exp(x), std::exp(static_cast<long double>(x))); });
  for_numbers(-40.0, 40.0, [&](double t) {
    const double x = std::exp(t);
    log.see(x, el::log(x), std::log(static_cast<long double>(x)));
  });
  for_numbers(-3.0, 3.0, [&](double x) {
    expm1.see(x, el::expm1(x), std::expm1(static_cast<long double>(x)));
    if (x > -0.99) log1p.see(x, el::log1p(x), std::log1p(static_cast<long double>(x)));
    const double small = x * 1e-12;
    tiny.see(small, el::expm1(small), std::expm1(static_cast<long double>(small)));
    tiny.see(small, el::log1p(small), std::log1p(static_cast<long double>(small)));
  });
  EXPECT_LE(exp.ulps, kFew) << exp.at;
  EXPECT_LE(log.ulps, kFew) << log.at;
  EXPECT_LE(expm1.ulps, kFew) << expm1.at;
  EXPECT_LE(log1p.ulps, kFew) << log1p.at;
  EXPECT_LE(tiny.ulps, kFew) << tiny.at;
}

TEST(Elementary, angles_are_right_to_a_few_last_places) {
  Worst sin, cos, atan, atan2;
  // Where the result is near zero the argument's own rounding is all of it: compared to 1e-15 there.
  const auto see = [](Worst& worst, double x, double value, long double truth) {
    if (std::abs(truth) > 1e-3L) worst.see(x, value, truth);
    EXPECT_LE(std::abs(static_cast<long double>(value) - truth), 1e-15L) << x;
  };
  for_numbers(-20.0, 20.0, [&](double x) {
    see(sin, x, el::sin(x), std::sin(static_cast<long double>(x)));
    see(cos, x, el::cos(x), std::cos(static_cast<long double>(x)));
    atan.see(x, el::atan(x), std::atan(static_cast<long double>(x)));
    const double y = 20.0 * el::sin(7.0 * x);
    atan2.see(x, el::atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
  });
  EXPECT_LE(sin.ulps, kFew) << sin.at;
  EXPECT_LE(cos.ulps, kFew) << cos.at;
  EXPECT_LE(atan.ulps, kFew) << atan.at;
  EXPECT_LE(atan2.ulps, kFew) << atan2.at;
}

TEST(Elementary, powers_of_two_and_their_logarithms_undo_each_other) {
  for_numbers(-1000.0, 1000.0,
              [&](double x) { EXPECT_NEAR(el::log2(el::exp2(x)), x, 1e-15 * std::abs(x) + 4e-16) << x; });
}

}  // namespace
}  // namespace gnomon::test
