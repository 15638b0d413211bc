// The parts of the page that are charts, tables and words.
#include "sections.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "budgets.hpp"
#include "charts.hpp"
#include "expected.hpp"
#include "file.hpp"
#include "kinds.hpp"
#include "ranks.hpp"
#include "stability.hpp"
#include "text.hpp"
#include "views.hpp"
#include "waterfall.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

std::string cell(const std::string& text, const std::string& sort_value) {
  return "<td data-v=\"" + sort_value + "\">" + escaped(text) + "</td>";
}

std::string summary_row(const Summary& summary, std::size_t scene, std::size_t technique, bool best) {
  const std::string id = std::to_string(technique);
  std::string out = "<tr class=\"row" + std::string(best ? "" : " dominated") + "\" data-id=\"" + id +
                    "\"><td>" + escaped(summary.techniques[technique].name()) + "</td><td class=\"best\">" +
                    (best ? "front" : "") + "</td>";
  const Cell& values = summary.cells[scene][technique];
  for (std::size_t m = 0; m < values.values.size(); ++m)
    out += cell(measures()[m].text(values.values[m]), exact_number(values.values[m]));
  return out + "</tr>\n";
}

/// Techniques of a scene by rising error.
std::vector<std::size_t> by_error(const Summary& summary, std::size_t scene) {
  const std::size_t error = measure_index(kDefaultError);
  std::vector<std::size_t> order;
  for (std::size_t t = 0; t < summary.techniques.size(); ++t) {
    if (summary.cells[scene][t].measured) order.push_back(t);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return summary.cells[scene][a].values[error] < summary.cells[scene][b].values[error];
  });
  return order;
}

/// The cheapest technique that comes below a given error, for a few errors between the best and the worst.
std::string matched_error_table(const Summary& summary, std::size_t scene) {
  const std::size_t error = measure_index(kDefaultError), cost = measure_index(kDefaultCost);
  const std::vector<std::size_t> front = summary.front(scene, error, cost);
  std::string out =
      scroll_box("Least time for an error") +
      "<table><thead><tr><th>misclassified pixels</th><th>least time, ms</th><th>technique</th></tr></thead>"
      "<tbody>\n";
  for (const std::size_t t : front) {
    const std::vector<double>& values = summary.cells[scene][t].values;
    out += "<tr><td>" + percent(values[error]) + "</td><td>" + short_number(values[cost]) + "</td><td>" +
           escaped(summary.techniques[t].name()) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string words_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return short_number(value.get<double>());
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A table of JSON lines whose columns are the keys of the first.
std::string table_of_lines(const std::string& text, const std::string& where) {
  std::string out;
  std::vector<std::string> columns;
  for_each_json_line(text, where, [&](std::string_view line) {
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object()) throw ReportError("not a JSON object");
    if (columns.empty()) {
      out += scroll_box(where, true) + "<table class=\"words\"><thead><tr>";
      for (const auto& [key, value] : json.items()) {
        columns.push_back(key);
        out += "<th>" + escaped(key) + "</th>";
      }
      out += "</tr></thead><tbody>\n";
    }
    out += "<tr>";
    for (const std::string& key : columns)
      out += "<td>" + escaped(json.contains(key) ? words_of(json[key]) : std::string()) + "</td>";
    out += "</tr>\n";
  });
  return columns.empty() ? std::string() : out + "</tbody></table></div>\n";
}

constexpr double kMebi = 1 << 20;

/// One kind of thing that plans left out, over the frames of a scene.
struct LeftOutKind {
  std::string scene, parametrization, kind, what, why;
  int times = 0;
  double saves_texels = 0.0;
};

/// The text without its numbers: "depths 0.1 to 0.3" and "depths 0.1 to 0.4" are the same kind of thing.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("0123456789.+").find(c) == std::string_view::npos) out += c;
  }
  return out;
}

/// What saves most comes first.
std::vector<LeftOutKind> left_out_kinds(const std::vector<Row>& rows) {
  std::vector<LeftOutKind> kinds;
  std::set<std::string> counted;
  for (const Row& row : rows) {
    const std::string name = parametrization_of(row.technique);
    if (!counted.insert(plan_of(row)).second) continue;
    for (const LeftOut& l : row.left_out) {
      if (!l.rule.empty()) continue;
      const std::string kind = without_numbers(l.what);
      auto at = std::find_if(kinds.begin(), kinds.end(), [&](const LeftOutKind& k) {
        return k.scene == row.scene && k.parametrization == name && k.kind == kind;
      });
      if (at == kinds.end()) at = kinds.insert(kinds.end(), {row.scene, name, kind, l.what, l.why});
      ++at->times;
      at->saves_texels += static_cast<double>(l.saves_texels);
    }
  }
  std::stable_sort(kinds.begin(), kinds.end(), [](const LeftOutKind& a, const LeftOutKind& b) {
    return a.saves_texels * b.times > b.saves_texels * a.times;
  });
  return kinds;
}

