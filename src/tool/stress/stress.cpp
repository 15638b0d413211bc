// `gnomon stress`: extreme cases and stiff axes, judged.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "command.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "rows.hpp"
#include "stress/random.hpp"
#ifdef GNOMON_STRESS_HAS_FILTERS
#include "filter_limits.hpp"
#endif
#ifdef GNOMON_STRESS_HAS_FRAMES
#include "stress/frames.hpp"
#endif

namespace gnomon::tool {
namespace {

namespace fs = std::filesystem;

struct StressRequest {
  std::vector<const stress::Axis*> axes;  ///< none, no cases, no filters: all axes and cases
  bool cases = false;
  bool filters = false;                                          ///< filters at their limits, drawn
  render::ContextKind context = render::ContextKind::automatic;  ///< of the filters and of frames
  int samples = 80;                                              ///< values per axis
  int scenes = 4;                                                ///< per value
  std::uint64_t seed = 1;
  std::string out;  ///< folder for stability.jsonl and stability.csv; empty: none
  bool json = false, csv = false;
  std::uint64_t random = 0;  ///< random cases; above 0: these alone, `out` is the folder for cases that fail
  std::uint64_t frames = 0;  ///< random frames, likewise; after the random cases where both are wanted
  std::vector<std::string> replay;  ///< case and frame files that are checked as random ones, alone
};

std::vector<std::string> axis_names() {
  std::vector<std::string> names{"all"};
  for (const stress::Axis& axis : stress::all_axes()) names.emplace_back(axis.name);
  return names;
}

std::vector<const stress::Axis*> all_axes() {
  std::vector<const stress::Axis*> axes;
  for (const stress::Axis& axis : stress::all_axes()) axes.push_back(&axis);
  return axes;
}

std::vector<const stress::Axis*> read_axes(const std::string& option, const std::vector<std::string>& names) {
  if (names == std::vector<std::string>{"all"}) return all_axes();
  std::vector<const stress::Axis*> axes;
  for (const std::string& name : names) {
    const stress::Axis* axis = stress::find_axis(name);
    if (axis == nullptr) refuse_name(option, name, axis_names());
    axes.push_back(axis);
  }
  return axes;
}

#ifdef GNOMON_STRESS_HAS_FILTERS
std::vector<stress::FilterRow> run_filter_limits(const StressRequest& request) {
  const std::unique_ptr<render::Context> context = render::create_context(request.context);
  long long steps = 0, done = 0;
  for (const stress::FilterStrain& strain : stress::filter_strains())
    steps += static_cast<long long>(strain.filters.size());
  Progress progress("gnomon stress --filters", steps);
  std::vector<stress::FilterRow> all;
  for (const stress::FilterStrain& strain : stress::filter_strains()) {
    const std::vector<stress::FilterRow> rows = stress::sweep_filters(strain, [&] { progress.set(++done); });
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}
#else
std::vector<stress::FilterRow> run_filter_limits(const StressRequest&) {
  throw std::runtime_error("--filters: this program was built without the renderer (GNOMON_RENDER=OFF)");
}
#endif

stress::Results run_all(const StressRequest& request, const std::vector<const stress::Axis*>& axes) {
  stress::Results results;
  long long steps = 0, done = 0;
  for (const stress::Axis* axis : axes) steps += static_cast<long long>(axis->values(request.samples).size());
  Progress progress("gnomon stress", steps);
  if (request.cases || (request.axes.empty() && !request.filters)) {
    for (const stress::ExtremeCase& extreme : stress::all_cases())
      results.cases.push_back(stress::run_case(extreme));
  }
  for (const stress::Axis* axis : axes) {
    const std::vector<stress::AxisRow> rows =
        stress::sweep(*axis, {request.samples, request.scenes, request.seed}, [&] { progress.set(++done); });
    results.axes.insert(results.axes.end(), rows.begin(), rows.end());
  }
  progress.clear();
  if (request.filters) results.filters = run_filter_limits(request);
  return results;
}

int run_frames(const StressRequest& request) {
#ifdef GNOMON_STRESS_HAS_FRAMES
  return run_frame_stress({request.frames, request.seed, request.out, request.context});
#else
  static_cast<void>(request);
  throw std::runtime_error("--frames: this program was built without the renderer, the tracer or the viewer");
#endif
}

/// Random cases or case files, and then random frames.
int run_net(const StressRequest& request) {
  if (!request.out.empty()) check_folder("--out", request.out);
  int failed = 0;
  if (request.random > 0 || !request.replay.empty())
    failed = run_random_stress({request.random, request.seed, request.out, request.replay, request.context});
  return request.frames > 0 ? std::max(failed, run_frames(request)) : failed;
}

/// Returns 1 where a case fails or a number is not finite, else 0.
int run_stress(const StressRequest& request) {
  if (request.random > 0 || !request.replay.empty() || request.frames > 0) return run_net(request);
  const bool everything = request.axes.empty() && !request.cases && !request.filters;
  const std::vector<const stress::Axis*> axes = everything ? all_axes() : request.axes;
  if (!request.out.empty()) make_folder("--out", request.out);
  const stress::Results results = run_all(request, axes);
  if (!request.out.empty()) {
    write_file(fs::path(request.out) / "stability.jsonl", stress::json_lines(results));
    write_file(fs::path(request.out) / "stability.csv", stress::csv(results));
  }
  std::string text = request.json  ? stress::json_lines(results)
                     : request.csv ? stress::csv(results)
                                   : stress::tables(results);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  print_line(text);
  flush_output();
  return results.all_hold() ? 0 : 1;
}

}  // namespace

std::function<int()> declare_stress(Arguments& arguments) {
  const auto request = std::make_shared<StressRequest>();
  const auto set_axes = [request](const std::string& option, const std::vector<std::string>& names) {
    request->axes = read_axes(option, names);
  };
  arguments.options = {
      {.name = "--axis",
       .target = ParsedWords{set_axes, {}},
       .help = "stress parameters to run, or all; without --cases only these",
       .names = axis_names()},
      {.name = "--cases",
       .target = &request->cases,
       .help = "run the extreme cases; without --axis only these"},
      {.name = "--filters",
       .target = &request->filters,
       .help = "compare filters at the limits of their formats, shader against double"},
      context_option(request->context, " of --filters and --frames"),
      {.name = "--samples",
       .target = &request->samples,
       .help = "approximate number of values per stress parameter",
       .range = {{2, 100'000}}},
      {.name = "--scenes",
       .target = &request->scenes,
       .help = "scenes per value: one plain scene and random ones",
       .range = {{1, 100'000}}},
      // Below the largest that fits: CLI11 takes what does not fit, and what is negative, for that one.
      {.name = "--seed",
       .target = &request->seed,
       .help = "seed of the random scenes, cases and frames",
       .range = {{0, static_cast<double>(std::uint64_t{1} << 62)}}},
      {.name = "--out",
       .target = &request->out,
       .help = "folder for stability.jsonl and stability.csv, or for cases and frames that fail",
       .completion = Completion::folders},
      {.name = "--random",
       .target = &request->random,
       .help = "check N random cases over all legal input, and nothing else",
       .range = {{1, 1e12}},
       .excludes = {"--axis", "--cases", "--filters"}},
      {.name = "--frames",
       .target = &request->frames,
       .help = "draw N random frames, check masks against exact rays, and nothing else",
       .range = {{1, 1e9}},
       .excludes = {"--axis", "--cases", "--filters"}},
      {.name = "--replay",
       .target = &request->replay,
       .help = "check these files of cases and frames as --random and --frames do, and nothing else",
       .completion = Completion::files,
       .excludes = {"--axis", "--cases", "--filters"}},
      {.name = "--json", .target = &request->json, .help = "print a JSON object per row"},
      {.name = "--csv", .target = &request->csv, .help = "print CSV", .excludes = {"--json"}}};
  arguments.footer =
      "Exit: 0 all cases hold; 1 a case fails, or a plan contains a value that is not finite; 2 bad input.";
  return [request] { return run_stress(*request); };
}

}  // namespace gnomon::tool
