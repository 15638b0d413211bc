// Splits with the least error for the receivers that are really there: dynamic programming over depth, then
// refined.
// Based on: the observation of Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, that
// equal errors are best; logarithmic splits give them only where the body is the whole frustum.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/elementary.hpp"
#include "gnomon/split.hpp"

namespace gnomon {

/// Depths between which the first choice is made, evenly spaced in their logarithm.
inline constexpr int kSplitSteps = 16;

/// Moves the inner `edges`, which must ascend from a depth above 0, to where the cascades' costs together are
/// least. `cost(begin, end)`: of one cascade; `joined(a, b)`: of two side by side, never falling with either.
template <typename Cost, typename Joined>
void search_splits(std::span<double> edges, const Cost& cost, const Joined& joined) noexcept {
  const int maps = static_cast<int>(edges.size()) - 1;
  const double n = edges.front(), f = edges.back();
  if (maps < 2 || !(n > 0.0 && f > n)) return;
  std::array<double, kSplitSteps + 1> depth;
  for (int i = 0; i <= kSplitSteps; ++i) {
    depth[static_cast<std::size_t>(i)] =
        i == kSplitSteps ? f : n * elementary::pow(f / n, static_cast<double>(i) / kSplitSteps);
  }
  // best[m][j]: least cost of m + 1 maps over the depths up to j; from[m][j]: where the last of them begins.
  std::array<std::array<double, kSplitSteps + 1>, kMaxMaps> best;
  std::array<std::array<int, kSplitSteps + 1>, kMaxMaps> from{};
  for (auto& row : best) row.fill(std::numeric_limits<double>::infinity());
  // What the given edges come to; a map that costs more alone is in no better division, nor is a longer one.
  double given = cost(edges[0], edges[1]);
  for (std::size_t m = 1; m + 1 < edges.size(); ++m) given = joined(given, cost(edges[m], edges[m + 1]));
  for (int i = 0; i < kSplitSteps; ++i) {
    for (int j = i + 1; j <= kSplitSteps; ++j) {
      const auto to = static_cast<std::size_t>(j);
      const double one = cost(depth[static_cast<std::size_t>(i)], depth[to]);
      if (one > given) break;
      if (i == 0) best[0][to] = one;
      for (std::size_t m = 1; m < static_cast<std::size_t>(maps); ++m) {
        const double total = joined(best[m - 1][static_cast<std::size_t>(i)], one);
        if (i == 0 || !(total < best[m][to])) continue;
        best[m][to] = total;
        from[m][to] = i;
      }
    }
  }
  if (!(best[static_cast<std::size_t>(maps - 1)][kSplitSteps] < std::numeric_limits<double>::infinity()))
    return;
  int at = kSplitSteps;
  for (int m = maps - 1; m > 0; --m) {
    at = from[static_cast<std::size_t>(m)][static_cast<std::size_t>(at)];
    edges[static_cast<std::size_t>(m)] = depth[static_cast<std::size_t>(at)];
  }
}

/// Closes in on the best place of each inner edge between its neighbours, from both sides in the logarithm of
/// depth: the cost of two neighbours has one valley.
template <typename Cost, typename Joined>
void refine_splits(std::span<double> edges, const Cost& cost, const Joined& joined) noexcept {
  constexpr int kRounds = 2, kTrials = 5;
  const double n = edges.front(), f = edges.back();
  if (edges.size() < 3 || !(n > 0.0 && f > n)) return;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t m = 1; m + 1 < edges.size(); ++m) {
      const double below = edges[m - 1], above = edges[m + 1];
      const auto both = [&](double edge) { return joined(cost(below, edge), cost(edge, above)); };
      double least = both(edges[m]);
      double reach = elementary::pow(f / n, 0.5 / kSplitSteps);
      for (int trial = 0; trial < kTrials; ++trial) {
        const double candidates[2] = {edges[m] * reach, edges[m] / reach};
        for (const double candidate : candidates) {
          if (!(candidate > below && candidate < above)) continue;
          const double value = both(candidate);
          if (!(value < least)) continue;
          least = value;
          edges[m] = candidate;
          break;
        }
        reach = std::sqrt(reach);
      }
    }
  }
}

}  // namespace gnomon
