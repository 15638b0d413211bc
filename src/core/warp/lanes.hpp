// Lists of numbers that vector units work on several at once, and the range of such a list.
#pragma once

#include <array>
#include <cstddef>

namespace gnomon {

/// Lists that are worked on in lanes are filled up to a multiple of this.
inline constexpr std::size_t kWarpLanes = 8;
[[nodiscard]] constexpr std::size_t whole_lanes(std::size_t count) noexcept {
  return (count + kWarpLanes - 1) / kWarpLanes * kWarpLanes;
}

/// 1 / x, and 0 at 0: without a choice, as compilers divide first and choose then, and without a trap.
[[nodiscard]] inline double inverse_or_0(double x) noexcept {
  constexpr double kNothing = 1e-280;
  return x / (x * x + kNothing);
}

struct LaneRange {
  double low, high;
};
/// The smallest and the largest of `count` numbers, a multiple of kWarpLanes and more than 0. `lanes` is
/// kWarpLanes, but not known when this is compiled: loops of a few known steps are taken apart before they
/// could become vectors.
[[nodiscard]] inline LaneRange lane_range(const double* v, std::size_t count, std::size_t lanes) noexcept {
  std::array<double, kWarpLanes> low, high;
  for (std::size_t l = 0; l < lanes; ++l) low[l] = high[l] = v[l];
  for (std::size_t i = kWarpLanes; i < count; i += kWarpLanes) {
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
