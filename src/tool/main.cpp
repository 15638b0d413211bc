// The `gnomon` program: its command line, and what becomes of an error.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "output.hpp"
#include "plan.hpp"
#include "timing.hpp"
#ifdef GNOMON_HAS_SCENE
#include "scenes.hpp"
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

CLI::App* add_plan(CLI::App& app, PlanRequest& request) {
  CLI::App* plan = app.add_subcommand("plan", "print the shadow plan of each case as one line of JSON");
  plan->set_version_flag("--version", kVersion);
  plan->add_option("CASE", request.files, "case files in JSON; - reads one case per line from standard input")
      ->required();
  plan->add_option("--repeat", request.repeats, "add \"plan_ns\": what N plans of each case took")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxRepeats));
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

int complain(const std::string& what, int code) {
  std::fprintf(stderr, "gnomon: %s\n", what.c_str());
  return code;
}

int run(int argc, char** argv) {
  CLI::App app("Turns a camera, a light and the bounds of a scene into the shadow maps worth drawing.",
               "gnomon");
  app.set_version_flag("--version", kVersion);
  app.require_subcommand(1);
  PlanRequest plan_request;
  ScenesRequest scenes_request;
  const CLI::App* plan = add_plan(app, plan_request);
  add_scenes(app, scenes_request);
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
  return plan->parsed() ? run_plan(plan_request) : run_scenes(scenes_request);
}

}  // namespace
}  // namespace gnomon::tool

int main(int argc, char** argv) {
  using namespace gnomon::tool;
  // A reader that leaves early is an error to report, not a signal to die of.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const std::runtime_error& error) {  // the world outside: files, cases, pipes
    return complain(error.what(), kBadInput);
  } catch (const std::exception& error) {
    return complain(std::string("internal fault: ") + error.what(), kInternalFault);
  }
}
