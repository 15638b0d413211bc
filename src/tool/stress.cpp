// `gnomon stress`: extreme cases and stiff axes, judged.
#include "stress.hpp"

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "output.hpp"
#include "progress.hpp"
#include "random_stress.hpp"
#include "rows.hpp"
#ifdef GNOMON_STRESS_HAS_FILTERS
#include "filter_limits.hpp"
#include "offscreen_context.hpp"
#endif

namespace gnomon::tool {
namespace {

namespace fs = std::filesystem;

std::vector<const stress::Axis*> axes_of(const StressRequest& request) {
  std::vector<const stress::Axis*> axes;
  const bool everything = request.axes.empty() && !request.cases && !request.filters;
  const bool all = everything || (request.axes.size() == 1 && request.axes[0] == "all");
  if (all) {
    for (const stress::Axis& axis : stress::all_axes()) axes.push_back(&axis);
    return axes;
  }
  for (const std::string& name : request.axes) {
    const stress::Axis* axis = stress::find_axis(name);
    if (axis == nullptr) {
      std::string known;
      for (const stress::Axis& a : stress::all_axes()) known += " " + std::string(a.name);
      throw std::runtime_error("--axis: there is no axis of that name; there are:" + known);
    }
    axes.push_back(axis);
  }
  return axes;
}

#ifdef GNOMON_STRESS_HAS_FILTERS
std::vector<stress::FilterRow> run_filter_limits(const StressRequest& request) {
  const std::unique_ptr<render::Context> context = render::create_context(offscreen_context(request.context));
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

}  // namespace

int run_stress(const StressRequest& request) {
  if (request.random > 0 || !request.replay.empty()) return run_random_stress(request);
  const std::vector<const stress::Axis*> axes = axes_of(request);
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

}  // namespace gnomon::tool
