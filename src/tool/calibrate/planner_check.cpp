// What the planner predicts and picks, beside what a sweep measured.
#include "planner_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "compare/sweep.hpp"
#include "gnomon/measure.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

constexpr double kMega = 1e6;
/// What counts as on the front.
constexpr double kHit = 1.1;

LightPlacement light_of(const report::Row& row) {
  LightPlacement light{LightKind::sun, row.light_elevation_deg, row.light_azimuth_deg};
  if (!light_kind_from_name(row.light, light.kind))
    throw std::runtime_error("light '" + row.light + "': wants sun, spot or point");
  return light;
}

double wrong_pixels(const report::Row& row) noexcept {
  return row.errors.false_lit + row.errors.false_shadow;
}

/// What has been measured of a technique in one view.
struct PricedTechnique {
  double ms, error, m;
};

PricedTechnique measured(const report::Row& row) noexcept {
  // A technique without a wrong pixel is not infinitely better than one with a single one.
  const double least = 0.5 / static_cast<double>(std::max<std::uint64_t>(row.errors.pixels, 1));
  return {row.times.total_ms.median, std::max(wrong_pixels(row), least), row.aliasing.p95};
}

/// By how much both cost and error of `pick` exceed those of the technique that beats it most; 1: none does.
double beyond_front(const PricedTechnique& pick, const std::vector<PricedTechnique>& all,
                    double PricedTechnique::*error) noexcept {
  double most = 1.0;
  // Where neither has an error, or both have no end of it, they are alike.
  const auto ratio = [&](const PricedTechnique& other) {
    return pick.*error == other.*error ? 1.0 : pick.*error / other.*error;
  };
  for (const PricedTechnique& other : all) most = std::max(most, std::min(pick.ms / other.ms, ratio(other)));
  return most;
}

struct Pick {
  Budget budget;
  std::string technique;
  PricedTechnique measured;
  double predicted_ms = 0.0, beyond_wrong = 1.0, beyond_m = 1.0;
};

/// Budgets and errors at equal steps of their logarithm between the ends of what was measured.
std::vector<Budget> asked(const std::vector<PricedTechnique>& all) {
  double least_ms = 1e300, most_ms = 0.0, least_m = 1e300, most_m = 0.0;
  for (const PricedTechnique& one : all) {
    least_ms = std::min(least_ms, one.ms);
    most_ms = std::max(most_ms, one.ms);
    if (one.m > 0.0) least_m = std::min(least_m, one.m);
    if (std::isfinite(one.m)) most_m = std::max(most_m, one.m);
  }
  std::vector<Budget> budgets;
  for (const double share : {0.25, 0.5, 0.75}) {
    Budget by_time, by_error;
    by_time.milliseconds = least_ms * std::pow(most_ms / least_ms, share);
    by_error.target_error = least_m * std::pow(most_m / least_m, share);
    budgets.push_back(by_time);
    budgets.push_back(by_error);
  }
  return budgets;
}

bool is_pick(const report::Technique& t, const TechniqueChoice& choice, std::string_view filter) {
  return t.warp == choice.chosen.warp->name && t.cascades == choice.chosen.cascades &&
         t.map_size == choice.chosen.map_size && t.filter == filter;
}

std::string asked_text(const Budget& b) {
  return b.milliseconds > 0.0 ? fmt::format("{:.1f} ms", b.milliseconds)
                              : fmt::format("m {:.2f}", b.target_error);
}

std::vector<Pick> picks_of(const View& view, const report::StoredCostModel& model) {
  const Replanned replanned(view);
  std::set<std::string> filters;
  std::vector<PricedTechnique> all;
  for (const report::Row& row : view.rows) {
    filters.insert(row.technique.filter);
    all.push_back(measured(row));
  }
  report::StoredCostModel known = model;
  std::erase_if(known.filters, [&](const auto& filter) { return !filters.contains(filter.name); });
  if (known.filters.empty())
    throw std::runtime_error("the cost model knows none of the filters of " + view.name);
  std::vector<FilterCost> storage;
  const CostModel costs = known.view(storage);
  std::vector<Pick> picks;
  for (const Budget& budget : asked(all)) {
    const TechniqueChoice choice = replanned.choose(view, budget, costs);
    if (choice.status != PlanStatus::ok) continue;  // nothing to choose: no maps
    const std::string_view filter = storage[static_cast<std::size_t>(choice.chosen.filter)].name;
    const auto row = std::find_if(view.rows.begin(), view.rows.end(),
                                  [&](const report::Row& r) { return is_pick(r.technique, choice, filter); });
    if (row == view.rows.end())
      throw std::runtime_error(view.name + ": the sweep is no full product, the pick was not measured");
    Pick pick{budget, row->technique.name(), measured(*row), choice.chosen.milliseconds};
    pick.beyond_wrong = beyond_front(pick.measured, all, &PricedTechnique::error);
    pick.beyond_m = beyond_front(pick.measured, all, &PricedTechnique::m);
    picks.push_back(pick);
  }
  return picks;
}

}  // namespace

