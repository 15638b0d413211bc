// The cost model of a machine, fitted to measurements.
#include "gnomon/report/cost_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "gnomon/report/row.hpp"

namespace gnomon::report {
namespace {

constexpr std::size_t kFewest = 8;

/// Mean of |predicted - value| / value.
double relative_error(std::span<const std::vector<double>> rows, std::span<const double> values,
                      const std::vector<double>& x) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!(values[i] > 0.0)) continue;
    const double predicted = std::inner_product(x.begin(), x.end(), rows[i].begin(), 0.0);
    sum += std::abs(predicted - values[i]) / values[i];
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// Features and values of one part of the time.
struct Part {
  std::vector<std::vector<double>> rows;
  std::vector<double> values;
  void add(std::vector<double> features, double value) {
    rows.push_back(std::move(features));
    values.push_back(value);
  }
};

/// How errors depend on those expected and on the filter: log wrong = view + filter + power * log expected.
/// Views whose errors are others, such as leaks, have levels of their own, with a mean of 0. Filters that
/// compare have one power, and the others, whose leaks no finer texel stops, another.
class ErrorLaw {
 public:
  explicit ErrorLaw(std::span<const Observation> observations) {
    for (const Observation& o : observations) {
      // Counts scatter by their root, and the law by a fifth.
      constexpr double kScatter = 0.2 * 0.2;
      const double count = o.wrong * o.pixels;
      if (count > 0.0 && o.expected > 0.0)
        points_.push_back({o.view, o.filter, o.compares, std::log(o.expected), std::log(o.wrong),
                           1.0 / (1.0 / count + kScatter)});
    }
    for (const bool compares : {false, true}) power_[compares] = fitted_power(compares);
    // Levels of filters and views, by turns: each the mean of what the other leaves.
    constexpr int kRounds = 50;
    for (int round = 0; round < kRounds; ++round) {
      average(&Point::filter, filters_, views_);
      average(&Point::view, views_, filters_);
      centre(views_);
    }
  }

  void tell(const std::string& filter, bool compares, FilterCost& cost) const {
    const auto found = filters_.find(filter);
    if (found == filters_.end()) return;
    cost.error_power = power_.at(compares);
    cost.error_ratio = std::exp(found->second);
  }

 private:
  struct Point {
    std::string view, filter;
    bool compares;
    double log_expected, log_wrong, weight;
  };
  using Levels = std::map<std::string, double>;

  /// The slope within views and filters, for they differ in level.
  [[nodiscard]] double fitted_power(bool compares) const {
    struct Mean {
      double log_expected = 0.0, log_wrong = 0.0, weight = 0.0;
    };
    std::map<std::pair<std::string, std::string>, Mean> means;
    for (const Point& p : points_) {
      if (p.compares != compares) continue;
      Mean& mean = means[{p.view, p.filter}];
      mean.log_expected += p.weight * p.log_expected;
      mean.log_wrong += p.weight * p.log_wrong;
      mean.weight += p.weight;
    }
    double xy = 0.0, xx = 0.0;
    for (const Point& p : points_) {
      if (p.compares != compares) continue;
      const Mean& mean = means.at({p.view, p.filter});
      const double x = p.log_expected - mean.log_expected / mean.weight;
      xy += p.weight * x * (p.log_wrong - mean.log_wrong / mean.weight);
      xx += p.weight * x * x;
    }
    return xx > 0.0 ? std::max(xy / xx, 0.0) : 0.0;
  }

  void average(std::string Point::*key, Levels& levels, const Levels& others) {
    const auto other_key = key == &Point::view ? &Point::filter : &Point::view;
    std::map<std::string, std::pair<double, double>> sums;
    for (const Point& p : points_) {
      const auto other = others.find(p.*other_key);
      auto& [sum, count] = sums[p.*key];
      sum += p.log_wrong - power_.at(p.compares) * p.log_expected -
             (other == others.end() ? 0.0 : other->second);
      count += 1.0;
    }
    for (const auto& [name, sum] : sums) levels[name] = sum.first / sum.second;
  }

  static void centre(Levels& levels) {
    double sum = 0.0;
    for (const auto& [name, level] : levels) sum += level;
    for (auto& [name, level] : levels) level -= sum / static_cast<double>(levels.size());
  }

  std::vector<Point> points_;
  Levels views_, filters_;
  std::array<double, 2> power_{};  ///< of filters that do not compare, and of those that do
};

}  // namespace

