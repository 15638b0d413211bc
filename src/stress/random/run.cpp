// Draws random cases, checks each, shrinks what fails, and sums up.
#include "run.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "draw.hpp"
#include "shrink.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

const Finding* find(const Verdict& verdict, std::string_view kind) {
  for (const Finding& f : verdict.findings) {
    if (f.kind == kind) return &f;
  }
  return nullptr;
}

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

/// Fails in the same way; what is no case any more does not.
bool still_fails(const Json& value, std::string_view kind) {
  try {
    return find(check_case(value), kind) != nullptr;
  } catch (const CaseError&) {
    return false;
  }
}

void shrink(const RandomOptions& options, KindFound& found) {
  const Json drawn = draw_case(options.seed, found.first);
  const Json small = shrink_case(drawn, [&](const Json& value) { return still_fails(value, found.kind); });
  found.case_file = small.dump(1) + "\n";
  const Verdict verdict = check_case(small);
  if (const Finding* f = find(verdict, found.kind)) found.text = f->text;
}

}  // namespace

RandomResult run_random(const RandomOptions& options, const std::function<void()>& step) {
  RandomResult result;
  std::map<std::string, std::vector<Timed>> times;
  for (const Kind& kind : all_kinds()) result.kinds.push_back({kind.name, 0, 0, 0.0, 0, {}, {}});
  for (long long i = 0; i < options.cases; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    const Json value = draw_case(options.seed, number);
    const Verdict verdict = check_case(value);
    result.counts.add(verdict.counts);
    times[sort_of(value)].push_back({verdict.plan_ms, number});
    for (const Finding& f : verdict.findings) {
      const auto found = std::find_if(result.kinds.begin(), result.kinds.end(),
                                      [&](const KindFound& k) { return k.kind == f.kind; });
      if (found == result.kinds.end()) continue;
      if (found->cases++ == 0) {
        found->first = number;
        found->text = f.text;
        found->case_file = value.dump(1) + "\n";
      }
      if (!(f.amount <= found->worst)) {
        found->worst = f.amount;
        found->worst_case = number;
      }
    }
    if (step) step();
  }
  std::erase_if(result.kinds, [](const KindFound& k) { return k.cases == 0; });
  if (options.shrink) {
    for (KindFound& found : result.kinds) shrink(options, found);
  }
  for (auto& [sort, all] : times) result.times.push_back(times_of(sort, all));
  return result;
}

std::string summary(const RandomOptions& options, const RandomResult& result) {
  std::ostringstream text;
  const Counts& c = result.counts;
  text << c.plans << " random cases, seed " << options.seed << ": " << c.seen_plans
       << " plans more with visible depths and points, " << c.pages << " pages, " << c.light_maps
       << " maps of many lights, " << c.maps << " maps, " << c.receivers << " receiver points, " << c.casters
       << " shadow rays, " << c.unmapped << " points without a map, " << c.measured << " metric points, "
       << c.warps << " warps against none\n";
  for (const PlanTimes& t : result.times) {
    text << "make_plan, " << t.sort << ": " << t.cases << " cases, median " << t.median_ms
         << " ms, 99th percentile " << t.p99_ms << " ms, worst " << t.worst_ms << " ms (case " << t.worst_case
         << ")\n";
  }
  for (const KindFound& k : result.kinds) {
    text << "fails: " << k.kind << ": " << k.cases << " cases, first " << k.first << ", worst " << k.worst
         << " (case " << k.worst_case << "): " << k.text << '\n';
  }
  if (result.kinds.empty()) text << "every plan keeps every promise\n";
  return text.str();
}

}  // namespace gnomon::stress
