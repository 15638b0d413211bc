// Splits for the receivers that are really there: least objective by dynamic programming over depth, then
// refined. Based on: the observation of Lloyd et al. 2006 that equal errors are best; logarithmic splits give
// them only where the body is the whole frustum.
#include "split_optimal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "elementary.hpp"
#include "map_parts.hpp"
#include "plan_splits.hpp"
#include "vector.hpp"
#include "visible.hpp"

namespace gnomon {
namespace {

// Depths between which the first choice is made, evenly spaced in their logarithm.
constexpr int kSteps = 16;
// Rounds and trials of moving one edge between its neighbours.
constexpr int kRounds = 2;
constexpr int kTrials = 5;

/// The body between two depths, less what is not seen at the ends.
Polytope between(const PlanContext& c, const Polytope& body, double from, double to) noexcept {
  const auto [begin, end] = seen_between(c, from, to);
  Polytope part = body;
  if (!(begin <= end)) {
    part.vertex_count = 0;
    return part;
  }
  clip(part, Plane{c.axes.forward, -begin});
  clip(part, Plane{-c.axes.forward, end});
  return part;
}

/// Error of one map over the part of the body between two depths, with LiSPSM at its best strength as the
/// measure: every warp of this toolkit comes near it or betters it by about the same factor everywhere.
double error_between(const PlanContext& c, const Polytope& body, double begin, double end) noexcept {
  const Polytope part = between(c, body, begin, end);
  if (part.empty()) return 0.0;
  Polytope focus;
  const LightBody points = judged_body(c, c.frame, part, focus);
  WarpInput in{};
  in.body = points.points();
  in.y_min = in.y_max = points.point[0].y;
  for (const WarpInput::Point& p : in.body) {
    in.y_min = min_of(in.y_min, p.y);
    in.y_max = max_of(in.y_max, p.y);
  }
  in.orthographic = c.camera.orthographic;
  in.objective = c.options.objective;
  const bool warped = &c.warp != &warps::none;
  return warp_error(in, warped ? warps::lispsm.choose(in).kappa : 0.0).value(in.objective);
}

/// Of two maps side by side.
double joined(Objective objective, double a, double b) noexcept {
  return objective == Objective::storage ? a + b : max_of(a, b);
}

/// The objective of all maps together, exactly as the plan will lay them.
double exact_objective(const PlanContext& c, const Polytope& body, std::span<const double> edges) noexcept {
  double total = 0.0;
  for (std::size_t m = 0; m + 1 < edges.size(); ++m) {
    Polytope part = between(c, body, edges[m], edges[m + 1]);
    if (c.bounds.receivers.size() > 1 && !part.empty()) {
      clip(part, visible_bounds(part, c.bounds.receivers, c.camera.position));
    }
    if (part.empty()) continue;
    total = joined(c.options.objective, total, tight_objective(c, part, edges[m], edges[m + 1]));
  }
  return total;
}

}  // namespace

void optimise_splits(const PlanContext& c, const Polytope& body, std::span<double> edges) noexcept {
  const int maps = static_cast<int>(edges.size()) - 1;
  const double n = edges.front(), f = edges.back();
  std::array<double, kMaxMaps + 1> logarithmic;
  std::copy(edges.begin(), edges.end(), logarithmic.begin());
  if (maps < 2 || !(n > 0.0 && f > n)) return;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  std::array<double, kSteps + 1> depth;
  for (int i = 0; i <= kSteps; ++i) {
    depth[static_cast<std::size_t>(i)] =
        i == kSteps ? f : n * elementary::pow(f / n, static_cast<double>(i) / kSteps);
  }
  // best[m][j]: least objective of m + 1 maps over the depths up to j; from[m][j]: where the last of them
  // begins.
  std::array<std::array<double, kSteps + 1>, kMaxMaps> best;
  std::array<std::array<int, kSteps + 1>, kMaxMaps> from{};
  for (auto& row : best) row.fill(kInfinite);
  for (int i = 0; i < kSteps; ++i) {
    for (int j = i + 1; j <= kSteps; ++j) {
      const auto to = static_cast<std::size_t>(j);
      const double error = error_between(c, body, depth[static_cast<std::size_t>(i)], depth[to]);
      if (i == 0) best[0][to] = error;
      for (std::size_t m = 1; m < static_cast<std::size_t>(maps); ++m) {
        const double total = joined(c.options.objective, best[m - 1][static_cast<std::size_t>(i)], error);
        if (i == 0 || !(total < best[m][to])) continue;
        best[m][to] = total;
        from[m][to] = i;
      }
    }
  }
  int at = kSteps;
  for (int m = maps - 1; m > 0; --m) {
    at = from[static_cast<std::size_t>(m)][static_cast<std::size_t>(at)];
    edges[static_cast<std::size_t>(m)] = depth[static_cast<std::size_t>(at)];
  }
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t m = 1; m < static_cast<std::size_t>(maps); ++m) {
      const double below = edges[m - 1], above = edges[m + 1];
      const auto cost = [&](double edge) {
        return joined(c.options.objective, error_between(c, body, below, edge),
                      error_between(c, body, edge, above));
      };
      double least = cost(edges[m]);
      // The objective of two neighbours has one valley: close in on it from both sides in the logarithm of
      // depth.
      double reach = elementary::pow(f / n, 0.5 / kSteps);
      for (int trial = 0; trial < kTrials; ++trial) {
        const double candidates[2] = {edges[m] * reach, edges[m] / reach};
        for (const double candidate : candidates) {
          if (!(candidate > below && candidate < above)) continue;
          const double value = cost(candidate);
          if (!(value < least)) continue;
          least = value;
          edges[m] = candidate;
          break;
        }
        reach = std::sqrt(reach);
      }
    }
  }
  // The search goes by a simplified error; what counts is the exact one.
  const std::span<const double> before{logarithmic.data(), edges.size()};
  if (!(exact_objective(c, body, edges) < exact_objective(c, body, before))) {
    std::copy(before.begin(), before.end(), edges.begin());
  }
}

}  // namespace gnomon
