// Which technique to take: the cheapest that meets an error, or the one with the least error within a budget.
#include "gnomon/study/technique.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lanes/elementary.hpp"

namespace gnomon {
namespace {

constexpr double kMega = 1e6;
/// How much less counts as a trade.
constexpr double kTrade = 0.8;

/// One plan, for all filters of one extent.
struct Planned {
  Technique technique;                    ///< its filter is the first of them
  std::array<double, kMaxKernels> wrong;  ///< expected share of the pixels, by kernel
  PlanWork work;
};

const Warp* const kWarps[] = {&warps::none, &warps::lispsm, &warps::optimal};
constexpr SplitScheme kSplits[] = {SplitScheme::automatic};
constexpr int kCascades[] = {1, 2, 3, 4};
constexpr int kSizes[] = {256, 512, 1024, 2048, 4096};

template <class T, std::size_t N>
std::span<const T> given_or(std::span<const T> given, const T (&otherwise)[N]) noexcept {
  return given.empty() ? std::span<const T>(otherwise) : given;
}

/// Beyond it sums of products would overflow, and nothing costs so much.
constexpr double kLargest = 1e12;
/// Of a texel: a map's bytes must be a whole number of 64 bits.
constexpr double kMaxBytes = 1e6;
constexpr double kMaxPower = 100.0;

bool is_limit(double value) noexcept {
  return value >= 0.0 && value <= kLargest;
}

std::array<double, 7> all_of(const DrawingCosts& costs) noexcept {
  return {costs.per_frame,           costs.per_map,          costs.per_megatexel,
          costs.per_kilodraw,        costs.per_megatriangle, costs.per_megatexel_covered,
          costs.per_megatexel_tested};
}

/// Costs of maps, and of pages.
std::array<const TechniqueCosts*, 2> kinds_of(const CostModel& costs) noexcept {
  return {&costs, &costs.pages};
}

/// The different kernels of filters.
class Kernels {
 public:
  explicit Kernels(const CostModel& costs) noexcept {
    for (const TechniqueCosts* const kind : kinds_of(costs))
      for (const FilterCost& f : kind->filters) add(f.kernel_texels);
  }
  [[nodiscard]] bool too_many() const noexcept { return too_many_; }
  [[nodiscard]] std::size_t number_of(double texels) const noexcept {
    return static_cast<std::size_t>(std::find(texels_.begin(), texels_.begin() + count_, texels) -
                                    texels_.begin());
  }

 private:
  void add(double texels) noexcept {
    if (number_of(texels) < count_) return;
    too_many_ = too_many_ || count_ == kMaxKernels;
    if (!too_many_) texels_[count_++] = texels;
  }

