// What is the mean over the texels of a box?
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "geometry/vector.hpp"

namespace gnomon {

/// What of a row of texels lies between two places.
[[nodiscard]] inline double overlap(double first, double count, double low, double high) noexcept {
  return max_of(min_of(high, first + count) - max_of(low, first), 0.0);
}

/// Mean of `value` over a box of texels round a place, by what of each lies in it. `value`: of a texel's
/// middle; negative: not known. Of wide boxes the middles of blocks stand for their texels. Negative where
/// less than `least_known` of the box is known, a share, or the box is empty.
template <class Value>
[[nodiscard]] double mean_over_box(const glm::dvec2& place, double half_side, double least_known,
                                   Value&& value) noexcept {
  constexpr double kMostAlongSide = 8.0;
  const double block = std::ceil(2.0 * half_side / kMostAlongSide);
  const glm::dvec2 low = place - half_side, high = place + half_side;
  double sum = 0.0, weights = 0.0;
  for (double row = std::floor(low.y); row < high.y; row += block) {
    for (double column = std::floor(low.x); column < high.x; column += block) {
      const double of_block = value(glm::dvec2(column, row) + 0.5 * block);
      if (of_block < 0.0) continue;
      const double weight = overlap(column, block, low.x, high.x) * overlap(row, block, low.y, high.y);
      sum += weight * of_block;
      weights += weight;
    }
  }
  return weights > 0.0 && weights >= least_known * 4.0 * half_side * half_side ? sum / weights : -1.0;
}

}  // namespace gnomon
