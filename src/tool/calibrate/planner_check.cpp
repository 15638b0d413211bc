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

/// Half side of the box of comparisons that the filter averages, texels.
double averaged_texels(const render::FilterSettings& filter) noexcept {
  const render::FilterInfo& info = filter.filter->info;
  const bool averages = info.has_kernel && info.penumbra_radius_world == nullptr;
  return averages && filter.unit == render::KernelUnit::texels ? filter.radius + 0.5 : 0.0;
}

double wrong_pixels(const report::Row& row) noexcept {
  return row.errors.false_lit + row.errors.false_shadow;
}

/// What a technique costs and errs in one view. Measured times scatter; the model's leave the errors alone.
struct PricedTechnique {
  double ms, model_ms, error;  ///< the error is measured: a share of the pixels
};

/// By how much both cost and error of `pick` exceed those of the technique that beats it most; 1: none does.
double beyond_front(const PricedTechnique& pick, const std::vector<PricedTechnique>& all,
                    double PricedTechnique::*cost) noexcept {
  double most = 1.0;
  for (const PricedTechnique& other : all)
    most = std::max(most, std::min(pick.*cost / other.*cost, pick.error / other.error));
  return most;
}

struct Pick {
  Budget budget;
  std::string technique;
  PricedTechnique priced;
  double expected = 0.0;                       ///< by the planner, a share of the pixels
  double beyond = 1.0, beyond_by_model = 1.0;  ///< the front, by measured times and by the model's
};

/// Budgets and errors at equal steps of their logarithm between the ends of what was measured.
std::vector<Budget> asked(const std::vector<PricedTechnique>& all) {
  double least_ms = 1e300, most_ms = 0.0, least_error = 1e300, most_error = 0.0;
  for (const PricedTechnique& one : all) {
    least_ms = std::min(least_ms, one.ms);
    most_ms = std::max(most_ms, one.ms);
    least_error = std::min(least_error, one.error);
    most_error = std::max(most_error, one.error);
  }
  std::vector<Budget> budgets;
  for (const double share : {0.25, 0.5, 0.75}) {
    Budget by_time, by_error;
    by_time.milliseconds = least_ms * std::pow(most_ms / least_ms, share);
    by_error.target_error = least_error * std::pow(most_error / least_error, share);
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
                              : fmt::format("{:.2f} %", 100.0 * b.target_error);
}

std::vector<Pick> picks_of(const View& view, const report::StoredCostModel& model) {
  const Replanned replanned(view);
  std::set<std::string> filters;
  std::vector<PricedTechnique> all;
  for (const report::Row& row : view.rows) {
    filters.insert(row.technique.filter);
    // A technique without a wrong pixel is not infinitely better than one with a single one.
    const double least = 0.5 / static_cast<double>(std::max<std::uint64_t>(row.errors.pixels, 1));
    all.push_back({row.times.total_ms.median, report::predicted_ms(model, replanned.observe(row)),
                   std::max(wrong_pixels(row), least)});
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
    const PricedTechnique& priced = all[static_cast<std::size_t>(row - view.rows.begin())];
    picks.push_back({budget, row->technique.name(), priced, choice.chosen.error,
                     beyond_front(priced, all, &PricedTechnique::ms),
                     beyond_front(priced, all, &PricedTechnique::model_ms)});
  }
  return picks;
}

}  // namespace

std::vector<View> views_of(const std::vector<report::Row>& rows) {
  std::map<std::string, std::size_t> known;
  std::vector<View> views;
  for (const report::Row& row : rows) {
    if (row.technique.filter.starts_with(kIrregular)) continue;  // no model predicts it: it reads no map
    if (row.technique.is_given()) continue;                      // planned by others
    if (!row.times.known()) continue;                            // of a frame that was not timed
    // Rows do not hold what the files of a path and of shadow proxies do.
    if (!row.camera.empty() || !row.edits.empty()) continue;
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
      shadow_(trace::seen_shadow(trace::Tracer(scene_.scene()), camera_, scene_.light())) {}

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
  o.kernel_texels = averaged_texels(entry.filter);
  o.expected = expected_error(plan, shadow_.picture(), o.kernel_texels).share();
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
  return choose_technique(camera_, shadow_.picture(), scene_.light(), scene_.bounds(), scene_.work(),
                          {warps, splits, cascades, sizes}, budget, costs,
                          sweep_entry(view.rows.front().technique).plan);
}

int check_planner(const report::StoredCostModel& model, const std::vector<report::Row>& rows, bool json) {
  int picks = 0, hits = 0, hits_by_model = 0;
  nlohmann::json list = nlohmann::json::array();
  if (!json)
    print_line(
        "| view | request | pick | ms, by the model | ms | misclassified pixels, expected | misclassified "
        "pixels | beyond the front | beyond it by the model's ms |\n|--|--|--|--:|--:|--:|--:|--:|--:|");
  for (const View& view : views_of(rows)) {
    for (const Pick& p : picks_of(view, model)) {
      const auto& [ms, model_ms, error] = p.priced;
      ++picks;
      hits += p.beyond <= kHit ? 1 : 0;
      hits_by_model += p.beyond_by_model <= kHit ? 1 : 0;
      if (json) {
        list.push_back({{"view", view.name},
                        {"asked", asked_text(p.budget)},
                        {"pick", p.technique},
                        {"predicted_ms", model_ms},
                        {"ms", ms},
                        {"expected_wrong", p.expected},
                        {"wrong", error},
                        {"beyond_front", p.beyond},
                        {"beyond_front_by_model", p.beyond_by_model}});
      } else {
        print_line(fmt::format("| {} | {} | {} | {:.1f} | {:.1f} | {:.2f} % | {:.2f} % | {:.2f} | {:.2f} |",
                               view.name, asked_text(p.budget), p.technique, model_ms, ms, 100.0 * p.expected,
                               100.0 * error, p.beyond, p.beyond_by_model));
      }
    }
  }
  if (json) {
    print_line(nlohmann::json{{"picks", list}}.dump());
  } else {
    print_line(
        fmt::format("\nwithin 10 % of the front of measured misclassified pixels: {} of {} picks by measured "
                    "times, {} by "
                    "the model's",
                    hits, picks, hits_by_model));
  }
  return 0;
}

}  // namespace gnomon::tool