  std::array<double, kMaxKernels> texels_{};
  std::size_t count_ = 0;
  bool too_many_ = false;
};

bool are_costs(std::span<const FilterCost> filters) noexcept {
  return std::all_of(filters.begin(), filters.end(), [](const FilterCost& f) {
    return is_limit(f.prefilter_ms_per_map) && is_limit(f.prefilter_ms_per_megatexel) &&
           is_limit(f.lookup_ms_per_megapixel) && is_limit(f.bytes_per_texel) &&
           f.bytes_per_texel <= kMaxBytes && is_limit(f.error_ratio) && f.error_ratio > 0.0 &&
           f.error_power >= 0.0 && f.error_power <= kMaxPower && f.kernel_texels >= 0.0 &&
           f.kernel_texels <= kMaxKernelTexels && is_limit(f.extent.texels) && is_limit(f.extent.world);
  });
}

/// How far the filter reaches in a map, or in what a page serves, of so many texels along each side: what
/// small ones cannot spare is cut.
FilterExtent extent_within(const FilterCost& filter, int side_texels) noexcept {
  return {std::min(filter.extent.texels, 0.25 * side_texels), filter.extent.world};
}

/// Calls `add` with the technique and the first filter of each extent, until it returns false; returns
/// whether none did.
template <class Add>
bool add_each_extent(std::span<const FilterCost> filters, Technique t, const Add& add) noexcept {
  for (auto filter = filters.begin(); filter != filters.end(); ++filter) {
    const auto alike = [&](const FilterCost& other) { return other.extent == filter->extent; };
    if (std::find_if(filters.begin(), filter, alike) != filter) continue;
    t.filter = static_cast<int>(filter - filters.begin());
    if (!add(t)) return false;
  }
  return true;
}

std::string_view broken(const Budget& budget, const CostModel& costs, const TechniqueSet& among) noexcept {
  if (budget.texels < 0 || budget.bytes < 0 || !is_limit(budget.milliseconds) ||
      !is_limit(budget.target_error) || !is_limit(budget.alike))
    return "budget";
  for (const TechniqueCosts* const kind : kinds_of(costs))
    for (const double cost : all_of(kind->drawing))
      if (!is_limit(cost)) return "cost_model";
  if (costs.filters.empty() || !are_costs(costs.filters)) return "cost_model.filters";
  const bool no_filter = costs.pages.filters.empty() && !among.pages.options.empty();
  if (no_filter || !are_costs(costs.pages.filters)) return "cost_model.pages.filters";
  if (Kernels(costs).too_many()) return "cost_model.filters";
  const bool sizes = std::all_of(among.map_sizes.begin(), among.map_sizes.end(),
                                 [](int size) { return size >= kLeastMapSize && size <= kMaxMapSize; });
  return sizes ? std::string_view() : "map_sizes";
}

class Choosing {
 public:
  Choosing(const Camera& camera, const CostModel& costs) noexcept
      : costs_(costs),
        kernels_(costs),
        megapixels_(static_cast<double>(camera.width) * camera.height / kMega) {
    for (const TechniqueCosts* const kind : kinds_of(costs)) {
      for (const double cost : all_of(kind->drawing)) any_time_ = any_time_ || cost > 0.0;
      for (const FilterCost& f : kind->filters)
        any_time_ = any_time_ || f.prefilter_ms_per_map > 0.0 || f.prefilter_ms_per_megatexel > 0.0 ||
                    f.lookup_ms_per_megapixel > 0.0;
    }
  }

  [[nodiscard]] bool full() const noexcept { return count_ == all_.size(); }
  /// `plan`: of maps or of pages.
  template <class Plan>
  void add(const Technique& technique, const Plan& plan, const ShadowPicture& shadow,
           const PlanWork& work) noexcept {
    Planned& planned = all_[count_++];
    planned.technique = technique;
    planned.work = work;
    constexpr double kNotCounted = -1.0;
    planned.wrong.fill(kNotCounted);
    each_filter(planned, [&](std::size_t filter) {
      ++tried_;
      const double texels = costs_of(technique).filters[filter].kernel_texels;
      double& wrong = planned.wrong[kernels_.number_of(texels)];
      if (wrong == kNotCounted) wrong = expected_error(plan, shadow, texels, pixels_between(shadow)).share();
    });
  }
  [[nodiscard]] int tried() const noexcept { return static_cast<int>(tried_); }

  [[nodiscard]] double cost(const Technique& t) const noexcept {
    return any_time_ ? t.milliseconds : static_cast<double>(t.texels);
  }

  /// How far a technique is beyond the limits: 0 within all of them, else the largest share of excess.
  [[nodiscard]] static double excess(const Technique& t, const Budget& budget) noexcept {
    double most = 1.0;
    const auto limit = [&](double value, double allowed) {
      if (allowed > 0.0) most = std::max(most, value / allowed);
    };
    limit(static_cast<double>(t.texels), static_cast<double>(budget.texels));
    limit(static_cast<double>(t.bytes), static_cast<double>(budget.bytes));
    limit(t.milliseconds, budget.milliseconds);
    limit(t.error, budget.target_error);
    return most - 1.0;
  }

  [[nodiscard]] Technique best(const Budget& budget, bool& met) const noexcept {
    Technique best;
    double least_excess = std::numeric_limits<double>::infinity();
    each([&](const Technique& t) {
      const double over = excess(t, budget);
      const bool better = budget.target_error > 0.0 ? less(cost(t), t.error, cost(best), best.error)
                                                    : less(t.error, cost(t), best.error, cost(best));
      if (best.map_size != 0 && (over > least_excess || (over == least_excess && !better))) return;
      best = t;
      least_excess = over;
    });
    met = least_excess == 0.0;
    if (budget.target_error > 0.0 || !met) return best;
    const double enough = best.error * (1.0 + budget.alike);
    each([&](const Technique& t) {
      if (t.error <= enough && excess(t, budget) == 0.0 && less(cost(t), t.error, cost(best), best.error))
        best = t;
    });
    return best;
  }

