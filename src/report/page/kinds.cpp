// What is the best technique for each kind of scene, and how sure is it?
#include "kinds.hpp"

#include <algorithm>
#include <cmath>

#include "gnomon/report/csv.hpp"
#include "text.hpp"
#include "views.hpp"

namespace gnomon::report {
namespace {

std::string kind_of(const Row& row) {
  const std::size_t end = row.view.find(": ");
  return end == std::string::npos ? std::string() : row.view.substr(0, end);
}

struct Ranked {
  std::size_t technique;
  Estimate error;
};

/// Techniques that have the error in all views that count, the least median first.
std::vector<Ranked> ranked(const ViewTable& table, const Summary& summary, std::string_view key) {
  std::vector<Ranked> all;
  for (std::size_t t = 0; t < summary.techniques.size(); ++t)
    if (table.everywhere(key, t)) all.push_back({t, *table.over(key, t)});
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.error.median < b.error.median; });
  return all;
}

}  // namespace

std::vector<KindBest> best_of_kinds(const std::vector<Row>& rows, const Summary& summary) {
  std::vector<std::string> kinds;
  for (const Row& row : rows) {
    const std::string kind = kind_of(row);
    if (!kind.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  }
  if (kinds.empty()) return {};
  kinds.emplace_back("all");
  std::vector<KindBest> best;
  for (const std::string& kind : kinds) {
    std::vector<Row> of_kind;
    for (const Row& row : rows)
      if (kind == "all" || kind_of(row) == kind) of_kind.push_back(row);
    const ViewTable table = view_table(of_kind, summary);
    for (const std::string_view key : kErrors) {
      const std::vector<Ranked> order = ranked(table, summary, key);
      if (order.empty()) continue;
      const std::string& filter = summary.techniques[order.front().technique].filter;
      const auto next = std::find_if(order.begin(), order.end(), [&](const Ranked& r) {
        return summary.techniques[r.technique].filter != filter;
      });
      if (next == order.end()) continue;
      best.push_back({kind, measure_index(key), table.views, order.front().technique, next->technique,
                      order.front().error, next->error,
                      table.compared(key, order.front().technique, next->technique)});
    }
  }
  return best;
}

std::string kind_part(const std::vector<Row>& rows, const Summary& summary) {
  const std::vector<KindBest> best = best_of_kinds(rows, summary);
  if (best.empty()) return {};
  std::string out =
      "<h3>By kind of scene</h3>\n<p class=\"note\">The least median of each error over the views of a kind, "
      "with its "
      "95 % interval, and the best technique with another filter. <b>less in</b>: views in which the first "
      "has less "
      "than the next, of those in which they differ; bold where a sign test calls it chance with less than 5 "
      "%.</p>\n" +
      scroll_box("By kind of scene", true) +
      "<table "
      "class=\"words\"><thead><tr><th>kind</th><th>views</th><th>error</th><th>technique</th><th>median</th>"
      "<th>next</th><th>median</th><th>less in</th></tr></thead><tbody>\n";
  for (const KindBest& b : best) {
    const Measure& measure = measures()[b.measure];
    const std::string less = std::to_string(b.test.less) + " of " + std::to_string(b.test.less + b.test.more);
    out += "<tr><td>" + escaped(b.kind) + "</td><td>" + std::to_string(b.views) + "</td><td>" +
           escaped(measure.column) + "</td><td>" + escaped(summary.techniques[b.technique].name()) +
           "</td><td>" + escaped(with_interval(measure, b.error)) + "</td><td>" +
           escaped(summary.techniques[b.next].name()) + "</td><td>" +
           escaped(with_interval(measure, b.next_error)) + "</td><td>" +
           (b.test.chance < kSure ? "<b>" + less + "</b>" : less) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string kinds_csv(const std::vector<Row>& rows, const Summary& summary) {
  std::string out =
      "kind,views,error,technique,median,low,high,next,next_median,next_low,next_high,less,more,chance\n";
  for (const KindBest& b : best_of_kinds(rows, summary)) {
    out += csv_field(b.kind) + "," + std::to_string(b.views) + "," + std::string(measures()[b.measure].key) +
           "," + csv_field(summary.techniques[b.technique].name());
    for (const double value : {b.error.median, b.error.low, b.error.high}) out += "," + exact_number(value);
    out += "," + csv_field(summary.techniques[b.next].name());
    for (const double value : {b.next_error.median, b.next_error.low, b.next_error.high})
      out += "," + exact_number(value);
    out += "," + std::to_string(b.test.less) + "," + std::to_string(b.test.more) + "," +
           exact_number(b.test.chance) + "\n";
  }
  return out;
}

std::string pairs_csv(const Summary& summary) {
  constexpr std::size_t kMost = 64;
  std::string out = "error,first,second,scenes,ratio,ratio_low,ratio_high,less,more,chance\n";
  const std::size_t count = summary.techniques.size();
  if (count > kMost) return out;
  for (const std::string_view key : kErrors) {
    const std::size_t m = measure_index(key);
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < count; ++b) {
        std::vector<double> first, second, ratios;
        for (std::size_t scene = 1; scene < summary.scenes.size() && a != b; ++scene) {
          const Cell &of_first = summary.cells[scene][a], &of_second = summary.cells[scene][b];
          if (!of_first.measured || !of_second.measured || of_first.pixels < kFewestPixels) continue;
          if (!std::isfinite(of_first.values[m]) || !std::isfinite(of_second.values[m])) continue;
          first.push_back(of_first.values[m]);
          second.push_back(of_second.values[m]);
          if (second.back() > 0.0) ratios.push_back(first.back() / second.back());
        }
        if (first.empty()) continue;
        const Estimate ratio = estimate(ratios);
        const SignTest test = sign_test(first, second);
        out += std::string(key) + "," + csv_field(summary.techniques[a].name()) + "," +
               csv_field(summary.techniques[b].name()) + "," + std::to_string(first.size());
        for (const double value : {ratio.median, ratio.low, ratio.high}) out += "," + exact_number(value);
        out += "," + std::to_string(test.less) + "," + std::to_string(test.more) + "," +
               exact_number(test.chance) + "\n";
      }
    }
  }
  return out;
}

}  // namespace gnomon::report
