// Does the error that plans are expected to have agree with the one that was measured?
#include "expected.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "gnomon/report/statistics.hpp"
#include "summary.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

double wrong_of(const Row& row) {
  return row.errors.false_lit + row.errors.false_shadow;
}

bool counts(const Row& row) {
  return row.technique.filter == "hard" && row.expected_wrong &&
         wrong_of(row) * static_cast<double>(row.errors.pixels) >= kCountedPixels;
}

/// True for a row that has a place among logarithms.
bool expects_some(const Row& row) {
  return counts(row) && *row.expected_wrong > 0.0;
}

}  // namespace

ExpectedCheck check_expected(const std::vector<Row>& rows) {
  ExpectedCheck check;
  struct View {
    std::vector<double> expected, measured;  // pixels
  };
  std::map<std::string, View> views;
  std::vector<double> ratios;
  for (const Row& row : rows) {
    if (!counts(row)) continue;
    ++check.rows;
    const double ratio = *row.expected_wrong / wrong_of(row);
    if (ratio > 0.0) ratios.push_back(ratio);
    if (ratio < kAlike && ratio > 1.0 / kAlike) check.within += 1.0;
    Row view = row;
    view.technique = {};
    auto& [expected, measured] = views[view.key()];
    expected.push_back(*row.expected_wrong * static_cast<double>(row.errors.pixels));
    measured.push_back(wrong_of(row) * static_cast<double>(row.errors.pixels));
  }
  if (check.rows == 0) return check;
  check.without = check.rows - ratios.size();
  check.within /= static_cast<double>(check.rows);
  check.ratio = geometric_mean(ratios, 1e-12);
  for (const auto& [key, view] : views) {
    if (view.measured.size() < kCountedRows) continue;
    if (!std::isfinite(rank_correlation(view.measured, view.measured))) continue;  // nothing to rank
    ++check.views;
    // Equal expected values rank nothing, though the measured ones differ.
    const double correlation = rank_correlation(view.expected, view.measured);
    if (std::isfinite(correlation)) check.correlation += correlation;
  }
  if (check.views > 0) check.correlation /= static_cast<double>(check.views);
  return check;
}

/// Of so many rows that expect something one is drawn: thousands of marks hide each other, and a page has to
/// open soon.
std::size_t rows_per_mark(const std::vector<Row>& rows) {
  constexpr std::size_t kMostMarks = 2000;
  const auto count = static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), expects_some));
  return count == 0 ? 1 : 1 + (count - 1) / kMostMarks;
}

std::optional<Chart> expected_chart(const std::vector<Row>& rows) {
  constexpr double kPercent = 100.0;
  std::vector<double> values;
  std::vector<std::string> scenes;
  for (const Row& row : rows) {
    if (!expects_some(row)) continue;
    values.push_back(kPercent * wrong_of(row));
    values.push_back(kPercent * *row.expected_wrong);
  }
  if (values.empty()) return std::nullopt;
  Axis measured{"misclassified, measured, %"}, expected{"expected without drawing, %"};
  measured.fit(values);
  expected.fit(values);
  Chart chart("Error expected and measured", measured, expected);
  chart.line({{measured.low, measured.low}, {measured.high, measured.high}}, 0, "front", "as expected");
  const std::size_t every = rows_per_mark(rows);
  std::size_t place = 0;
  for (const Row& row : rows) {
    if (!expects_some(row) || place++ % every != 0) continue;
    std::size_t scene = 0;
    while (scene < scenes.size() && scenes[scene] != row.scene) ++scene;
    if (scene == scenes.size()) scenes.push_back(row.scene);
    const Point at{kPercent * wrong_of(row), kPercent * *row.expected_wrong};
    chart.mark(at, scene, scene / kColors,
               short_scene_name(row.scene) + " frame " + std::to_string(row.frame) + ", " +
                   row.technique.name() + ": measured " + short_number(at.x) + " %, expected " +
                   short_number(at.y) + " %",
               scene);
  }
  for (std::size_t scene = 0; scene < scenes.size(); ++scene)
    chart.legend_color(short_scene_name(scenes[scene]), scene);
  return chart;
}

std::string expected_part(const std::vector<Row>& rows) {
  const std::optional<Chart> chart = expected_chart(rows);
  if (!chart) return {};
  const ExpectedCheck check = check_expected(rows);
  std::string out =
      "<h3>Expected without drawing</h3>\n<figure>" + chart->embedded("expected") + "</figure>\n<p>" +
      counted(check.rows, "row") + " of hard comparison with at least " + short_number(kCountedPixels) +
      " misclassified pixels: " + short_number(100.0 * check.within) + " % are expected within a factor of " +
      short_number(kAlike) + ", geometric mean of expected over measured " + short_number(check.ratio) + ".";
  if (check.without > 0)
    out +=
        " " + counted(check.without, "row") + " without an expected one: within no factor, and in no mean.";
  if (check.views > 0)
    out += " Rank correlation over the settings of a view, mean of " + counted(check.views, "view") + ": " +
           short_number(check.correlation) + ".";
  if (const std::size_t every = rows_per_mark(rows); every > 1)
    out += " The chart shows one of " + std::to_string(every) + " rows.";
  return out +
         " Each pixel is compared with what a ray finds from the light through the middle of its texel. "
         "Rows of earlier versions took the shadow that the picture shows there.</p>\n";
}

}  // namespace gnomon::report
