// The report's charts: which numbers they show.
#include "charts.hpp"

#include <algorithm>
#include <cmath>

#include "text.hpp"

namespace gnomon::report {
namespace {

std::vector<double> values_of(const Summary& summary, std::size_t scene, std::size_t measure) {
  std::vector<double> values;
  for (const Cell& cell : summary.cells[scene]) {
    if (cell.measured) values.push_back(measures()[measure].shown(cell.values[measure]));
  }
  return values;
}

Axis axis_of(const Summary& summary, std::size_t scene, std::size_t measure) {
  Axis axis{label_of(measures()[measure])};
  axis.fit(values_of(summary, scene, measure));
  return axis;
}

}  // namespace

std::string label_of(const Measure& measure) {
  return std::string(measure.name) + (measure.unit.empty() ? "" : ", " + std::string(measure.unit));
}

std::string tip_of(const Summary& summary, std::size_t scene, std::size_t technique) {
  const Cell& cell = summary.cells[scene][technique];
  std::string tip = summary.techniques[technique].name();
  for (const std::string_view key : {kDefaultError, std::string_view("mean_error"), kDefaultCost}) {
    const std::size_t m = measure_index(key);
    tip += "; " + std::string(measures()[m].column) + " " + measures()[m].text(cell.values[m]);
  }
  return tip;
}

std::vector<std::size_t> notable(const Summary& summary, std::size_t scene, std::size_t limit) {
  std::vector<std::size_t> front =
      summary.front(scene, measure_index(kDefaultError), measure_index(kDefaultCost));
  // From the most exact on: the cheap end is where errors are large.
  std::reverse(front.begin(), front.end());
  if (front.size() > limit) front.resize(limit);
  return front;
}

Chart error_time_chart(const Summary& summary, std::size_t scene) {
  const std::size_t error = measure_index(kDefaultError), cost = measure_index(kDefaultCost);
  Chart chart("Error against run time: " + summary.titles[scene], axis_of(summary, scene, cost),
              axis_of(summary, scene, error));
  std::vector<Point> front;
  for (const std::size_t t : summary.front(scene, error, cost)) {
    const std::vector<double>& values = summary.cells[scene][t].values;
    front.push_back({values[cost], measures()[error].shown(values[error])});
  }
  chart.steps(front, 0, "front", "front: no other technique is better in both");
  for (std::size_t t = 0; t < summary.techniques.size(); ++t) {
    const Cell& cell = summary.cells[scene][t];
    if (!cell.measured || std::isnan(cell.values[cost])) continue;  // an entry without times
    chart.mark({cell.values[cost], measures()[error].shown(cell.values[error])},
               summary.filter_of(summary.techniques[t]), summary.kind_of(summary.techniques[t]),
               tip_of(summary, scene, t), t);
  }
  for (std::size_t f = 0; f < summary.filters.size(); ++f) chart.legend_color(summary.filters[f], f);
  for (std::size_t k = 0; k < summary.kinds.size(); ++k) chart.legend_mark(summary.kinds[k], k);
  return chart;
}

Chart time_to_error_chart(const Summary& summary, std::size_t scene) {
  const std::size_t error = measure_index(kDefaultError), cost = measure_index(kDefaultCost);
  const Axis errors = axis_of(summary, scene, error);
  Chart chart("Time to reach an error: " + summary.titles[scene], errors, axis_of(summary, scene, cost));
  for (std::size_t f = 0; f < summary.filters.size(); ++f) {
    std::vector<Choice> choices;
    std::vector<std::size_t> techniques;
    for (std::size_t t = 0; t < summary.techniques.size(); ++t) {
      const Cell& cell = summary.cells[scene][t];
      if (!cell.measured || summary.techniques[t].filter != summary.filters[f]) continue;
      choices.push_back({cell.values[cost], measures()[error].shown(cell.values[error])});
      techniques.push_back(t);
    }
    const std::vector<std::size_t> front = pareto_front(choices);
    // The cheapest serves every error above its own; below it the next is needed.
    std::vector<Point> points;
    for (const std::size_t i : front) {
      points.push_back({points.empty() ? errors.high : points.back().x, choices[i].cost});
      points.push_back({choices[i].error, choices[i].cost});
    }
    chart.line(points, f, "line", summary.filters[f]);
    for (const std::size_t i : front)
      chart.mark({choices[i].error, choices[i].cost}, f, summary.kind_of(summary.techniques[techniques[i]]),
                 tip_of(summary, scene, techniques[i]), techniques[i]);
    chart.legend_color(summary.filters[f], f);
  }
  return chart;
}

Chart flight_chart(const Summary& summary, const std::vector<Row>& rows, std::size_t scene,
                   std::size_t measure, const std::vector<std::size_t>& techniques) {
  Axis frames{"frame", false}, values{label_of(measures()[measure]), false};
  frames.whole = true;
  std::vector<double> frame_numbers, all_values;
  std::vector<std::vector<Point>> lines(techniques.size());
  for (const std::size_t i : summary.rows_of[scene]) {
    const Row& row = rows[i];
    for (std::size_t k = 0; k < techniques.size(); ++k) {
      if (!(row.technique == summary.techniques[techniques[k]])) continue;
      const double value = measures()[measure].shown(measures()[measure].of(row));
      lines[k].push_back({static_cast<double>(row.frame), value});
      frame_numbers.push_back(row.frame);
      all_values.push_back(value);
    }
  }
  frames.fit(frame_numbers);
  values.fit(all_values);
  Chart chart(std::string(measures()[measure].name) + " along the camera path: " + summary.titles[scene],
              frames, values);
  for (std::size_t k = 0; k < techniques.size(); ++k) {
    const std::string name = summary.techniques[techniques[k]].name();
    chart.line(lines[k], k, "line", name);
    for (const Point& point : lines[k])
      chart.mark(point, k, 0,
                 name + ": " + short_number(point.y) + (measures()[measure].unit == "%" ? " %" : ""),
                 techniques[k]);
    chart.legend_color(name, k);
  }
  return chart;
}

}  // namespace gnomon::report
