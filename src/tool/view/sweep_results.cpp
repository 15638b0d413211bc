// The results of `gnomon compare` as points of error against time, and the settings that each stands for.
#include "sweep_results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "compare/sweep.hpp"
#include "gnomon/report/rows_file.hpp"
#include "summary.hpp"

namespace gnomon::tool::view {
namespace {

SceneResults gathered(const report::Summary& summary, std::size_t scene) {
  const std::size_t wrong = report::measure_index("wrong"), ratio = report::measure_index("ratio"),
                    ms = report::measure_index("total_ms");
  const std::vector<std::size_t> front = summary.front(scene, wrong, ratio);
  SceneResults results{summary.scenes[scene], {}};
  for (std::size_t t = 0; t < summary.techniques.size(); ++t) {
    const report::Cell& cell = summary.cells[scene][t];
    if (!cell.measured || !(cell.values[ratio] > 0.0)) continue;
    results.points.push_back({summary.techniques[t], cell.values[ratio], cell.values[ms], cell.values[wrong],
                              std::find(front.begin(), front.end(), t) != front.end()});
  }
  std::stable_sort(results.points.begin(), results.points.end(),
                   [](const ResultPoint& a, const ResultPoint& b) { return a.ratio < b.ratio; });
  return results;
}

}  // namespace

SweepResults read_sweep_results(const std::filesystem::path& path) {
  const std::vector<report::Row> rows = report::read_rows(path);
  if (rows.empty()) throw report::ReportError(path.string() + ": no result in it");
  const report::Summary summary = report::summarize(rows);
  const report::Row& row = rows.front();
  SweepResults results;
  results.measured = fmt::format("{} x {}, {}", row.width, row.height, row.machine.renderer);
  // The first stands for all scenes together.
  for (std::size_t scene = 1; scene < summary.scenes.size(); ++scene) {
    SceneResults one = gathered(summary, scene);
    if (!one.points.empty()) results.scenes.push_back(std::move(one));
  }
  if (results.scenes.empty()) throw report::ReportError(path.string() + ": no row with a time in it");
  return results;
}

const SceneResults* results_of(const SweepResults& results, const std::string& scene) noexcept {
  const auto at = std::find_if(results.scenes.begin(), results.scenes.end(),
                               [&scene](const SceneResults& one) { return one.scene == scene; });
  return at == results.scenes.end() ? nullptr : &*at;
}

Settings settings_of(const report::Technique& technique, LightKind light) {
  SweepEntry entry = sweep_entry(technique);
  if (entry.irregular())
    throw std::runtime_error(technique.filter + ": lists of pixels are drawn by gnomon compare alone");
  if (entry.points != PlanPoints::none)
    throw std::runtime_error(technique.split + ": visible points are planned for by gnomon compare alone");
  if (entry.plan.warp.objective != PlanOptions().warp.objective)
    throw std::runtime_error(technique.warp + ": another objective is planned for by gnomon compare alone");
  Settings settings;
  settings.plan = entry.plan;
  settings.plan.filter = PlanOptions().filter;  // the viewer adds the filter's border itself
  settings.filter = entry.filter;
  settings.identifiers = entry.identifiers;
  settings.layer = entry.layer;
  settings.linear_depth = entry.linear_depth;
  settings.visible_depths = entry.visible_depths;
  if (entry.by_pages())
    settings.pages = {entry.pages.policy, entry.pages.page_texels,
                      std::min(page_capacity(entry, light), kMaxPoolPages), technique.page_target_m};
  return settings;
}

}  // namespace gnomon::tool::view
