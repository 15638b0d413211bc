// Draws random cases, checks each, shrinks what fails, and sums up.
#include "run.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "draw.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

/// What a plan's time depends on.
std::string sort_of(const Json& value) {
  const std::size_t boxes = value.at("receivers").size() + value.at("casters").size();
  const Json& o = value.at("options");
  std::string sort = boxes > 500 ? "over 500 boxes" : boxes > 20 ? "21 to 500 boxes" : "up to 20 boxes";
  if (o.contains("target_m") || o.contains("texel_budget")) sort += ", target or budget";
  if (o.value("split", "") == "optimal") sort += ", optimal splits";
  return sort;
}

struct Timed {
  double ms;
  std::uint64_t number;
};

PlanTimes times_of(const std::string& sort, std::vector<Timed>& all) {
  std::sort(all.begin(), all.end(), [](const Timed& a, const Timed& b) { return a.ms < b.ms; });
  const auto at = [&](double share) {
    return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))].ms;
  };
  return {sort, static_cast<long long>(all.size()), at(0.5), at(0.99), all.back().ms, all.back().number};
}

}  // namespace

RandomResult run_random(const RandomOptions& options, const std::function<void()>& step) {
  RandomResult result;
  std::map<std::string, std::vector<Timed>> times;
  Failures failures(all_kinds());
  for (long long i = 0; i < options.cases; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    const Json value = draw_case(options.seed, number);
    const Verdict verdict = check_case(value);
    result.counts.add(verdict.counts);
    times[sort_of(value)].push_back({verdict.plan_ms, number});
    failures.add(verdict.findings, number, value);
    if (step) step();
  }
  constexpr int kMostTries = 1500;
  if (options.shrink)
    failures.shrink([](const Json& value) { return check_case(value).findings; }, kMostTries);
  result.kinds = failures.found();
  for (auto& [sort, all] : times) result.times.push_back(times_of(sort, all));
  return result;
}

std::string summary(const RandomOptions& options, const RandomResult& result) {
  std::ostringstream text;
  const Counts& c = result.counts;
  text << c.plans << " random cases, seed " << options.seed << ": " << c.seen_plans
       << " plans more with visible depths and points, " << c.view_plans << " of several views, " << c.pages
       << " pages, " << c.page_points << " points of pages, " << c.lights << " of many lights, "
       << c.light_maps << " maps of them, " << c.maps << " maps, " << c.receivers << " receiver points, "
       << c.casters << " shadow rays, " << c.unmapped << " points without a map, " << c.measured
       << " metric points, " << c.texels << " texels against the largest, " << c.warps
       << " warps against none\n";
  for (const PlanTimes& t : result.times) {
    text << "make_plan, " << t.sort << ": " << t.cases << " cases, median " << t.median_ms
         << " ms, 99th percentile " << t.p99_ms << " ms, worst " << t.worst_ms << " ms (case " << t.worst_case
         << ")\n";
  }
  text << failure_lines(result.kinds);
  if (result.kinds.empty()) text << "every plan keeps every promise\n";
  return text.str();
}

}  // namespace gnomon::stress
