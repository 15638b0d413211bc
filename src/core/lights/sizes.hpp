// How many texels each light gets.
#pragma once

#include <cstdint>
#include <span>

#include "gnomon/lights.hpp"

namespace gnomon {

/// Sizes by level: the smallest side doubled `level` times.
struct SizeLadder {
  int least = 16;     // texels
  int floor = 0;      // level of LightOptions::least_size
  int top = 0;        // level of LightOptions::most_size
  double border = 0;  // texels along each side that hold a filter's kernel
  [[nodiscard]] double inside(int level) const noexcept {
    return static_cast<double>(std::int64_t{least} << level) - 2.0 * border;
  }
  /// Area of one map, in squares of the smallest.
  [[nodiscard]] static std::int64_t cells(int level) noexcept { return std::int64_t{1} << (2 * level); }
};

/// Sets the levels of all lights, within `cells` squares of the smallest size, and orders them by their
/// light. `demand` is that of LightImportance times weight and share. Each light's `top` bounds its level,
/// and up to `last` its steps count `keep_gain` times. False, without levels, where not even the smallest
/// maps fit.
///
/// Each step doubles one light's maps: that whose error falls most per texel. Steps of one light gain ever
/// less, so that no order of steps gains more from the same texels; only the last texels, too few for the
/// next step, go to steps that gain less. More cells never make the sum of errors larger: up to the first
/// step that fits into the larger budget alone both orders are the same, and that step gains more than all
/// that the smaller budget has left.
[[nodiscard]] bool choose_sizes(std::span<LightWork> lights, const SizeLadder& ladder, std::int64_t cells,
                                double keep_gain) noexcept;

}  // namespace gnomon
