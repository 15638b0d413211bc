// How many numbers are worked on at once, and what loops over such lists are made of.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace gnomon {

/// What the widest vectors hold, 64 bytes. Lists for them are filled up to a multiple of this.
inline constexpr std::size_t kDoubleLanes = 8, kFloatLanes = 16;
using DoubleLanes = std::array<double, kDoubleLanes>;
using FloatLanes = std::array<float, kFloatLanes>;
/// Numbers of a list, filled up.
[[nodiscard]] constexpr std::size_t whole_lanes(std::size_t count) noexcept {
  return (count + kDoubleLanes - 1) / kDoubleLanes * kDoubleLanes;
}

/// What to divide by in place of an x that is not negative and may be 0: max_of(x, least), bit by bit.
/// Compilers may divide by x before they choose (lanes/wide.hpp), and x plus next to nothing is not 0 either.
template <typename Number>
[[nodiscard]] inline Number divisor(Number x, Number least) noexcept {
  constexpr Number kLostInRounding = std::numeric_limits<Number>::epsilon() / 8;
  return (x > least ? x : least) + least * kLostInRounding;
}

/// 1 / x, and 0 at 0: without a choice, as compilers divide first and choose then, and without a trap.
[[nodiscard]] inline double inverse_or_0(double x) noexcept {
  constexpr double kNothing = 1e-280;
  return x / (x * x + kNothing);
}

/// The first lane whose number is the least but for rounding: times `same`, a little below 1, no more than
/// that. Numbers that are none are passed over; the last lane where there is no other.
[[nodiscard]] inline std::size_t first_of_least_lane(const FloatLanes& v, float same) noexcept {
  const auto less = [&](std::size_t i, std::size_t k) { return v[i] < v[k] ? v[i] : v[k]; };
  // Halves against halves: four steps that wait for each other, where one after another would be fifteen.
  std::array<float, kFloatLanes / 2> by8;
  for (std::size_t l = 0; l < by8.size(); ++l) by8[l] = less(l, l + by8.size());
  const auto less8 = [&](std::size_t i, std::size_t k) { return by8[i] < by8[k] ? by8[i] : by8[k]; };
  const float a = less8(0, 4), b = less8(1, 5), c = less8(2, 6), d = less8(3, 7);
  const float ac = a < c ? a : c, bd = b < d ? b : d, least = ac < bd ? ac : bd;
  std::size_t first = 0;
  while (first + 1 < v.size() && !(v[first] * same <= least)) ++first;
  return first;
}

struct LaneRange {
  double low, high;
};
/// The smallest and the largest of `count` numbers, a multiple of kDoubleLanes and more than 0. `lanes` is
/// kDoubleLanes, but not known when this is compiled: loops of a few known steps are taken apart before they
/// could become vectors.
[[nodiscard]] inline LaneRange lane_range(const double* v, std::size_t count, std::size_t lanes) noexcept {
  DoubleLanes low, high;
  for (std::size_t l = 0; l < lanes; ++l) low[l] = high[l] = v[l];
  for (std::size_t i = kDoubleLanes; i < count; i += kDoubleLanes) {
    const double* const next = v + i;
    for (std::size_t l = 0; l < lanes; ++l) low[l] = low[l] < next[l] ? low[l] : next[l];
    for (std::size_t l = 0; l < lanes; ++l) high[l] = high[l] > next[l] ? high[l] : next[l];
  }
  // Halves against halves: three steps that wait for each other, where one after another would be seven.
  const auto less = [&](std::size_t i, std::size_t k) { return low[i] < low[k] ? low[i] : low[k]; };
  const auto more = [&](std::size_t i, std::size_t k) { return high[i] > high[k] ? high[i] : high[k]; };
  const double low04 = less(0, 4), low15 = less(1, 5), low26 = less(2, 6), low37 = less(3, 7);
  const double high04 = more(0, 4), high15 = more(1, 5), high26 = more(2, 6), high37 = more(3, 7);
  const double low0246 = low04 < low26 ? low04 : low26, low1357 = low15 < low37 ? low15 : low37;
  const double high0246 = high04 > high26 ? high04 : high26, high1357 = high15 > high37 ? high15 : high37;
  return {low0246 < low1357 ? low0246 : low1357, high0246 > high1357 ? high0246 : high1357};
}

}  // namespace gnomon
