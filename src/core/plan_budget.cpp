// How large each map is to be: equal errors, as any other division of the same texels has a worse worst map.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006 (storage of a
// partition); the budget's distribution is this project's.
#include "plan_budget.hpp"

#include <cmath>

#include "plan_context.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

/// Texels inside the rim that bring the bound of m to 1, along both axes.
struct Demand {
  double s, t;
  // Of both sides together. A kernel in texels takes the same number of any side, one in world units the same
  // share.
  double rim_texels, rim_share;
};

Demand demand_of(const ShadowMap& map, const PlanOptions& options, bool square) noexcept {
  const double rim = 2.0 * map.filter_margin_texels;
  const double s = map.m_s_max * (map.width - rim), t = map.m_t_max * (map.height - rim);
  const bool in_texels = map.filter_margin_texels <= std::ceil(options.filter_radius_texels);
  const double longer = max_of(map.width, map.height);
  return {square ? max_of(s, t) : s, square ? max_of(s, t) : t, in_texels ? rim : 0.0,
          in_texels ? 0.0 : rim / longer};
}

/// Side in whole steps under which m is at least about `m`.
int side(double texels, const Demand& demand, double m, int least) noexcept {
  const double wanted = texels / m / (1.0 - demand.rim_share) + demand.rim_texels;
  return static_cast<int>(clamp_to(std::floor(wanted / kBudgetStep) * kBudgetStep, least, kMostMapSize));
}

double error(double texels, const Demand& demand, int size) noexcept {
  return texels / (size * (1.0 - demand.rim_share) - demand.rim_texels);
}

}  // namespace

MapSizes equal_sizes(int size) noexcept {
  MapSizes sizes;
  sizes.of.fill({size, size});
  return sizes;
}

MapSizes budgeted_sizes(const ShadowPlan& laid, const PlanOptions& options, int count, bool square) noexcept {
  const int least = least_budget_side(options);
  const auto sizes_at = [&](double m) {
    MapSizes sizes = equal_sizes(least);
    for (const ShadowMap& map : laid.maps()) {
      const Demand demand = demand_of(map, options, square);
      sizes.of[static_cast<std::size_t>(map.cascade)] = {side(demand.s, demand, m, least),
                                                         side(demand.t, demand, m, least)};
    }
    return sizes;
  };
  const auto fits = [&](double m) {
    const MapSizes sizes = sizes_at(m);
    std::int64_t texels = 0;
    // Those not laid, too: a smaller map's wider rim may reach a caster that theirs did not.
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      texels += std::int64_t{sizes.of[i].width} * sizes.of[i].height;
    return texels <= options.texel_budget;
  };
  double largest = 0.0;
  for (const ShadowMap& map : laid.maps()) {
    const Demand demand = demand_of(map, options, square);
    largest = max_of(largest, max_of(demand.s, demand.t));
  }
  if (!(largest > 0.0 && std::isfinite(largest))) return equal_sizes(least);
  // At the first every side is the least; at the second the largest map has the largest side, and the bound
  // is as low as a side of a map can bring it.
  double enough = largest, too_little = largest / kMostMapSize;
  if (fits(too_little)) return sizes_at(too_little);
  // Steps of the logarithm down to far below what one step of a side changes.
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(enough * too_little);
    (fits(middle) ? enough : too_little) = middle;
  }
  return sizes_at(enough);
}

double bound_of_pruning(const PlanOptions& options, bool has_history) noexcept {
  const bool free = options.fit == Fit::tight || options.fit == Fit::rotated;
  if (!options.prune.has(PruneRule::metric_resolution) || !free || has_history || options.texel_budget > 0)
    return 0.0;
  const double m = options.target_m > 0.0 ? min_of(options.target_m, options.prune_m) : options.prune_m;
  return max_of(m, kLeastPruneM);
}

void omit_texels(const PlanOptions& options, double before, const ShadowMap& map, ShadowPlan& plan) noexcept {
  const std::int64_t left_out =
      std::int64_t{options.map_size} * options.map_size - std::int64_t{map.width} * map.height;
  if (left_out == 0) return;
  omit(plan, {OmissionKind::resolution_without_gain, map.cascade, before, max_of(map.m_s_max, map.m_t_max),
              left_out});
}

double largest_error(const ShadowPlan& laid, const PlanOptions& options, const MapSizes& sizes) noexcept {
  double m = 0.0;
  for (const ShadowMap& map : laid.maps()) {
    const Demand demand = demand_of(map, options, false);
    const MapSizes::Size size = sizes.of[static_cast<std::size_t>(map.cascade)];
    m = max_of(m, max_of(error(demand.s, demand, size.width), error(demand.t, demand, size.height)));
  }
  return m;
}

int least_budget_side(const PlanOptions& options) noexcept {
  const int steps = static_cast<int>(std::ceil(4.0 * options.filter_radius_texels / kBudgetStep));
  return kBudgetStep * (steps > 1 ? steps : 1);
}

}  // namespace gnomon
