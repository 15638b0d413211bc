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

#include "gnomon/options.hpp"
#include "lanes/elementary.hpp"

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
  // What the given edges come to: no part of a better division costs as much.
  double given = cost(edges[0], edges[1]);
  for (std::size_t m = 1; m + 1 < edges.size(); ++m) given = joined(given, cost(edges[m], edges[m + 1]));
  // best[m][j]: least cost of m + 1 maps over the depths up to j; from[m][j]: where the last of them begins.
  std::array<std::array<double, kSplitSteps + 1>, kMaxMaps> best;
  std::array<std::array<int, kSplitSteps + 1>, kMaxMaps> from{};
  for (auto& row : best) row.fill(given);
  const auto last = static_cast<std::size_t>(maps - 1);
  for (int i = 0; i < kSplitSteps; ++i) {
    const auto begin = static_cast<std::size_t>(i);
    double inside = 0.0;  // of a shorter interval, than which a longer one costs no less
    for (int j = i + 1; j <= kSplitSteps; ++j) {
      const auto end = static_cast<std::size_t>(j);
      // The last map ends at the end, and no other does.
      const std::size_t first = i == 0 ? 0 : j < kSplitSteps ? 1 : last;
      const std::size_t beyond = i == 0 ? (j < kSplitSteps ? 1 : 0) : j < kSplitSteps ? last : last + 1;
      const auto total = [&](std::size_t m, double one) {
        return m == 0 ? one : joined(best[m - 1][begin], one);
      };
      bool may_help = false;
      for (std::size_t m = first; m < beyond; ++m) may_help = may_help || total(m, inside) < best[m][end];
      if (!may_help) continue;
      inside = cost(depth[begin], depth[end]);
      if (!(inside < given)) break;
      for (std::size_t m = first; m < beyond; ++m) {
        if (!(total(m, inside) < best[m][end])) continue;
        best[m][end] = total(m, inside);
        from[m][end] = i;
      }
    }
  }
  if (!(best[last][kSplitSteps] < given)) return;
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
  constexpr int kRounds = 2, kTrials = 3;
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