/// Says how many techniques the table of all scenes together lacks.
std::string missing_note(const Summary& summary) {
  if (summary.scenes.size() <= 2) return {};
  const auto missing = std::count_if(summary.cells[0].begin(), summary.cells[0].end(),
                                     [](const Cell& all) { return !all.measured; });
  if (missing == 0) return {};
  return "<p class=\"note\">Dropped from \"all scenes\": " +
         counted(static_cast<std::size_t>(missing), "technique") +
         " that some scene was not measured with.</p>\n";
}

}  // namespace

std::string section_error_time(const PageInput& input) {
  const Summary& summary = input.summary;
  std::string out =
      "<section id=\"s1\">\n<h2>1. Error against run time</h2>\n" + budget_part(input.rows, summary) +
      "<p>Each mark is a technique: colour by "
      "filter, shape by "
      "warp or page policy. Lower left is better. The dashed line is the front: no other technique is better "
      "in both. An error of 0 lies on the lower edge. For all scenes together, errors are means and times "
      "geometric means.</p>\n<div class=\"bar script\"><label>scene <select "
      "id=\"scene\"></select></label><label>error <select id=\"error\"></select></label><label>cost <select "
      "id=\"cost\"></select></label></div>\n";
  out += error_time_chart(summary, input.start_scene).embedded("error-time");
  out +=
      "<div id=\"details\" class=\"script note\" aria-live=\"polite\"></div>\n<h3>Time at equal "
      "error</h3>\n<p class=\"note\">The least time per frame at which each filter stays below an error, "
      "with the best warp, split and map size of this sweep.</p>\n";
  for (std::size_t scene = input.start_scene; scene < summary.scenes.size(); ++scene) {
    const std::string number = std::to_string(scene);
    out += "<div class=\"by-scene\" data-scene=\"" + number + "\">\n" +
           time_to_error_chart(summary, scene).embedded("time-to-error-" + number) +
           matched_error_table(summary, scene) + "</div>\n";
  }
  return out + view_part(input.rows, summary) + kind_part(input.rows, summary) +
         rank_part(summary, input.start_scene) + expected_part(input.rows) + "</section>\n";
}

std::string section_summary(const PageInput& input) {
  const Summary& summary = input.summary;
  std::string out =
      "<section id=\"s2\">\n<h2>2. Summary</h2>\n<p>Errors are shares of the evaluated pixels. <b>front</b>: "
      "no other technique is both cheaper and more exact. Other techniques are grey. A click on a column "
      "head sorts.</p>\n" +
      missing_note(input.summary) + scroll_box("Summary", true) +
      "<table id=\"summary\"><thead><tr><th>warp / split / maps, or pages / texels / "
      "filter</th><th>Pareto</th>";
  for (const Measure& measure : measures()) out += "<th>" + escaped(measure.column) + "</th>";
  out += "</tr></thead>\n";
  const std::size_t error = measure_index(kDefaultError), cost = measure_index(kDefaultCost);
  for (std::size_t scene = 0; scene < summary.scenes.size(); ++scene) {
    if (scene == 0 && input.start_scene != 0) continue;
    const std::vector<std::size_t> front = summary.front(scene, error, cost);
    out += "<tbody data-scene=\"" + std::to_string(scene) + "\">\n<tr class=\"scene\"><td colspan=\"" +
           std::to_string(measures().size() + 2) + "\">" + escaped(summary.titles[scene]) + "</td></tr>\n";
    for (const std::size_t t : by_error(summary, scene))
      out += summary_row(summary, scene, t, std::find(front.begin(), front.end(), t) != front.end());
    out += "</tbody>\n";
  }
  return out + "</table></div>\n</section>\n";
}

std::string section_flight(const PageInput& input) {
  std::string out =
      "<section id=\"s4\">\n<h2>4. Along the camera path</h2>\n<p>Misclassified pixels per frame, and "
      "flicker: pixels whose shadow changes from one frame of a 60 Hz viewer to the next although the exact "
      "shadow does not. The charts show the techniques of each scene's front.</p>\n";
  for (std::size_t scene = 1; scene < input.summary.scenes.size(); ++scene) {
    const std::vector<std::size_t> shown = notable(input.summary, scene, kFlightLines);
    out += "<h3>" + escaped(input.summary.titles[scene]) + "</h3>\n";
    const std::size_t all = notable(input.summary, scene, input.summary.techniques.size()).size();
    if (all > shown.size()) {
      out += "<p class=\"note\">The " + std::to_string(shown.size()) + " most exact of " +
             counted(all, "technique") + " on the front; the others are in frames.csv.</p>\n";
    }
    for (const std::string_view key : {kDefaultError, std::string_view("flips")}) {
      const std::string id = std::string(key) + "-" + std::to_string(scene);
      out += flight_chart(input.summary, input.rows, scene, measure_index(key), shown).embedded(id);
    }
  }
  return out + "</section>\n";
}

