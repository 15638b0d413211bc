// `gnomon calibrate`: what shadows cost on this machine, fitted to a sweep, and held against others.
#include <fmt/core.h>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "command.hpp"
#include "compare/compare.hpp"
#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/rows_file.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "planner_check.hpp"
#include "replanned.hpp"

namespace gnomon::tool {
namespace {

struct CalibrateRequest {
  std::vector<std::string> folders;  ///< with results.jsonl; empty: a sweep is measured first
  std::string model = "out/cost_model.json";
  bool check = false;  ///< the model is read and held against the folders, else fitted to them and written
  std::string out = "out/calibrate";  ///< of the sweep that is measured
  render::ContextKind context = render::ContextKind::automatic;
  bool json = false;
};

/// Pools with as many texels as maps of these sizes have, with each of the filters.
void add_pages(const std::vector<int>& sizes, int cascades, CompareRequest& request) {
  for (const TechniqueFilter& filter : request.filters) {
    for (const int size : sizes) {
      report::Technique technique{"none", "auto", "tight", filter.name, cascades, size};
      technique.pages = page_policies::resolution.name;
      technique.page_texels = 128;
      request.techniques.push_back(technique);
    }
  }
}

/// Measured where no folder is given: small, but with all that costs and errors may depend on.
std::vector<CompareRequest> own_sweep(const CalibrateRequest& request) {
  CompareRequest sun;
  sun.scenes = {"builtin:city", "builtin:fence", "builtin:hangar", "builtin:terrain", "builtin:trees"};
  sun.warps = read_warps("--warps", {"none", "optimal"});
  sun.filters = read_filters("--filters", {"hard", "pcf", "pcss", "vsm", "evsm4", "msm"});
  sun.cascades = {1, 3};
  sun.map_sizes = {256, 1024};
  sun.frames = 1;
  sun.rounds = 3;
  sun.width = 320;
  sun.height = 180;
  sun.out = request.out;
  sun.context = request.context;
  CompareRequest local = sun;
  local.filters = read_filters("--filters", {"hard", "pcf"});
  local.cascades = {1};
  add_pages({256, 1024}, 3, sun);
  add_pages({512, 1024}, 1, local);
  std::vector<CompareRequest> sweep{sun};
  for (const LightKind kind : {LightKind::spot, LightKind::point}) {
    sweep.push_back(local);
    sweep.back().light.kind = kind;
  }
  return sweep;
}

void print_costs(const report::StoredCosts& m, const char* unit) {
  const DrawingCosts& d = m.drawing;
  print_line(
      fmt::format("ms = {:.3f} + {:.3f} per {} + {:.3f} per million texels + {:.3f} per thousand draws + "
                  "{:.3f} per million triangles + {:.3f} per million texels covered + {:.3f} of them by "
                  "alpha-tested casters",
                  d.per_frame, d.per_map, unit, d.per_megatexel, d.per_kilodraw, d.per_megatriangle,
                  d.per_megatexel_covered, d.per_megatexel_tested));
  print_line(fmt::format(
      "\n| filter | prefilter ms per {} | per million texels | look-up ms per million pixels | "
      "bytes per texel | factor of the expected error | its power |\n|--|--:|--:|--:|--:|--:|--:|",
      unit));
  for (const auto& [name, c] : m.filters) {
    print_line(fmt::format("| {} | {:.3f} | {:.3f} | {:.2f} | {:.0f} | {:.3f} | {:.3f} |", name,
                           c.prefilter_ms_per_map, c.prefilter_ms_per_megatexel, c.lookup_ms_per_megapixel,
                           c.bytes_per_texel, c.error_ratio, c.error_power));
  }
  print_line(
      fmt::format("\nmean relative error of the fit: depth {:.0f} %, prefilter {:.0f} %, look-up {:.0f} %",
                  100.0 * m.depth_error, 100.0 * m.prefilter_error, 100.0 * m.lookup_error));
}

void print_model(const report::StoredCostModel& m, const std::string& file) {
  print_line("# " + m.machine);
  print_costs(m, "map");
  if (!m.pages.filters.empty()) {
    print_line("\n# pages");
    print_costs(m.pages, "page");
  }
  print_line("model: " + file);
}

int fit(const CalibrateRequest& request, const std::vector<report::Row>& rows, bool json) {
  std::vector<report::Observation> observations;
  for (const View& view : views_of(rows)) {
    const Replanned replanned(view);
    for (const report::Row& row : view.rows) observations.push_back(replanned.observe(row));
  }
  const report::Machine& machine = rows.front().machine;
  const report::StoredCostModel model =
      report::fit_costs(observations, machine.renderer + "; " + machine.cpu);
  const std::filesystem::path folder = std::filesystem::path(request.model).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  report::save_cost_model(model, request.model);
  if (json) {
    print_line(nlohmann::json{{"model", request.model}, {"rows", rows.size()}}.dump());
  } else {
    print_model(model, request.model);
  }
  return 0;
}

/// Prints what was fitted, or the planner's picks beside the measured front. Throws std::runtime_error.
int run_calibrate(const CalibrateRequest& request, bool json) {
  if (!request.check) check_file("--model", request.model);
  std::vector<std::string> folders = request.folders;
  if (folders.empty()) {
    if (request.check) throw std::runtime_error("--check: wants folders with results to be held against");
    if (std::filesystem::exists(std::filesystem::path(request.out) / report::kRowsFile))
      throw std::runtime_error(request.out + ": was measured already: gnomon calibrate " + request.out +
                               " fits to that; another --out measures again");
    (void)compare(own_sweep(request));
    folders.push_back(request.out);
  }
  std::vector<report::Row> rows;
  for (const std::string& folder : folders) {
    std::vector<std::string> warnings;
    const std::vector<report::Row> more = report::read_rows(folder, &warnings);
    for (const std::string& line : warnings) std::fprintf(stderr, "gnomon: warning: %s\n", line.c_str());
    rows.insert(rows.end(), more.begin(), more.end());
  }
  // The cost model is one of maps and pages that are drawn once.
  std::erase_if(rows, [](const report::Row& row) { return !row.technique.layer.empty(); });
  if (rows.empty()) throw std::runtime_error("no results to calibrate with");
  const int code = request.check ? check_planner(report::load_cost_model(request.model), rows, json)
                                 : fit(request, rows, json);
  flush_output();
  return code;
}

}  // namespace

std::function<int()> declare_calibrate(Arguments& arguments) {
  const auto request = std::make_shared<CalibrateRequest>();
  arguments.options = {
      {.name = "DIR",
       .target = &request->folders,
       .help = "folders with results.jsonl of gnomon compare; without any, a sweep is measured first",
       .completion = Completion::folders},
      {.name = "--model",
       .target = &request->model,
       .help = "the cost model: written, or read with --check",
       .completion = Completion::files},
      {.name = "--check",
       .target = &request->check,
       .help = "compare the model's choices with the measured results"},
      {.name = "--out",
       .target = &request->out,
       .help = "folder for the sweep that is measured first",
       .completion = Completion::folders},
      context_option(request->context, " of that sweep"),
      {.name = "--json", .target = &request->json, .help = "print a summary as one line of JSON"}};
  return [request] { return run_calibrate(*request, request->json); };
}

}  // namespace gnomon::tool
