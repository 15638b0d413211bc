// How sure is a difference between techniques: over how many views does it hold?
#include "views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "charts.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::size_t place_in(std::string_view measure) {
  return static_cast<std::size_t>(std::find(kOverViews.begin(), kOverViews.end(), measure) -
                                  kOverViews.begin());
}

/// The best of each filter, of the techniques that the most views have: others are of other views.
std::vector<std::size_t> best_of_filters(const ViewTable& table, const Summary& summary) {
  constexpr std::size_t kMost = 12;
  const auto& errors = table.values[place_in(table.error)];
  const auto views_of = [&](std::size_t t) {
    return std::count_if(errors[t].begin(), errors[t].end(), [](double v) { return std::isfinite(v); });
  };
  std::ptrdiff_t most = 0;
  for (std::size_t t = 0; t < errors.size(); ++t) most = std::max(most, views_of(t));
  std::vector<std::size_t> best;
  std::set<std::string> seen;
  for (const std::size_t t : table.by_median())
    if (views_of(t) == most && best.size() < kMost && seen.insert(summary.techniques[t].filter).second)
      best.push_back(t);
  return best;
}

std::string median_table(const ViewTable& table, const Summary& summary) {
  std::string out = scroll_box("Medians over views", true) + "<table><thead><tr><th>technique</th>";
  for (const std::string_view key : kOverViews)
    out += "<th>" + escaped(measures()[measure_index(key)].column) + "</th>";
  out += "</tr></thead><tbody>\n";
  for (const std::size_t t : table.by_median()) {
    out += "<tr><td>" + escaped(summary.techniques[t].name()) + "</td>";
    for (const std::string_view key : kOverViews) {
      const std::optional<Estimate> e = table.over(key, t);
      out += "<td>" + (e ? escaped(with_interval(measures()[measure_index(key)], *e)) : "-") + "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string pair_table(const ViewTable& table, const Summary& summary) {
  const std::vector<std::size_t> best = best_of_filters(table, summary);
  if (best.size() < 2) return {};
  std::string out = "<h3>In how many views</h3>\n<p class=\"note\">" +
                    escaped(measures()[measure_index(table.error)].name) +
                    ": the views in which the row's technique has less of it than the column's, of those in "
                    "which they differ. The best technique of each filter. Bold: a sign test calls it chance "
                    "with less than 5 %.</p>\n" +
                    scroll_box("Pairs of techniques") + "<table><thead><tr><th>technique</th>";
  for (std::size_t i = 0; i < best.size(); ++i) out += "<th>" + std::to_string(i + 1) + "</th>";
  out += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < best.size(); ++i) {
    out += "<tr><td>" + std::to_string(i + 1) + ". " + escaped(summary.techniques[best[i]].name()) + "</td>";
    for (std::size_t k = 0; k < best.size(); ++k) {
      const SignTest test = table.compared(table.error, best[i], best[k]);
      const std::string text = std::to_string(test.less) + " of " + std::to_string(test.less + test.more);
      out += "<td>" + (i == k ? "" : test.chance < kSure ? "<b>" + text + "</b>" : text) + "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace

std::string with_interval(const Measure& measure, const Estimate& e) {
  return measure.text(e.median) + " (" + short_number(measure.shown(e.low)) + " to " +
         short_number(measure.shown(e.high)) + ")";
}

std::vector<std::size_t> ViewTable::by_median() const {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t t = 0; t < values.front().size(); ++t)
    if (const std::optional<Estimate> e = over(error, t)) order.emplace_back(e->median, t);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::size_t> techniques;
  for (const auto& [median, t] : order) techniques.push_back(t);
  return techniques;
}

bool ViewTable::everywhere(std::string_view measure, std::size_t technique) const {
  const std::vector<double>& of = values[place_in(measure)][technique];
  return !of.empty() && std::all_of(of.begin(), of.end(), [](double value) { return std::isfinite(value); });
}

std::optional<Estimate> ViewTable::over(std::string_view measure, std::size_t technique) const {
  std::vector<double> finite;
  for (const double value : values[place_in(measure)][technique])
    if (std::isfinite(value)) finite.push_back(value);
  return finite.empty() ? std::nullopt : std::optional(estimate(finite));
}

SignTest ViewTable::compared(std::string_view measure, std::size_t first, std::size_t second) const {
  const auto& of = values[place_in(measure)];
  return sign_test(of[first], of[second]);
}

double ViewTable::noise() const {
  std::vector<double> factors;
  for (const double ratio : again) factors.push_back(std::max(ratio, 1.0 / ratio));
  if (factors.empty()) return 1.0;
  std::sort(factors.begin(), factors.end());
  constexpr double kMostViews = 0.95;
  return factors[static_cast<std::size_t>(std::ceil(kMostViews * static_cast<double>(factors.size()))) - 1];
}

ViewTable view_table(const std::vector<Row>& rows, const Summary& summary) {
  ViewTable table;
  std::map<std::string, std::size_t> places;
  std::set<std::string> dropped, frames;
  for (auto& of_measure : table.values) of_measure.resize(summary.techniques.size());
  auto weights = table.values;
  for (const Row& row : rows) {
    Row view = row;
    view.technique = {};
    const std::string frame = view.key();
    view.frame = 0;
    const std::string key = view.key();
    if (row.errors.pixels < kFewestPixels) {
      dropped.insert(key);
      continue;
    }
    const auto [place, is_new] = places.try_emplace(key, places.size());
    if (is_new) {
      for (auto* const all : {&table.values, &weights}) {
        for (auto& of_measure : *all)
          for (std::vector<double>& values : of_measure) values.push_back(0.0);
      }
    }
    if (frames.insert(frame).second && row.times.baseline_again_ms > 0.0 && row.times.baseline_ms > 0.0)
      table.again.push_back(row.times.baseline_ms / row.times.baseline_again_ms);
    const auto technique = static_cast<std::size_t>(
        std::find(summary.techniques.begin(), summary.techniques.end(), row.technique) -
        summary.techniques.begin());
    for (std::size_t m = 0; m < kOverViews.size(); ++m) {
      const Measure& measure = measures()[measure_index(kOverViews[m])];
      const double value = measure.of(row);
      if (!std::isfinite(value)) continue;
      const double weight = measure.is_cost ? 1.0 : static_cast<double>(row.errors.pixels);
      table.values[m][technique][place->second] += weight * value;
      weights[m][technique][place->second] += weight;
    }
  }
  for (std::size_t m = 0; m < kOverViews.size(); ++m) {
    for (std::size_t t = 0; t < summary.techniques.size(); ++t) {
      for (std::size_t v = 0; v < places.size(); ++v) {
        double& value = table.values[m][t][v];
        const double weight = weights[m][t][v];
        value = weight > 0.0 ? value / weight : kNone;
      }
    }
  }
  table.views = places.size();
  for (const auto& [key, place] : places) dropped.erase(key);
  table.dropped = dropped.size();
  const auto& of_pixels = table.values[place_in("pixel_error")];
  const bool any = std::any_of(of_pixels.begin(), of_pixels.end(), [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  });
  table.error = any ? "pixel_error" : "wrong";
  return table;
}

Chart view_chart(const ViewTable& table, const Summary& summary) {
  const Measure& error = measures()[measure_index(table.error)];
  const Measure& cost = measures()[measure_index("ratio")];
  struct Place {
    std::size_t technique;
    Estimate error, cost;
  };
  std::vector<Place> places;
  const double noise = table.noise();
  std::vector<double> xs{noise, 1.0 / noise}, ys;
  for (std::size_t t = 0; t < summary.techniques.size(); ++t) {
    const std::optional<Estimate> e = table.over(table.error, t), c = table.over("ratio", t);
    if (!e || !c) continue;
    places.push_back({t, *e, *c});
    for (const double x : {c->low, c->high}) xs.push_back(x);
    for (const double y : {e->low, e->high}) ys.push_back(error.shown(y));
  }
  Axis x{label_of(cost)}, y{label_of(error)};
  x.fit(xs);
  y.fit(ys);
  Chart chart("Medians over " + counted(table.views, "view") + ", with 95 % intervals", x, y);
  if (noise > 1.0) {
    for (const double at : {1.0 / noise, noise})
      chart.line({{at, y.low}, {at, y.high}}, 0, "front",
                 "the same technique measured twice: 95 % of the times lie between these lines");
  }
  for (const Place& p : places) {
    const std::size_t color = summary.filter_of(summary.techniques[p.technique]),
                      kind = summary.kind_of(summary.techniques[p.technique]);
    const std::string tip = summary.techniques[p.technique].name() + "; " + std::string(error.column) + " " +
                            with_interval(error, p.error) + "; " + std::string(cost.column) + " " +
                            with_interval(cost, p.cost);
    const double level = error.shown(p.error.median);
    chart.line({{p.cost.low, level}, {p.cost.high, level}}, color, "line", tip);
    chart.line({{p.cost.median, error.shown(p.error.low)}, {p.cost.median, error.shown(p.error.high)}}, color,
               "line", tip);
    chart.mark({p.cost.median, level}, color, kind, tip, p.technique);
  }
  for (std::size_t f = 0; f < summary.filters.size(); ++f) chart.legend_color(summary.filters[f], f);
  for (std::size_t k = 0; k < summary.kinds.size(); ++k) chart.legend_mark(summary.kinds[k], k);
  return chart;
}

std::string view_part(const std::vector<Row>& rows, const Summary& summary) {
  const ViewTable table = view_table(rows, summary);
  if (table.views < 2) return {};
  std::string out =
      "<h3>Over views</h3>\n<p class=\"note\">" + counted(table.views, "view") +
      ": one flight through one scene each, the mean of its frames. Medians, with the interval that a "
      "bootstrap over the views gives them at 95 %.";
  if (table.dropped > 0)
    out += " Not among them: " + counted(table.dropped, "view") + " without a frame of " +
           std::to_string(kFewestPixels) + " evaluated pixels.";
  if (!table.again.empty())
    out +=
        " The baseline was measured twice in the same rounds, as two techniques: in 95 % of the frames the "
        "two times differ by less than a factor of " +
        short_number(table.noise()) + ", between the dashed lines. Smaller differences in time are noise.";
  return out + "</p>\n<figure>" + view_chart(table, summary).embedded("views") + "</figure>\n" +
         median_table(table, summary) + pair_table(table, summary);
}

std::string views_csv(const std::vector<Row>& rows, const Summary& summary, const std::string& head,
                      std::string (*columns)(const Technique&)) {
  const ViewTable table = view_table(rows, summary);
  std::string out = head + ",views";
  for (const std::string_view key : kOverViews)
    for (const char* const end : {"", "_low", "_high"}) out += "," + std::string(key) + end;
  out += "\n";
  for (const std::size_t t : table.by_median()) {
    const auto& errors = table.values[place_in(table.error)][t];
    out += columns(summary.techniques[t]) + "," +
           std::to_string(
               std::count_if(errors.begin(), errors.end(), [](double v) { return std::isfinite(v); }));
    for (const std::string_view key : kOverViews) {
      const std::optional<Estimate> e = table.over(key, t);
      for (const double value : {e ? e->median : kNone, e ? e->low : kNone, e ? e->high : kNone})
        out += "," + exact_number(value);
    }
    out += "\n";
  }
  return out;
}

}  // namespace gnomon::report
