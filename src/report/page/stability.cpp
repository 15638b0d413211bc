// Section 5 of the page: what `gnomon stress` found, as charts and tables.
#include "stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "file.hpp"
#include "gnomon/report/row.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;
using stress::AxisRow;
using stress::CaseRow;
using stress::FilterRow;

constexpr double kHalfTexel = 0.5;

/// A row of the file; Json::exception where a field is missing or of another type.
template <class Row>
Row row_from(const Json& json) {
  Row row;
  for_each_field(row, [&](const char* name, auto& value, double for_null = 0.0) {
    using Value = std::remove_reference_t<decltype(value)>;
    const Json& found = json.at(name);
    if constexpr (std::is_same_v<Value, double>) {
      value = found.is_null() ? for_null : found.get<double>();
    } else if constexpr (std::is_same_v<Value, int>) {
      // The library's own conversion would take 1e300 for an int.
      const bool whole = found.is_number_unsigned()
                             ? std::in_range<int>(found.get<std::uint64_t>())
                             : found.is_number_integer() && std::in_range<int>(found.get<std::int64_t>());
      if (!whole) throw ReportError(std::string(name) + ": wants a whole number");
      found.get_to(value);
    } else {
      found.get_to(value);
    }
  });
  return row;
}

/// The wanted entry, or `fresh` at the end where there is none yet.
template <class Entry, class Same>
Entry& entry_of(std::vector<Entry>& entries, std::type_identity_t<Entry> fresh, Same is_wanted) {
  const auto at = std::find_if(entries.begin(), entries.end(), is_wanted);
  return at != entries.end() ? *at : entries.emplace_back(std::move(fresh));
}

void add_line(const Json& json, Stability& stability) {
  const std::string kind = json.value("kind", std::string());
  if (kind == "case") stability.cases.push_back(row_from<CaseRow>(json));
  if (kind == "axis") {
    AxisRow row = row_from<AxisRow>(json);
    entry_of(stability.axes, {row.axis, row.label, row.logarithmic, {}}, [&](const StabilityAxis& axis) {
      return axis.name == row.axis;
    }).rows.push_back(std::move(row));
  }
  if (kind == "filter") {
    FilterRow row = row_from<FilterRow>(json);
    entry_of(
        stability.filters, {row.axis, row.label, row.filter, row.logarithmic, {}},
        [&](const StabilityFilter& filter) { return filter.axis == row.axis && filter.filter == row.filter; })
        .rows.push_back(std::move(row));
  }
}

/// The largest over the variants at each value, in pieces between which there was nothing to measure.
template <typename Get>
std::vector<std::vector<Point>> pieces(const StabilityAxis& axis, Get get) {
  std::vector<std::vector<Point>> all(1);
  for (std::size_t i = 0; i < axis.rows.size();) {
    const double value = axis.rows[i].value;
    double worst = -1.0;
    for (; i < axis.rows.size() && axis.rows[i].value == value; ++i) {
      if (axis.rows[i].maps > 0) worst = std::max(worst, get(axis.rows[i]));
    }
    if (worst >= 0.0)
      all.back().push_back({value, worst});
    else if (!all.back().empty())
      all.emplace_back();
  }
  return all;
}

double absolute_of(const AxisRow& row) {
  return row.worst.float_absolute_texels;
}
double relative_of(const AxisRow& row) {
  return row.worst.float_relative_texels;
}
double exact_of(const AxisRow& row) {
  return row.worst.error_texels;
}

struct Line {
  const char* name;
  double (*of)(const AxisRow& row);
};
constexpr Line kLines[] = {{"double against long double", exact_of},
                           {"float, absolute coordinates", absolute_of},
                           {"float, relative to the camera", relative_of}};
constexpr std::size_t kHalfMark = 3, kFallbackMark = 2;

/// A mark at each end of where the line is above half a texel.
void mark_half_texel(Chart& chart, const std::vector<Point>& points, std::size_t color, const char* name) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool above = points[i].y > kHalfTexel, before = i > 0 && points[i - 1].y > kHalfTexel;
    if (above == before) continue;
    const Point& at = above ? points[i] : points[i - 1];
    chart.mark(
        at, color, kHalfMark,
        std::string(name) + ": more than half a texel " + (above ? "from " : "up to ") + short_number(at.x),
        0);
  }
}