std::string section_stability(const PageInput& input) {
  const std::string where = (input.folder / kStabilityFile).string();
  // Lines that gnomon stress did not write are shown as they are.
  std::string content = input.stability.empty() ? table_of_lines(optional_text(where), where)
                                                : stability_section(input.stability);
  if (content.empty())
    content =
        "<p class=\"note\">Not measured: this folder has no stability.jsonl, which <code>gnomon stress "
        "--out</code> writes.</p>\n";
  return "<section id=\"s5\">\n<h2>5. Numerical stability</h2>\n" + content + "</section>\n";
}

std::string section_left_out(const PageInput& input) {
  std::string out =
      "<section id=\"s6\">\n<h2>6. Omitted work</h2>\n<p>Maps, depths and casters that the plans omitted, "
      "with the reason and the texels saved.</p>\n" +
      scroll_box("Omitted work", true) +
      "<table class=\"words\"><thead><tr><th>scene</th><th>parametrization</th><th>omitted (an "
      "example)</th><th>reason</th>"
      "<th>times</th><th>Mi texels saved each time</th></tr></thead><tbody>\n";
  const std::vector<LeftOutKind> kinds = left_out_kinds(input.rows);
  for (const LeftOutKind& k : kinds) {
    out += "<tr><td>" + escaped(k.scene) + "</td><td>" + escaped(k.parametrization) + "</td><td>" +
           escaped(k.what) + "</td><td>" + escaped(k.why) + "</td><td>" + std::to_string(k.times) +
           "</td><td>" + short_number(k.saves_texels / k.times / kMebi) + "</td></tr>\n";
  }
  if (kinds.empty()) out += "<tr><td colspan=\"6\">nothing</td></tr>\n";
  return out + "</tbody></table></div>\n" + waterfalls(input.rows) + "</section>\n";
}

std::string section_method(const PageInput& input) {
  std::set<std::string> machines, settings;
  double low = input.rows.empty() ? 0.0 : input.rows.front().machine.load, high = low;
  for (const Row& row : input.rows) {
    const Machine& m = row.machine;
    machines.insert(m.renderer + " through " + m.context + (m.software ? ", drawn by the CPU" : "") + "; " +
                    m.cpu + ", " + std::to_string(m.cores) + " cores; gnomon " + m.version +
                    "; rays: " + m.rays);
    settings.insert(
        std::to_string(row.width) + "x" + std::to_string(row.height) + " pixels, " +
        std::to_string(row.frames) + " frames, " + row.light + " at " +
        short_number(row.light_elevation_deg) + " degrees elevation and " +
        short_number(row.light_azimuth_deg) + " azimuth, " +
        (row.times.rounds > 0 ? std::to_string(row.times.rounds) + " rounds" : "not timed") +
        (row.camera.empty() ? "" : ", camera " + row.camera) +
        (row.edits.empty() ? "" : ", scenes with " + row.edits) +
        (row.animation.empty() ? "" : ", animation '" + row.animation + "' plays in " + row.scene));
    low = std::min(low, m.load);
    high = std::max(high, m.load);
  }
  std::string out = "<section id=\"s7\">\n<h2>7. Method</h2>\n<ul>\n";
  for (const std::string& m : machines) out += "<li>" + escaped(m) + "</li>\n";
  for (const std::string& s : settings) out += "<li>" + escaped(s) + "</li>\n";
  out += "<li>load average of the machine while measuring: " + short_number(low) + " to " +
         short_number(high) + "</li>\n</ul>\n";
  out +=
      "<p><b>Truth.</b> Rays run from the world point of every pixel to the light, past its own triangle. "
      "Pixels where an edge is closer than the rays' certified error are not evaluated. <b>False light</b> "
      "and <b>false shadow</b> are the shares of evaluated pixels on the wrong side of one half; together "
      "they are the <b>misclassified</b> pixels. <b>Mean error</b> compares with the exact shadow averaged "
      "over the filter's own kernel (for area-light filters: with the true penumbra). <b>Leaking</b> is the "
      "mean light where no part of the kernel is lit, <b>darkening</b> the mean shadow where all of it is. "
      "<b>Pixel error</b> compares with the light over the whole pixel: several rays from the eye through it "
      "(--pixel-samples), and one to the light from each surface that they meet and that the light can "
      "reach. "
      "Pixels of several surfaces have the mean of them; <b>of one surface</b> omits those. <b>Flicker</b> "
      "counts pixels whose shadow at the same point flips from one frame to the next although the exact one "
      "does not. <b>Twinkling</b> counts pixels of the picture that change by over a quarter more than the "
      "light over them does, while the camera moves as for a viewer at 60 Hz; <b>followed</b> compares the "
      "pixels that show the same point before and after. "
      "<b>Too light</b> and <b>too dark</b> count the pixels there that are off by over a tenth: leaks and "
      "acne, also below one half. "
      "<b>m</b> is the aliasing error, screen pixels per shadow map texel; above 1 the map is "
      "undersampled.</p>\n<p><b>Time.</b> Times are wall clock after the driver has finished: planning, "
      "drawing depths, prefilter and look-up, without shading. Techniques run one after the other, in a new "
      "random order each round, after a warm-up round. results.jsonl has the medians with 95 % bootstrap "
      "intervals.</p>\n";
  return out + "</section>\n";
}

}  // namespace gnomon::report
