// How large is each map to be?
//
// By worst errors: equal ones, as any other division of the same texels has a worse worst map. By the
// picture: the mean over n points of errors e / size is least where each map's area goes by (n e)^(2/3), as
// its derivative by any map's area is then the same. Based on: Lloyd et al., "Warping and Partitioning for
// Low Error Shadow Maps", 2006 (storage of a partition); the budget's distribution is this project's.
#include "plan/budget.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/first_hits.hpp"
#include "geometry/usable.hpp"
#include "geometry/vector.hpp"
#include "gnomon/measure.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {

MapSizes equal_sizes(int size) noexcept {
  MapSizes sizes;
  sizes.of.fill({size, size});
  return sizes;
}

TexelDemands::TexelDemands(const PlanContext& c, const ShadowPlan& fitted, bool square) noexcept
    : options_(c.options), square_(square) {
  for (const ShadowMap& map : fitted.maps()) {
    const double border = 2.0 * map.filter_margin_texels;
    const bool in_texels = map.filter_margin_texels <= std::ceil(options_.filter.texels);
    const double longer = max_of(map.width, map.height), now = max_of(map.m_s_max, map.m_t_max);
    Demand& d = demand_[count_++];
    d.cascade = static_cast<std::size_t>(map.cascade);
    d.bound_s = map.m_s_max * (map.width - border);
    d.bound_t = map.m_t_max * (map.height - border);
    d.any_direction = now > 0.0 ? map.m_max / now : 1.0;
    d.border_texels = in_texels ? border : 0.0;
    d.border_share = in_texels ? 0.0 : border / longer;
    d.s = square ? max_of(d.bound_s, d.bound_t) : d.bound_s;
    d.t = square ? max_of(d.bound_s, d.bound_t) : d.bound_t;
    d.points = 1.0;
  }
  const auto has_need = [](const Demand& d) {
    return d.bound_s > 0.0 && d.bound_t > 0.0 && d.bound_s < kLargest && d.bound_t < kLargest;
  };
  by_points_ =
      std::all_of(demand_.begin(), demand_.begin() + static_cast<std::ptrdiff_t>(count_), has_need) &&
      options_.resolution.texel_budget > 0 && options_.warp.objective == Objective::picture &&
      c.seen.size() >= SeenPoints::kFewest;
  if (by_points_) count_points(c, fitted);
}

void TexelDemands::count_points(const PlanContext& c, const ShadowPlan& fitted) noexcept {
  std::array<double, kMaxMaps> s{}, t{};
  for (const glm::dvec3& point : c.seen) {
    const glm::dvec3 world = c.camera.position + point;
    const int serving = map_serving(fitted, world, glm::dot(c.axes.forward, point));
    if (serving < 0) continue;
    const auto at = static_cast<std::size_t>(serving);
    const ShadowMap& map = fitted.map[at];
    if (!map_holds(fitted, map, world)) continue;
    const PointAliasing m = measure_perspective(map, c.camera, world);
    if (!(m.perspective_s < kLargest && m.perspective_t < kLargest)) continue;
    const double border = 2.0 * map.filter_margin_texels;
    s[at] += m.perspective_s * (map.width - border);
    t[at] += m.perspective_t * (map.height - border);
    demand_[at].points += 1.0;
  }
  // The bound stands for one point: what the points miss is no reason for a map without texels.
  for (std::size_t i = 0; i < count_; ++i) {
    Demand& d = demand_[i];
    d.s = (s[i] + d.bound_s) / d.points;
    d.t = (t[i] + d.bound_t) / d.points;
    // Boxes are no surfaces: how many guesses a map has says less than how many points it has.
    if (c.visible_points.empty()) d.points = std::sqrt(d.points);
    if (square_) d.s = d.t = 0.5 * (d.s + d.t);
  }
}

int TexelDemands::side(double texels, const Demand& demand, int least) noexcept {
  const double wanted = texels / (1.0 - demand.border_share) + demand.border_texels;
  return static_cast<int>(clamp_to(std::floor(wanted / kSizeStep) * kSizeStep, least, kMaxMapSize));
}

double TexelDemands::error_along(double texels, const Demand& demand, int size) noexcept {
  return texels / (size * (1.0 - demand.border_share) - demand.border_texels);
}

double TexelDemands::share_of(const Demand& demand) const noexcept {
  if (!by_points_) return 1.0;
  // Sides keep their ratio, so that errors along both stay equal.
  const double both = std::sqrt(demand.s) * std::sqrt(demand.t);
  return elementary::pow(demand.points * both, 1.0 / 3.0) / both;
}

MapSizes TexelDemands::sizes_at(double scale) const noexcept {
  const int least = least_budget_side(options_);
  MapSizes sizes = equal_sizes(least);
  for (std::size_t i = 0; i < count_; ++i) {
    const Demand& d = demand_[i];
    const double share = scale * share_of(d);
    sizes.of[d.cascade] = {side(d.s * share, d, least), side(d.t * share, d, least)};
  }
  return sizes;
}

MapSizes TexelDemands::within_budget(int count) const noexcept {
  const auto fits = [&](double scale) {
    const MapSizes sizes = sizes_at(scale);
    std::int64_t texels = 0;
    // Those not drawn, too: a smaller map's wider border may reach a caster that theirs did not.
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      texels += std::int64_t{sizes.of[i].width} * sizes.of[i].height;
    return texels <= options_.resolution.texel_budget;
  };
  double largest = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Demand& d = demand_[i];
    largest = max_of(largest, max_of(d.s, d.t) * share_of(d));
  }
  if (!(largest > 0.0 && std::isfinite(largest))) return equal_sizes(least_budget_side(options_));
  // At the first every side is the least; at the second the largest map has the largest side.
  double enough = 1.0 / largest, too_much = (kMaxMapSize + 1) / largest;
  if (fits(too_much)) return sizes_at(too_much);
  // Steps of the logarithm down to far below what one step of a side changes.
  constexpr int kHalvings = 48;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(enough) * std::sqrt(too_much);
    (fits(middle) ? enough : too_much) = middle;
  }
  return sizes_at(enough);
}

double TexelDemands::largest_error(const MapSizes& sizes) const noexcept {
  double m = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Demand& d = demand_[i];
    const MapSizes::Size size = sizes.of[d.cascade];
    const double sides =
        max_of(error_along(d.bound_s, d, size.width), error_along(d.bound_t, d, size.height));
    // From the axes to any direction, as at the size that the map has.
    m = max_of(m, sides * d.any_direction);
  }
  return m;
}

double TexelDemands::error(const MapSizes& sizes) const noexcept {
  if (!by_points_) return largest_error(sizes);
  double sum = 0.0, points = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Demand& d = demand_[i];
    const MapSizes::Size size = sizes.of[d.cascade];
    const double s = error_along(d.s, d, size.width), t = error_along(d.t, d, size.height);
    sum += d.points * std::sqrt(0.5 * (s * s + t * t));
    points += d.points;
  }
  return points > 0.0 ? sum / points : 0.0;
}

int least_budget_side(const PlanOptions& options) noexcept {
  const int steps = static_cast<int>(std::ceil(4.0 * options.filter.texels / kSizeStep));
  return kSizeStep * (steps > 1 ? steps : 1);
}

}  // namespace gnomon
