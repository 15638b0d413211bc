// The `gnomon` program: its command line, and what becomes of an error.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "interrupt.hpp"
#include "output.hpp"
#include "plan.hpp"
#include "stress.hpp"
#include "timing.hpp"
#ifdef GNOMON_HAS_SCENE
#include "scenes.hpp"
#endif
#ifdef GNOMON_HAS_COMPARE
#include "calibrate.hpp"
#include "compare.hpp"
#include "doctor.hpp"
#include "filters.hpp"
#include "merge.hpp"
#endif

namespace gnomon::tool {
namespace {

constexpr int kBadInput = 2;
constexpr int kInternalFault = 1;

struct ScenesRequest {
  std::vector<std::string> write;  ///< empty, or a name and a file
  bool json = false;
};

#ifdef GNOMON_HAS_SCENE
int run_scenes(const ScenesRequest& request) {
  return request.write.empty() ? list_scenes(request.json) : write_scene(request.write[0], request.write[1]);
}
#else
int run_scenes(const ScenesRequest&) {
  throw std::runtime_error("scenes: this program was built without the scene library (GNOMON_SCENE=OFF)");
}
#endif

const std::string kVersion = std::string("gnomon ") + GNOMON_VERSION;

#ifdef GNOMON_HAS_COMPARE
/// What the commands about measuring were told.
struct MeasureRequests {
  CompareRequest compare;
  FiltersRequest filters;
  CalibrateRequest calibrate;
  std::vector<std::string> merge_folders, report_folders;
  std::string merge_out = "out/merged";
  bool json = false;
};

void add_compare(CLI::App& app, CompareRequest& request) {
  CLI::App* compare = app.add_subcommand("compare", "error against run time of a sweep over techniques");
  compare->set_version_flag("--version", kVersion);
  compare->option_defaults()->always_capture_default();
  compare->add_option("SCENE", request.scenes, "builtin:NAME or glTF files")->required();
  compare->add_option("--warps", request.warps, "names, or all; auto lets the plan choose");
  compare->add_option("--splits", request.splits,
                      "how receivers are divided: schemes of view depth, or partitions");
  compare->add_option("--fits", request.fits, "tight, stable");
  compare->add_option("--cascades", request.cascades, "maps along the view");
  compare->add_option("--filters", request.filters, "names, with their options where they have any, or all");
  compare->add_option("--map-sizes", request.map_sizes, "texels along each side of a map");
  compare->add_option("--frames", request.frames, "along the scene's flight")->check(CLI::Range(1, 100'000));
  compare->add_option("--rounds", request.rounds, "timings of each technique and frame")
      ->check(CLI::Range(1, 10'000));
  compare->add_option("--size", request.size, "of a frame, WIDTHxHEIGHT");
  compare->add_option("--out", request.out, "folder that results and report go to");
  compare->add_option("--shard", request.shard,
                      "I/N: only every N-th row from the I-th on; join with gnomon merge");
  compare->add_option("--context", request.context, "auto, osmesa or egl");
  compare->add_option("--light", request.light, "sun, or a spot or point light in the middle of the scene");
  compare->add_option("--light-elevation-deg", request.light_elevation_deg, "of the sun above the horizon")
      ->check(CLI::Range(0.1, 90.0));
  compare
      ->add_option("--light-azimuth-deg", request.light_azimuth_deg,
                   "where the sun stands: 0 over -Z, 90 over +X")
      ->check(CLI::Range(-360.0, 360.0));
  compare
      ->add_option("--map-memory-mib", request.map_memory_mib,
                   "MiB that a technique's maps may take together; larger ones are halved until they fit; "
                   "0: what there is")
      ->check(CLI::Range(0.0, 1e9));
  compare
      ->add_option("--max-triangles", request.max_triangles,
                   "scenes of more, over all instances, are refused; one takes up to 100 bytes")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  compare->add_flag("--resume", request.resume, "go on with the results in --out");
  compare->footer(compare_footer());
}

void add_filters(CLI::App& app, FiltersRequest& request) {
  CLI::App* filters = app.add_subcommand("filters", "list the shadow filters, what they cost, what they do");
  filters->set_version_flag("--version", kVersion);
  filters->option_defaults()->always_capture_default();
  CLI::Option* cost = filters->add_flag("--cost", request.cost, "time and memory against `hard`, as a table");
  filters->add_option("--gallery", request.gallery,
                      "write the papers' comparisons as pictures to this folder");
  CLI::Option* fit = filters->add_option(
      "--fit", request.fit,
      "what each filter could do without on the maps of this scene: builtin:NAME or a glTF file");
  filters
      ->add_option("--fit-bound", request.fit_bound,
                   "by how much its answers may then differ, in steps of 8 bits")
      ->check(CLI::Range(0.0, 255.0))
      ->needs(fit);
  filters
      ->add_option("--fit-exceptions", request.fit_exceptions,
                   "percent of the receivers tried that may differ by more")
      ->check(CLI::Range(0.0, 100.0))
      ->needs(fit);
  filters->add_option("--filters", request.filters,
                      "of the cost table and --fit: names with their options, or all");
  filters->add_option("--map-sizes", request.map_sizes, "of the cost table: texels along each side of a map")
      ->check(CLI::Range(kLeastMapSize, kMostMapSize))
      ->needs(cost);
  filters->add_option("--rounds", request.rounds, "of the cost table")
      ->check(CLI::Range(1, 1000))
      ->needs(cost);
  filters->add_option("--scene", request.scene,
                      "of the cost table and the last strip: builtin:NAME or a glTF file");
  filters->add_flag("--json", request.json, "list and cost table as JSON");
  filters->add_option("--context", request.context, "auto, osmesa or egl");
}

void add_calibrate(CLI::App& app, CalibrateRequest& request) {
  CLI::App* calibrate = app.add_subcommand("calibrate", "fit what shadows cost on this machine to a sweep");
  calibrate->option_defaults()->always_capture_default();
  calibrate->add_option("DIR", request.folders,
                        "folders with results.jsonl; none: a sweep is measured first");
  calibrate->add_option("--model", request.model, "the cost model, written, or read by --check");
  calibrate->add_flag("--check", request.check, "hold the model's picks against what the folders measured");
  calibrate->add_option("--out", request.out, "folder of the sweep that is measured first");
  calibrate->add_option("--context", request.context, "of that sweep: auto, osmesa or egl");
}

void add_measuring(CLI::App& app, MeasureRequests& requests) {
  add_compare(app, requests.compare);
  add_filters(app, requests.filters);
  add_calibrate(app, requests.calibrate);
  CLI::App* merge = app.add_subcommand("merge", "join the results of shards, and write their report");
  merge->add_option("DIR", requests.merge_folders, "folders with results.jsonl")->required();
  merge->add_option("--out", requests.merge_out, "folder that the whole goes to")->capture_default_str();
  CLI::App* report = app.add_subcommand("report", "write the report of results anew, without measuring");
  report->add_option("DIR", requests.report_folders, "folders with results.jsonl")->required();
  CLI::App* doctor = app.add_subcommand("doctor", "what works on this machine, and why something does not");
  for (CLI::App* command : {merge, report, doctor, app.get_subcommand("calibrate")})
    command->set_version_flag("--version", kVersion);
  for (const char* command : {"compare", "merge", "report", "doctor", "calibrate"})
    app.get_subcommand(command)->add_flag("--json", requests.json, "say what was done as one line of JSON");
}

int run_measuring(const CLI::App& app, const MeasureRequests& requests) {
  if (app.got_subcommand("compare")) return run_compare(requests.compare, requests.json);
  if (app.got_subcommand("filters")) return run_filters(requests.filters);
  if (app.got_subcommand("calibrate")) return run_calibrate(requests.calibrate, requests.json);
  if (app.got_subcommand("merge"))
    return run_merge(requests.merge_folders, requests.merge_out, requests.json);
  if (app.got_subcommand("report")) return run_report(requests.report_folders, requests.json);
  return run_doctor(requests.json);
}
#else
struct MeasureRequests {};
void add_measuring(CLI::App&, MeasureRequests&) {}
int run_measuring(const CLI::App&, const MeasureRequests&) {
  return 0;
}
#endif

CLI::App* add_plan(CLI::App& app, PlanRequest& request) {
  CLI::App* plan = app.add_subcommand("plan", "print the shadow plan of each case as one line of JSON");
  plan->set_version_flag("--version", kVersion);
  plan->add_option("CASE", request.files, "case files in JSON; - reads one case per line from standard input")
      ->required();
  plan->add_option("--repeat", request.repeats, "add \"plan_ns\": what N plans of each case took")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxRepeats));
  plan->add_flag("--logpsm", request.log_perspective,
                 "add \"logpsm\": the error of one logarithmic perspective map, in numbers only");
  plan->add_flag("--pretty", request.pretty, "indent, several lines per plan");
  // Every subcommand takes --json; a plan is nothing else.
  plan->add_flag_callback(
      "--json", [] {}, "print JSON (always so here)");
  plan->footer(
      "Plans come in the order of the files and lines. The first bad case stops the run; the plans before\n"
      "it are printed. An infinite error (a visible point that no map holds) is printed as null.\n"
      "--repeat times each plan alone, in nanoseconds of the steady clock, the reading of the clock\n"
      "included, after a warm-up that is dropped; \"allocations\" is the largest count of heap requests in\n"
      "one plan. Exit: 0 done, also where a case needs no map; 2 bad input, with one line that names what\n"
      "is wrong and where.");
  return plan;
}

CLI::App* add_scenes(CLI::App& app, ScenesRequest& request) {
  CLI::App* scenes = app.add_subcommand("scenes", "list the built-in scenes, or write one as glTF");
  scenes->set_version_flag("--version", kVersion);
  scenes->add_option("--write", request.write, "write the built-in scene NAME to FILE.glb")
      ->expected(2)
      ->type_name("NAME FILE.glb");
  scenes->add_flag("--json", request.json, "list as JSON");
  return scenes;
}

CLI::App* add_stress(CLI::App& app, StressRequest& request) {
  CLI::App* stress = app.add_subcommand(
      "stress", "extreme cases, and plans along stiff axes, held against exact arithmetic");
  stress->set_version_flag("--version", kVersion);
  stress->option_defaults()->always_capture_default();
  stress->add_option("--axis", request.axes, "names of axes, or all; alone, without the cases");
  stress->add_flag("--cases", request.cases, "the extreme cases; alone, without the axes");
  stress->add_flag("--filters", request.filters,
                   "filters where formats run out, shader against double; alone, only these");
  stress->add_option("--context", request.context, "of --filters: auto, osmesa or egl");
  stress->add_option("--samples", request.samples, "values per axis, about")->check(CLI::Range(2, 100'000));
  stress->add_option("--scenes", request.scenes, "per value: a plain one and random ones")
      ->check(CLI::Range(1, 100'000));
  // Below the largest that fits: CLI11 takes what does not fit, and what is negative, for that one.
  stress->add_option("--seed", request.seed, "of the random scenes")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62));
  stress->add_option("--out", request.out,
                     "folder for stability.jsonl, which gnomon report shows, and stability.csv; of --random for "
                     "the cases that fail");
  stress->add_option("--random", request.random, "random cases over all legal input; alone, only these")
      ->check(CLI::Range(1LL, 1'000'000'000LL));
  stress->add_option("--replay", request.replay, "case files, checked as random cases are; alone, only these");
  CLI::Option* json = stress->add_flag("--json", request.json, "print a JSON object per row");
  stress->add_flag("--csv", request.csv, "print CSV")->excludes(json);
  stress->footer("Exit: 0 all cases hold; 1 one does not, or a plan holds what is no number; 2 bad input.");
  return stress;
}

int complain(const std::string& what, int code) {
  std::fprintf(stderr, "gnomon: %s\n", what.c_str());
  return code;
}

/// Of the first word on the command line. CLI11 would only say that a command is missing.
bool is_command(CLI::App& app, const std::string& word) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  return word.starts_with('-') || std::any_of(commands.begin(), commands.end(), [&](const CLI::App* command) {
           return command->get_name() == word;
         });
}

int run(int argc, char** argv) {
  CLI::App app("Turns a camera, a light and the bounds of a scene into the shadow maps worth drawing.",
               "gnomon");
  app.set_version_flag("--version", kVersion);
  app.require_subcommand(1);
  PlanRequest plan_request;
  ScenesRequest scenes_request;
  StressRequest stress_request;
  MeasureRequests measure_requests;
  const CLI::App* plan = add_plan(app, plan_request);
  const CLI::App* scenes = add_scenes(app, scenes_request);
  const CLI::App* stress = add_stress(app, stress_request);
  add_measuring(app, measure_requests);
  if (argc > 1 && !is_command(app, argv[1]))
    return complain("there is no command '" + one_line(argv[1], 80) + "' (see --help)", kBadInput);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success))
      return complain(one_line(error.what(), 400) + " (see --help)", kBadInput);
    app.exit(error);  // --help and --version
    std::cout.flush();
    if (!std::cout) throw std::runtime_error("standard output cannot be written");
    return 0;
  }
  if (plan->parsed()) return run_plan(plan_request);
  if (scenes->parsed()) return run_scenes(scenes_request);
  if (stress->parsed()) return run_stress(stress_request);
  return run_measuring(app, measure_requests);
}

}  // namespace
}  // namespace gnomon::tool

int main(int argc, char** argv) {
  using namespace gnomon::tool;
  // A reader that leaves early, and a file that may not grow, are errors to report, not signals to die of.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const Interrupted&) {
    return complain("interrupted", kInterrupted);
  } catch (const std::runtime_error& error) {  // the world outside: files, cases, pipes
    return complain(error.what(), kBadInput);
  } catch (const std::exception& error) {
    return complain(std::string("internal fault: ") + error.what(), kInternalFault);
  }
}
