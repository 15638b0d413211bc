// `gnomon plan`: cases in, one shadow plan per line out.
#include "plan.hpp"

#include <algorithm>

#include "case_source.hpp"
#include "output.hpp"
#include "plan_json.hpp"
#include "progress.hpp"
#include "timing.hpp"

namespace gnomon::tool {
namespace {

long long steps_in_all(const PlanRequest& request) {
  const bool reads_lines = std::find(request.files.begin(), request.files.end(), "-") != request.files.end();
  if (reads_lines) return 0;
  return static_cast<long long>(request.files.size()) * std::max(request.repeats, 1);
}

Json timing_json(const PlanTiming& timing) {
  return {{"min", timing.min_ns},
          {"median", timing.median_ns},
          {"p99", timing.p99_ns},
          {"allocations", timing.allocations}};
}

}  // namespace

int run_plan(const PlanRequest& request) {
  Progress progress("gnomon plan", steps_in_all(request));
  long long steps = 0;
  const auto plan_one = [&](const Case& input, const std::string& name) {
    const ShadowPlan plan = make_plan(input.camera, input.light, input.bounds(), input.options);
    if (plan.status == PlanStatus::invalid_input)
      throw CaseError(name + ": " + invalid_input_text(plan.invalid_field));
    Json result = plan_json(plan, input);
    if (request.log_perspective) result["logpsm"] = log_perspective_json(input);
    if (request.repeats > 0)
      result["plan_ns"] = timing_json(time_plan(input, request.repeats, progress, steps));
    steps += std::max(request.repeats, 1);
    progress.clear();
    print_line(request.pretty ? pretty_text(result) : result.dump());
    progress.set(steps);
  };
  for (const std::string& file : request.files) {
    for_each_case(file, [&](const Case& input, const std::string& name) {
      plan_one(input, name);
      // Whoever feeds cases through a pipe may wait for each answer before sending the next.
      if (file == "-") flush_output();
    });
  }
  flush_output();
  return 0;
}

}  // namespace gnomon::tool
