// The cost of a plan: time and heap allocations of make_plan(), plan_pages() or plan_lights() over many runs
// of one case.
#include "timing.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "allocations.hpp"
#include "lights_plan.hpp"
#include "pages_plan.hpp"
#include "progress.hpp"

namespace gnomon::tool {
namespace {

// Enough to fill the caches and the branch predictor; a plan takes microseconds.
constexpr int kWarmUpRuns = 100;
// Between looks at the bar: a millisecond or more of work.
constexpr int kRunsPerProgress = 1024;

/// Smallest sample that at least `share` of all samples do not exceed (nearest rank). Reorders them.
std::int64_t percentile(std::vector<std::int64_t>& samples, double share) {
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(samples.size() - 1) + 0.5);
  const auto nth = samples.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(samples.begin(), nth, samples.end());
  return *nth;
}

/// Times `plan` over and over.
template <typename Plan>
PlanTiming time_runs(int repeats, Progress& progress, long long steps_before, Plan&& plan) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::int64_t> samples(static_cast<std::size_t>(repeats));
  PlanTiming timing;
  const int warm_up = std::min(repeats, kWarmUpRuns);
  for (int run = -warm_up; run < repeats; ++run) {
    const std::uint64_t allocations_before = allocation_count();
    const Clock::time_point begin = Clock::now();
    plan();
    const Clock::time_point end = Clock::now();
    timing.allocations = std::max(timing.allocations, allocation_count() - allocations_before);
    if (run < 0) continue;
    samples[static_cast<std::size_t>(run)] =
        std::chrono::duration_cast<std::chrono::nanoseconds>(end - begin).count();
    if (run % kRunsPerProgress == 0) progress.set(steps_before + run);
  }
  timing.min_ns = *std::min_element(samples.begin(), samples.end());
  timing.median_ns = percentile(samples, 0.5);
  timing.p99_ns = percentile(samples, 0.99);
  return timing;
}

}  // namespace

PlanTiming time_plan(const Case& input, int repeats, Progress& progress, long long steps_before) {
  if (!input.lights.empty()) {
    LightsPlanner planner(input);
    LightPlan plan;
    return time_runs(repeats, progress, steps_before, [&] { plan = planner.plan(); });
  }
  if (input.pages) {
    PagePlanner planner(input);
    PagePlan plan;
    return time_runs(repeats, progress, steps_before, [&] { plan = planner.plan(); });
  }
  const SceneBounds bounds = input.bounds();
  ShadowPlan plan;
  return time_runs(repeats, progress, steps_before,
                   [&] { plan = make_plan(input.camera, input.light, bounds, input.options); });
}

}  // namespace gnomon::tool
