// Each scene's front as a table in Markdown: for READMEs and notes.
#include "front_table.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "ranks.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

/// What stands between bars, with nothing in it that would end the cell.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return one_line(text);
}

std::string line(const Summary& summary, std::size_t scene, std::size_t technique, bool on_front) {
  const std::vector<double>& values = summary.cells[scene][technique].values;
  const auto value = [&](std::string_view key) { return values[measure_index(key)]; };
  // Rows of earlier versions have none of the two.
  const auto text = [&](std::string_view key) { return measures()[measure_index(key)].text(value(key)); };
  return "| " + cell(summary.techniques[technique].name()) + " | " + (on_front ? "yes" : "") + " | " +
         percent(value("wrong")) + " | " + text("pixel_error") + " | " + text("mean_error") + " | " +
         text("flips") + " | " + text("twinkle") + " | " + short_number(value("m_p95")) + " | " +
         short_number(value("total_ms")) + " | " + short_number(value("ratio")) + " |\n";
}

/// Of the filters that have no technique on the front, the one with the least error.
std::vector<std::size_t> best_behind(const Summary& summary, std::size_t scene, std::size_t error,
                                     const std::vector<std::size_t>& front) {
  std::set<std::string> seen;
  for (const std::size_t t : front) seen.insert(summary.techniques[t].filter);
  std::vector<std::size_t> all;
  for (std::size_t t = 0; t < summary.techniques.size(); ++t) {
    if (summary.cells[scene][t].measured) all.push_back(t);
  }
  std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
    return summary.cells[scene][a].values[error] < summary.cells[scene][b].values[error];
  });
  std::erase_if(all, [&](std::size_t t) { return !seen.insert(summary.techniques[t].filter).second; });
  return all;
}

/// Empty where nothing has that error.
std::string front_table(const Summary& summary, std::size_t scene, std::string_view key,
                        const std::string& heading) {
  const std::size_t error = measure_index(key);
  const std::vector<std::size_t> front = summary.front(scene, error, measure_index(kDefaultCost));
  if (front.empty()) return {};
  std::string out = heading +
                    "\n\n| technique | front | misclassified | pixel error | mean error | flicker | "
                    "twinkling | m p95 | ms | "
                    "to baseline |\n|--|--|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const std::size_t t : front) out += line(summary, scene, t, true);
  for (const std::size_t t : best_behind(summary, scene, error, front)) out += line(summary, scene, t, false);
  return out + "\n";
}

}  // namespace

std::string front_tables(const Summary& summary) {
  std::string out;
  for (std::size_t scene = 0; scene < summary.scenes.size(); ++scene) {
    out += front_table(summary, scene, kDefaultError, "## " + cell(summary.titles[scene]));
    out += rank_line(summary, scene);
    out += front_table(summary, scene, "pixel_error",
                       "### " + cell(summary.titles[scene]) + ", front by pixel error");
  }
  return out;
}

}  // namespace gnomon::report