std::vector<double> least_squares(std::span<const std::vector<double>> rows, std::span<const double> values) {
  const std::size_t n = rows.empty() ? 0 : rows.front().size();
  std::vector<double> square(n * n), right(n), x(n);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!(values[i] > 0.0)) continue;
    for (std::size_t a = 0; a < n; ++a) {
      right[a] += rows[i][a] / values[i];
      for (std::size_t b = 0; b < n; ++b)
        square[a * n + b] += rows[i][a] * rows[i][b] / (values[i] * values[i]);
    }
  }
  // Coordinate descent: the sum is convex, and so each step to the least along one axis, cut at zero, leads
  // down.
  constexpr int kSweeps = 20'000;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double moved = 0.0;
    for (std::size_t a = 0; a < n; ++a) {
      const double diagonal = square[a * n + a];
      if (!(diagonal > 0.0)) continue;
      double rest = right[a];
      for (std::size_t b = 0; b < n; ++b) rest -= b == a ? 0.0 : square[a * n + b] * x[b];
      const double next = std::max(rest / diagonal, 0.0);
      moved = std::max(moved, std::abs(next - x[a]) * std::sqrt(diagonal));
      x[a] = next;
    }
    if (moved < 1e-12) break;
  }
  return x;
}

CostModel StoredCostModel::view(std::vector<FilterCost>& costs) const {
  costs.clear();
  for (const std::vector<Filter>* const list : {&filters, &pages.filters}) {
    for (const Filter& filter : *list) {
      costs.push_back(filter.cost);
      costs.back().name = filter.name;
    }
  }
  const std::span<const FilterCost> all(costs);
  return {{drawing, all.first(filters.size())}, {pages.drawing, all.subspan(filters.size())}};
}

double predicted_ms(const StoredCostModel& model, const Observation& observation) noexcept {
  const StoredCosts& costs = observation.pages ? model.pages : model;
  const auto filter = std::find_if(costs.filters.begin(), costs.filters.end(),
                                   [&](const auto& one) { return one.name == observation.filter; });
  if (filter == costs.filters.end()) return std::numeric_limits<double>::infinity();
  return gnomon::predicted_ms(costs.drawing, filter->cost, observation.work, observation.megapixels);
}

namespace {

/// Of maps alone, or of pages alone.
StoredCosts fit_alike(std::span<const Observation> observations) {
  if (observations.size() < kFewest)
    throw ReportError("a cost model wants at least " + std::to_string(kFewest) + " rows, there are " +
                      std::to_string(observations.size()));
  StoredCosts model;
  Part depth;
  std::map<std::string, std::pair<Part, Part>> filters;  // prefilter and look-up
  std::map<std::string, const Observation*> any;         // of each filter
  for (const Observation& o : observations) {
    const PlanWork& w = o.work;
    depth.add(
        {1.0, w.maps, w.megatexels, w.kilodraws, w.megatriangles, w.megatexels_tested, w.megatexels_covered},
        o.frame_ms + o.depth_ms);
    filters[o.filter].first.add({w.maps, w.megatexels}, o.prefilter_ms);
    filters[o.filter].second.add({o.megapixels}, o.lookup_ms);
    any[o.filter] = &o;
  }
  const std::vector<double> x = least_squares(depth.rows, depth.values);
  model.drawing = {x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
  model.depth_error = relative_error(depth.rows, depth.values, x);
  const ErrorLaw law(observations);
  const auto count = static_cast<double>(filters.size());
  for (const auto& [name, parts] : filters) {
    const std::vector<double> stored = least_squares(parts.first.rows, parts.first.values);
    const std::vector<double> looked = least_squares(parts.second.rows, parts.second.values);
    FilterCost cost;
    cost.prefilter_ms_per_map = stored[0];
    cost.prefilter_ms_per_megatexel = stored[1];
    cost.lookup_ms_per_megapixel = looked[0];
    cost.bytes_per_texel = any.at(name)->bytes_per_texel;
    cost.kernel_texels = any.at(name)->kernel_texels;
    cost.extent = any.at(name)->extent;
    law.tell(name, any.at(name)->compares, cost);
    model.filters.push_back({name, cost});
    model.prefilter_error += relative_error(parts.first.rows, parts.first.values, stored) / count;
    model.lookup_error += relative_error(parts.second.rows, parts.second.values, looked) / count;
  }
  return model;
}

}  // namespace

StoredCostModel fit_costs(std::span<const Observation> observations, std::string machine) {
  std::vector<Observation> maps, pages;
  for (const Observation& o : observations) (o.pages ? pages : maps).push_back(o);
  StoredCostModel model{fit_alike(maps), std::move(machine), {}};
  if (!pages.empty()) model.pages = fit_alike(pages);
  return model;
}

}  // namespace gnomon::report
