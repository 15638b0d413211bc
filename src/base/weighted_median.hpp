// The value in the middle of weighted ones, which few strays do not move.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace gnomon {

/// The least value such that it and all below it have half of the weight. Pairs of value and weight, at least
/// one; weights of 0 or more.
[[nodiscard]] inline double weighted_median(std::vector<std::pair<double, double>> values) {
  std::sort(values.begin(), values.end());
  double all = 0.0, below = 0.0;
  for (const auto& [value, weight] : values) all += weight;
  for (const auto& [value, weight] : values) {
    below += weight;
    if (below >= 0.5 * all) return value;
  }
  return values.back().first;
}

}  // namespace gnomon
