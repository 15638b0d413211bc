// How large each map is to be: equal errors, as any other division of the same texels has a worse worst map.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006 (storage of a
// partition); the budget's distribution is this project's.
#include "plan/budget.hpp"

#include <cmath>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

/// Texels inside the border that bring the bound of m to 1, along both axes.
struct Demand {
  double s, t;
  // Of both sides together. A kernel in texels takes the same number of any side, one in world units the same
  // share.
  double border_texels, border_share;
};

Demand demand_of(const ShadowMap& map, const PlanOptions& options, bool square) noexcept {
  const double border = 2.0 * map.filter_margin_texels;
  const double s = map.m_s_max * (map.width - border), t = map.m_t_max * (map.height - border);
  const bool in_texels = map.filter_margin_texels <= std::ceil(options.filter.texels);
  const double longer = max_of(map.width, map.height);
  return {square ? max_of(s, t) : s, square ? max_of(s, t) : t, in_texels ? border : 0.0,
          in_texels ? 0.0 : border / longer};
}

/// Side in whole steps under which m is at least about `m`.
int side(double texels, const Demand& demand, double m, int least) noexcept {
  const double wanted = texels / m / (1.0 - demand.border_share) + demand.border_texels;
  return static_cast<int>(clamp_to(std::floor(wanted / kSizeStep) * kSizeStep, least, kMaxMapSize));
}

double error(double texels, const Demand& demand, int size) noexcept {
  return texels / (size * (1.0 - demand.border_share) - demand.border_texels);
}

}  // namespace

MapSizes equal_sizes(int size) noexcept {
  MapSizes sizes;
  sizes.of.fill({size, size});
  return sizes;
}

MapSizes budgeted_sizes(const ShadowPlan& fitted, const PlanOptions& options, int count,
                        bool square) noexcept {
  const int least = least_budget_side(options);
  const auto sizes_at = [&](double m) {
    MapSizes sizes = equal_sizes(least);
    for (const ShadowMap& map : fitted.maps()) {
      const Demand demand = demand_of(map, options, square);
      sizes.of[static_cast<std::size_t>(map.cascade)] = {side(demand.s, demand, m, least),
                                                         side(demand.t, demand, m, least)};
    }
    return sizes;
  };
  const auto fits = [&](double m) {
    const MapSizes sizes = sizes_at(m);
    std::int64_t texels = 0;
    // Those not drawn, too: a smaller map's wider border may reach a caster that theirs did not.
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      texels += std::int64_t{sizes.of[i].width} * sizes.of[i].height;
    return texels <= options.resolution.texel_budget;
  };
  double largest = 0.0;
  for (const ShadowMap& map : fitted.maps()) {
    const Demand demand = demand_of(map, options, square);
    largest = max_of(largest, max_of(demand.s, demand.t));
  }
  if (!(largest > 0.0 && std::isfinite(largest))) return equal_sizes(least);
  // At the first every side is the least; at the second the largest map has the largest side, and the bound
  // is as low as a side of a map can bring it.
  double enough = largest, too_little = largest / kMaxMapSize;
  if (fits(too_little)) return sizes_at(too_little);
  // Steps of the logarithm down to far below what one step of a side changes.
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(enough * too_little);
    (fits(middle) ? enough : too_little) = middle;
  }
  return sizes_at(enough);
}

double largest_error(const ShadowPlan& fitted, const PlanOptions& options, const MapSizes& sizes) noexcept {
  double m = 0.0;
  for (const ShadowMap& map : fitted.maps()) {
    const Demand demand = demand_of(map, options, false);
    const MapSizes::Size size = sizes.of[static_cast<std::size_t>(map.cascade)];
    const double sides = max_of(error(demand.s, demand, size.width), error(demand.t, demand, size.height));
    // From the axes to any direction, as at the size that the map has.
    const double now = max_of(map.m_s_max, map.m_t_max);
    m = max_of(m, now > 0.0 ? sides * (map.m_max / now) : sides);
  }
  return m;
}

int least_budget_side(const PlanOptions& options) noexcept {
  const int steps = static_cast<int>(std::ceil(4.0 * options.filter.texels / kSizeStep));
  return kSizeStep * (steps > 1 ? steps : 1);
}

}  // namespace gnomon