  /// The least error for a fifth less cost; none where it costs nothing.
  [[nodiscard]] Technique cheaper_than(const Technique& chosen) const noexcept {
    Technique found;
    if (!(cost(chosen) > 0.0)) return found;
    each([&](const Technique& t) {
      if (cost(t) > kTrade * cost(chosen)) return;
      if (found.map_size == 0 || less(t.error, cost(t), found.error, cost(found))) found = t;
    });
    return found;
  }
  /// The least cost for a fifth less error; none where it has none.
  [[nodiscard]] Technique better_than(const Technique& chosen) const noexcept {
    constexpr double kNone = 1e-12;  // sums of shares are rounded
    Technique found;
    if (!(chosen.error > kNone)) return found;
    each([&](const Technique& t) {
      if (t.error > kTrade * chosen.error) return;
      if (found.map_size == 0 || less(cost(t), t.error, cost(found), found.error)) found = t;
    });
    return found;
  }

 private:
  static bool less(double a, double tie_a, double b, double tie_b) noexcept {
    return a < b || (a == b && tie_a < tie_b);
  }

  [[nodiscard]] const TechniqueCosts& costs_of(const Technique& t) const noexcept {
    return t.pages < 0 ? costs_ : costs_.pages;
  }

  [[nodiscard]] Technique priced(const Planned& planned, std::size_t filter) const noexcept {
    Technique t = planned.technique;
    const TechniqueCosts& costs = costs_of(t);
    const FilterCost& f = costs.filters[filter];
    t.filter = static_cast<int>(filter);
    const double wrong = planned.wrong[kernels_.number_of(f.kernel_texels)];
    // Nothing has no logarithm.
    const bool has_power = f.error_power != 1.0 && wrong > 0.0;
    const double power = has_power ? elementary::pow(wrong, f.error_power) : wrong;
    t.error = std::min(f.error_ratio * power, 1.0);
    t.bytes = static_cast<std::int64_t>(std::llround(static_cast<double>(t.texels) * f.bytes_per_texel));
    t.milliseconds = predicted_ms(costs.drawing, f, planned.work, megapixels_);
    return t;
  }

  template <class Visit>
  void each(Visit&& visit) const noexcept {
    for (std::size_t i = 0; i < count_; ++i)
      each_filter(all_[i], [&](std::size_t filter) { visit(priced(all_[i], filter)); });
  }
  /// The filters whose extent the plan has.
  template <class Visit>
  void each_filter(const Planned& planned, Visit&& visit) const noexcept {
    const std::span<const FilterCost> filters = costs_of(planned.technique).filters;
    const FilterExtent& extent = filters[static_cast<std::size_t>(planned.technique.filter)].extent;
    for (std::size_t filter = 0; filter < filters.size(); ++filter)
      if (filters[filter].extent == extent) visit(filter);
  }