/// A mark where what is used changes, for the map that may choose its warp.
void mark_fallbacks(Chart& chart, const StabilityAxis& axis) {
  std::string before;
  constexpr std::size_t kColor = 7;
  for (const AxisRow& row : axis.rows) {
    if (row.variant != "optimal" || row.used == before) continue;
    if (!before.empty())
      chart.mark({row.value, row.maps > 0 ? row.worst.error_texels : 0.0}, kColor, kFallbackMark,
                 "at " + short_number(row.value) + ": " + row.used + " instead of " + before, 0);
    before = row.used;
  }
}

template <typename Get>
std::string worst_cell(const StabilityAxis& axis, Get get) {
  const AxisRow* row = worst_row(axis.rows, get);
  if (row == nullptr) return "<td>-</td>";
  return "<td>" + short_number(get(*row)) + "<br><small>" + escaped(row->variant) + " at " +
         short_number(row->value) + "</small></td>";
}

template <typename Get>
std::string half_texel_cell(const StabilityAxis& axis, Get get) {
  const auto range = beyond_half_texel(axis.rows, get);
  if (!range) return "<td>nowhere</td>";
  const auto [low, high] = *range;
  return "<td>" + short_number(low) + (high > low ? " to " + short_number(high) : "") + "</td>";
}

std::string fallback_cell(const StabilityAxis& axis) {
  constexpr std::size_t kShown = 6;
  const std::vector<const AxisRow*> changes = changes_of_use(axis.rows);
  std::string out = "<td>";
  for (std::size_t i = 0; i < std::min(changes.size(), kShown); ++i)
    out += (i == 0 ? "" : "; from " + short_number(changes[i]->value) + ": ") + escaped(changes[i]->used);
  if (changes.size() > kShown) out += "; " + std::to_string(changes.size() - kShown) + " more";
  return out + "</td>";
}