std::vector<View> views_of(const std::vector<report::Row>& rows) {
  std::map<std::string, std::size_t> known;
  std::vector<View> views;
  for (const report::Row& row : rows) {
    if (row.technique.filter.starts_with(kIrregular)) continue;  // no model predicts it: it reads no map
    if (!row.camera.empty()) continue;                           // rows do not hold what the path's file does
    const std::string name =
        fmt::format("{} {}/{} {} {:g}/{:g} {}x{}", row.scene, row.frame + 1, row.frames, row.light,
                    row.light_elevation_deg, row.light_azimuth_deg, row.width, row.height);
    const auto [found, is_new] = known.try_emplace(name, views.size());
    if (is_new) views.push_back({name, {}});
    views[found->second].rows.push_back(row);
  }
  return views;
}

Replanned::Replanned(const View& view)
    : name_(view.name),
      scene_(view.rows.front().scene, light_of(view.rows.front())),
      camera_(scene_.camera(view.rows.front().frame, view.rows.front().frames, view.rows.front().width,
                            view.rows.front().height)),
      visible_(trace::seen_points(trace::Tracer(scene_.scene()), camera_, scene_.light())) {}

report::Observation Replanned::observe(const report::Row& row) const {
  const SweepEntry entry = sweep_entry(row.technique);
  const ShadowPlan plan = make_plan(camera_, scene_.light(), scene_.bounds(), entry.plan);
  report::Observation o;
  o.view = name_;
  o.filter = row.technique.filter;
  o.work = planned_work(plan, scene_.bounds(), scene_.work());
  o.megapixels = static_cast<double>(row.width) * row.height / kMega;
  o.bytes_per_texel = render::bytes_per_texel(entry.filter);
  o.frame_ms = row.times.plan_ns.median / kMega;
  o.depth_ms = row.times.depth_ms.median;
  o.prefilter_ms = row.times.prefilter_ms.median;
  o.lookup_ms = row.times.shade_ms.median;
  o.m = planned_error(plan, seen_view(), scene_.bounds());
  o.wrong = wrong_pixels(row);
  return o;
}

TechniqueChoice Replanned::choose(const View& view, const Budget& budget, const CostModel& costs) const {
  std::vector<const Warp*> warps;
  std::vector<SplitScheme> splits;
  std::vector<int> cascades, sizes;
  const auto once = [](auto& list, const auto& value) {
    if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
  };
  for (const report::Row& row : view.rows) {
    const SweepEntry entry = sweep_entry(row.technique);
    if (entry.plan.fit != Fit::tight || entry.plan.split.partition != Partition::view_depth ||
        entry.plan.warp.warp == nullptr || !entry.plan.warp.shape->affine)
      throw std::runtime_error(row.technique.name() +
                               ": the planner chooses among named warps with linear texels, split by depth");
    once(warps, entry.plan.warp.warp);
    once(splits, entry.plan.split.scheme);
    once(cascades, entry.plan.cascades);
    once(sizes, entry.plan.resolution.max_size);
  }
  if (splits.size() > 1) throw std::runtime_error(view.name + ": more than one kind of split");
  return choose_technique(seen_view(), scene_.light(), scene_.bounds(), scene_.work(),
                          {warps, splits, cascades, sizes}, budget, costs,
                          sweep_entry(view.rows.front().technique).plan);
}

int check_planner(const report::StoredCostModel& model, const std::vector<report::Row>& rows, bool json) {
  int picks = 0, hits_wrong = 0, hits_m = 0, views = 0, whole_wrong = 0, whole_m = 0;
  nlohmann::json list = nlohmann::json::array();
  if (!json)
    print_line(
        "| view | request | pick | ms, predicted | ms | misclassified pixels | beyond the front of "
        "misclassified pixels | "
        "m p95 | "
        "beyond the front of m |\n|--|--|--|--:|--:|--:|--:|--:|--:|");
  for (const View& view : views_of(rows)) {
    bool all_wrong = true, all_m = true;
    const std::vector<Pick> picked = picks_of(view, model);
    for (const Pick& p : picked) {
      ++picks;
      hits_wrong += p.beyond_wrong <= kHit ? 1 : 0;
      hits_m += p.beyond_m <= kHit ? 1 : 0;
      all_wrong = all_wrong && p.beyond_wrong <= kHit;
      all_m = all_m && p.beyond_m <= kHit;
      if (json) {
        list.push_back({{"view", view.name},
                        {"asked", asked_text(p.budget)},
                        {"pick", p.technique},
                        {"predicted_ms", p.predicted_ms},
                        {"ms", p.measured.ms},
                        {"wrong", p.measured.error},
                        {"beyond_wrong", p.beyond_wrong},
                        {"m_p95", p.measured.m},
                        {"beyond_m", p.beyond_m}});
      } else {
        print_line(fmt::format("| {} | {} | {} | {:.1f} | {:.1f} | {:.2f} % | {:.2f} | {:.2f} | {:.2f} |",
                               view.name, asked_text(p.budget), p.technique, p.predicted_ms, p.measured.ms,
                               100.0 * p.measured.error, p.beyond_wrong, p.measured.m, p.beyond_m));
      }
    }
    if (picked.empty()) continue;
    ++views;
    whole_wrong += all_wrong ? 1 : 0;
    whole_m += all_m ? 1 : 0;
  }
  if (json) {
    print_line(nlohmann::json{{"picks", list}}.dump());
  } else {
    print_line(
        fmt::format("\nwithin 10 % of the measured front, by misclassified pixels: {} of {} picks, {} of {} "
                    "views with all; "
                    "by m: {} of {} picks, {} of {} views",
                    hits_wrong, picks, whole_wrong, views, hits_m, picks, whole_m, views));
  }
  return 0;
}

}  // namespace gnomon::tool