  const CostModel& costs_;
  Kernels kernels_;
  double megapixels_;
  bool any_time_ = false;
  std::array<Planned, TechniqueSet::kMost> all_;
  std::size_t count_ = 0, tried_ = 0;
};

PlanOptions options_of(const PlanOptions& base, const Technique& t, const FilterCost& filter) noexcept {
  PlanOptions options = base;
  options.warp.warp = t.warp;
  options.split.scheme = t.split;
  options.cascades = t.cascades;
  options.resolution.max_size = t.map_size;
  options.resolution.texel_budget = 0;
  options.resolution.max_error = 0.0;
  // Sizes are what is chosen among.
  options.prune = base.prune.without(PruneRule::metric_resolution);
  options.filter = extent_within(filter, t.map_size);
  return options;
}

PageOptions options_of(const PageOptions& pages, const FilterCost& filter) noexcept {
  PageOptions options = pages;
  options.plan.filter = extent_within(filter, pages.page_texels);
  return options;
}

}  // namespace

int pixels_between(const ShadowPicture& shadow) noexcept {
  constexpr double kMostCounted = 65536.0;
  const double pixels = static_cast<double>(shadow.mask.size());
  return static_cast<int>(std::ceil(std::sqrt(std::max(pixels / kMostCounted, 1.0))));
}

double predicted_ms(const DrawingCosts& costs, const FilterCost& filter, const PlanWork& work,
                    double megapixels) noexcept {
  return costs.per_frame + costs.per_map * work.maps + costs.per_megatexel * work.megatexels +
         costs.per_kilodraw * work.kilodraws + costs.per_megatriangle * work.megatriangles +
         costs.per_megatexel_covered * work.megatexels_covered +
         costs.per_megatexel_tested * work.megatexels_tested + filter.prefilter_ms_per_map * work.maps +
         filter.prefilter_ms_per_megatexel * work.megatexels + filter.lookup_ms_per_megapixel * megapixels;
}

TechniqueChoice choose_technique(const View& view, const ShadowPicture& shadow, const Light& light,
                                 const SceneBounds& bounds, std::span<const CasterWork> casters,
                                 const TechniqueSet& among, const Budget& budget, const CostModel& costs,
                                 const PlanOptions& base) noexcept {
  TechniqueChoice choice;
  choice.invalid_field = broken(budget, costs, among);
  if (choice.invalid_field.empty() && !shadow.is_whole()) choice.invalid_field = "shadow";
  if (!choice.invalid_field.empty()) return choice;
  Choosing choosing(view.camera, costs);
  const auto fails = [&](const auto& plan) {
    choice.status = plan.status;
    choice.invalid_field = plan.invalid_field;
    return plan.status != PlanStatus::ok;
  };
  const PageSet& pages = among.pages;
  const auto paged = [&](const PageOptions& options) {
    View seen = view;
    seen.points_world = pages.points_world;
    seen.normals_world = {};
    const PageHistory history{nullptr, pages.feedback};
    return plan_pages(seen, light, bounds, options, pages.memory, &history);
  };
  const auto of_pages = [&](const Technique& t) {
    return options_of(pages.options[static_cast<std::size_t>(t.pages)],
                      costs.pages.filters[static_cast<std::size_t>(t.filter)]);
  };
  const auto add_pages = [&](Technique t) {
    if (choosing.full()) return true;
    const PagePlan plan = paged(of_pages(t));
    if (fails(plan)) return false;
    t.map_size = plan.slot_texels();
    t.texels = static_cast<std::int64_t>(plan.pages.size()) * t.map_size * t.map_size;
    choosing.add(t, plan, shadow, planned_work(plan, bounds, casters));
    return true;
  };
  for (int i = 0; static_cast<std::size_t>(i) < pages.options.size(); ++i) {
    Technique t{pages.options[static_cast<std::size_t>(i)].plan.warp.warp};
    t.pages = i;
    if (!add_each_extent(costs.pages.filters, t, add_pages)) return choice;
  }
  const bool positional = !std::holds_alternative<DirectionalLight>(light);
  const std::span<const int> cascades = given_or(among.cascades, kCascades);
  const auto of_maps = [&](const Technique& t) {
    return options_of(base, t, costs.filters[static_cast<std::size_t>(t.filter)]);
  };
  const auto add = [&](Technique t) {
    if (choosing.full()) return true;
    const ShadowPlan plan = make_plan(view, light, bounds, of_maps(t));
    if (fails(plan)) {
      choice.plan = plan;
      return false;
    }
    for (const ShadowMap& map : plan.maps()) t.texels += std::int64_t{map.width} * map.height;
    choosing.add(t, plan, shadow, planned_work(plan, bounds, casters));
    return true;
  };
  for (const Warp* warp : given_or(among.warps, kWarps)) {
    for (const SplitScheme split : given_or(among.splits, kSplits)) {
      for (const int count : positional ? cascades.first(1) : cascades) {
        for (const int size : given_or(among.map_sizes, kSizes)) {
          if (!add_each_extent(costs.filters, {warp, split, count, size}, add)) return choice;
        }
      }
    }
  }
  choice.chosen = choosing.best(budget, choice.met);
  choice.cheaper = choosing.cheaper_than(choice.chosen);
  choice.better = choosing.better_than(choice.chosen);
  choice.tried = choosing.tried();
  if (choice.chosen.pages >= 0) {
    const PageOptions options = of_pages(choice.chosen);
    choice.options = options.plan;
    choice.pages = paged(options);
    return choice;
  }
  choice.options = of_maps(choice.chosen);
  choice.plan = make_plan(view, light, bounds, choice.options);
  return choice;
}

}  // namespace gnomon