std::string axes_table(const Stability& stability) {
  std::string out =
      scroll_box("Stress parameters") +
      "<table class=\"words\"><thead><tr><th>parameter</th><th>double against long double, "
      "texels</th><th>in units of the last place</th><th>float relative to the camera, texels</th><th>over "
      "half "
      "a texel at</th><th>absolute float over half a texel at</th><th>condition number</th><th>texels per "
      "area, "
      "change for a step of 1e-6</th><th>warp of one map</th><th>omitted there</th></tr></thead>"
      "<tbody>\n";
  const auto relative = [](const AxisRow& r) { return r.worst.float_relative_texels; };
  const auto error = [](const AxisRow& r) { return r.worst.error_texels; };
  for (const StabilityAxis& axis : stability.axes) {
    const AxisRow* worst = worst_row(axis.rows, error);
    out += "<tr><td>" + escaped(axis.name) + "</td>" + worst_cell(axis, error) + "<td>" +
           (worst == nullptr ? "-" : short_number(worst->worst.error_ulp)) + "</td>" +
           worst_cell(axis, relative) + half_texel_cell(axis, relative) +
           half_texel_cell(axis, [](const AxisRow& r) { return r.worst.float_absolute_texels; }) +
           worst_cell(axis, [](const AxisRow& r) { return r.worst.condition; }) +
           worst_cell(axis, [](const AxisRow& r) { return r.jump; }) + fallback_cell(axis) + "<td>" +
           (worst == nullptr ? std::string() : escaped(worst->left_out)) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string cases_table(const Stability& stability) {
  std::string out = scroll_box("Extreme cases", true) +
                    "<table class=\"words\"><thead><tr><th>row</th><th>input</th><th>verdict</th>"
                    "<th>required</th><th>found</th></tr></thead><tbody>\n";
  for (const CaseRow& c : stability.cases) {
    out += "<tr><td>" + std::to_string(c.row) + "</td><td>" + escaped(c.input) + "</td><td>" +
           (c.verdict == "holds" ? escaped(c.verdict) : "<b>" + escaped(c.verdict) + "</b>") + "</td><td>" +
           escaped(c.required) + "</td><td>" + escaped(c.found) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string filters_table(const Stability& stability) {
  std::string out = scroll_box("Filters at their limits", true) +
                    "<table class=\"words\"><thead><tr><th>parameter</th><th>filter</th><th>largest "
                    "error</th><th>at</th><th>bound there</th><th>results beyond their bound</th><th>all "
                    "results in [0, 1]</th></tr>"
                    "</thead><tbody>\n";
  for (const StabilityFilter& filter : stability.filters) {
    const FilterRow worst = worst_of_filter(filter.rows);
    out += "<tr><td>" + escaped(filter.axis) + "</td><td>" + escaped(filter.filter) + "</td><td>" +
           short_number(worst.error) + "</td><td>" + short_number(worst.value) + "</td><td>" +
           short_number(worst.bound) + "</td><td>" + percent(worst.beyond) + "</td><td>" +
           (worst.within ? "yes" : "<b>no</b>") + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace

Stability read_stability(const std::string& text, const std::string& where) {
  Stability stability;
  for_each_json_line(text, where, [&stability](std::string_view line) {
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object()) throw ReportError("not a JSON object");
    try {
      add_line(json, stability);
    } catch (const Json::exception&) {
      throw ReportError("not a row of gnomon stress");
    }
  });
  const auto by_value = [](const auto& a, const auto& b) { return a.value < b.value; };
  for (StabilityAxis& axis : stability.axes) std::stable_sort(axis.rows.begin(), axis.rows.end(), by_value);
  for (StabilityFilter& filter : stability.filters)
    std::stable_sort(filter.rows.begin(), filter.rows.end(), by_value);
  return stability;
}

Chart stability_chart(const StabilityAxis& axis) {
  Axis x{axis.label, axis.logarithmic}, y{"error, texels"};
  std::vector<double> values, errors{kHalfTexel};
  for (const AxisRow& row : axis.rows) {
    values.push_back(row.value);
    if (row.maps == 0) continue;
    for (const Line& line : kLines) errors.push_back(line.of(row));
  }
  x.fit(values);
  y.fit(errors);
  Chart chart("Error along " + axis.name, x, y);
  chart.line({{x.low, kHalfTexel}, {x.high, kHalfTexel}}, 0, "front", "half a texel");
  for (std::size_t i = 0; i < std::size(kLines); ++i) {
    for (const std::vector<Point>& piece : pieces(axis, kLines[i].of)) {
      chart.line(piece, i, "line", kLines[i].name);
      if (i > 0) mark_half_texel(chart, piece, i, kLines[i].name);
    }
    chart.legend_color(kLines[i].name, i);
  }
  mark_fallbacks(chart, axis);
  chart.legend_mark("more than half a texel", kHalfMark);
  chart.legend_mark("warp or fit changes", kFallbackMark);
  return chart;
}

Chart filter_chart(const StabilityFilter& filter) {
  Axis x{filter.label, filter.logarithmic}, y{"error of visibility"};
  std::vector<double> values, errors;
  std::vector<Point> error, bound;
  for (const FilterRow& row : filter.rows) {
    values.push_back(row.value);
    errors.insert(errors.end(), {row.error, row.bound});
    error.push_back({row.value, row.error});
    bound.push_back({row.value, row.bound});
  }
  x.fit(values);
  y.fit(errors);
  Chart chart(filter.filter + " along " + filter.axis, x, y);
  chart.line(bound, 0, "front", "bound");
  chart.line(error, 0, "line", "error");
  for (const Point& p : error) chart.mark(p, 0, 0, short_number(p.y) + " at " + short_number(p.x), 0);
  chart.legend_color("shader against double", 0);
  chart.legend_color("dashed: bound", 10);
  return chart;
}

void write_stability_charts(const Stability& stability, const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < stability.axes.size(); ++i)
    write_text(folder / ("stability_" + std::to_string(i) + ".svg"),
               stability_chart(stability.axes[i]).standalone());
  for (std::size_t i = 0; i < stability.filters.size(); ++i)
    write_text(folder / ("filter_limits_" + std::to_string(i) + ".svg"),
               filter_chart(stability.filters[i]).standalone());
}

std::string stability_section(const Stability& stability) {
  std::string out;
  if (!stability.axes.empty()) {
    out +=
        "<p>Each chart varies one stress parameter up to its limits. Errors are distances in the map, in "
        "texels, at the corners of its body and at points between: the worst over warps, fits and scenes. "
        "<b>Double against long double</b>: the plan against exact arithmetic with the same parameters. "
        "<b>Float</b>: a shader's result, from absolute coordinates and from offsets to the camera.</p>\n";
    out += axes_table(stability);
    for (std::size_t i = 0; i < stability.axes.size(); ++i)
      out += stability_chart(stability.axes[i]).embedded("stability-" + std::to_string(i));
  }
  if (!stability.cases.empty()) out += "<h3>Extreme cases</h3>\n" + cases_table(stability);
  if (!stability.filters.empty()) {
    out += "<h3>Filters at their limits</h3>\n" + filters_table(stability);
    out += "<details><summary>a chart for each of them</summary>\n";
    for (std::size_t i = 0; i < stability.filters.size(); ++i)
      out += filter_chart(stability.filters[i]).embedded("filter-limits-" + std::to_string(i));
    out += "</details>\n";
  }
  return out;
}

}  // namespace gnomon::report
