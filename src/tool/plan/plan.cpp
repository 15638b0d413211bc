// `gnomon plan`: cases in, one shadow plan per line out.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "case_source.hpp"
#include "command.hpp"
#include "lights_plan.hpp"
#include "output.hpp"
#include "pages_plan.hpp"
#include "plan_json.hpp"
#include "progress.hpp"
#include "timing.hpp"

namespace gnomon::tool {
namespace {

struct PlanRequest {
  std::vector<std::string> files;  ///< "-" is standard input, one case per line
  int repeats = 0;                 ///< 0: no timing
  bool pretty = false;             ///< several lines per plan
  bool log_perspective = false;    ///< add what a logarithmic perspective map would come to
  bool json = true;                ///< every command takes --json; a plan is nothing else
};

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

/// The plan of one case, of maps, of pages or of many lights. Throws CaseError.
Json planned(const Case& input, const std::string& name) {
  const auto refuse = [&](std::string_view field) {
    throw CaseError(name + ": " + invalid_input_text(field));
  };
  if (!input.lights.empty()) {
    LightsPlanner planner(input);
    const LightPlan plan = planner.plan();
    if (plan.status == PlanStatus::invalid_input) throw CaseError(name + ": " + refusal_of(plan));
    return lights_json(plan, input);
  }
  if (!input.pages) {
    const ShadowPlan plan = make_plan(input.camera, input.light, input.bounds(), input.options);
    if (plan.status == PlanStatus::invalid_input) refuse(plan.invalid_field);
    return plan_json(plan, input);
  }
  PagePlanner planner(input);
  const PagePlan plan = planner.plan();
  if (plan.status == PlanStatus::invalid_input) refuse(plan.invalid_field);
  return pages_json(plan, input);
}

/// A file may hold an empty box on purpose, or its corners in the wrong order.
void warn_of_empty(const std::vector<Box>& boxes, const std::string& name) {
  const auto at = std::find_if(boxes.begin(), boxes.end(), [](const Box& box) { return box.empty(); });
  if (at == boxes.end()) return;
  warn(name + "[" + std::to_string(at - boxes.begin()) + "]: min is above max, so the box is empty");
}

/// Prints the plans in the order of the files and lines. Stops at the first bad case, by std::runtime_error
/// that names it; the plans before it are printed by then.
int run_plan(const PlanRequest& request) {
  Progress progress("gnomon plan", steps_in_all(request));
  long long steps = 0;
  const auto plan_one = [&](const Case& input, const std::string& name) {
    warn_of_empty(input.receivers, name + ": receivers");
    warn_of_empty(input.casters, name + ": casters");
    Json result = planned(input, name);
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

}  // namespace

std::function<int()> declare_plan(Arguments& arguments) {
  const auto request = std::make_shared<PlanRequest>();
  arguments.options = {
      {.name = "CASE",
       .target = &request->files,
       .help = "JSON case files; - reads one case per line from standard input",
       .required = true,
       .completion = Completion::files},
      {.name = "--repeat",
       .target = &request->repeats,
       .help = "time N plans of each case: adds \"plan_ns\"",
       .word = "N",
       .range = {{1, kMaxRepeats}}},
      {.name = "--logpsm",
       .target = &request->log_perspective,
       .help = "add \"logpsm\": the aliasing error of one logarithmic perspective map"},
      {.name = "--pretty", .target = &request->pretty, .help = "indent the JSON"},
      {.name = "--json", .target = &request->json, .help = "print JSON; this is always the case"}};
  arguments.footer =
      "Plans are printed in the order of files and lines. The first bad case stops the run; the plans before "
      "it are printed. An infinite error (a visible point that no map covers) is printed as null.\n\n"
      "A case with options.pages is planned in pages: \"levels\", \"page_texels\" and \"pages\" ([level, "
      "column, "
      "row]) in place of \"maps\". \"seen\" lists the visible points, as [x, y, z] or with a normal behind; "
      "without it the receivers' boxes are sampled.\n\n"
      "A case with \"lights\", a list in place of \"light\", is planned as one pool: size, places, share of "
      "the "
      "picture and error of each light's maps, or the reason why it has none. options.lights sets the "
      "pool.\n\n"
      "--repeat times each plan separately after a warm-up, in nanoseconds, including the reading of the "
      "clock. \"allocations\" is the largest number of heap allocations in one plan.\n\n"
      "Exit: 0 success, even if a case needs no map; 2 bad input, with one line that names the file and key.";
  return [request] { return run_plan(*request); };
}

}  // namespace gnomon::tool
