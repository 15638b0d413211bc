// What `gnomon stress` found: the rows of its file, and their charts.
#include "stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "file.hpp"
#include "gnomon/report/row.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kHalfTexel = 0.5;

double number(const Json& json, const char* key, double for_null = kInfinity) {
  const Json& value = json.at(key);
  return value.is_null() ? for_null : value.get<double>();
}

/// The library's own conversion would take 1e300 for an int.
int whole(const Json& json, const char* key) {
  const Json& value = json.at(key);
  const bool fits = value.is_number_unsigned()
                        ? std::in_range<int>(value.get<std::uint64_t>())
                        : value.is_number_integer() && std::in_range<int>(value.get<std::int64_t>());
  if (!fits) throw ReportError(std::string(key) + ": wants a whole number");
  return value.get<int>();
}

template <typename Entry>
Entry& entry_of(std::vector<Entry>& entries, const Entry& wanted, bool (*same)(const Entry&, const Entry&)) {
  const auto at =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return same(e, wanted); });
  return at != entries.end() ? *at : entries.emplace_back(wanted);
}

void add_axis_row(const Json& json, Stability& stability) {
  const StabilityAxis wanted{json.at("axis"), json.at("label"), json.at("log"), {}};
  StabilityAxis& axis = entry_of<StabilityAxis>(
      stability.axes, wanted,
      [](const StabilityAxis& a, const StabilityAxis& b) { return a.name == b.name; });
  StabilityRow row{json.at("variant"), json.at("status"), json.at("used"), json.at("left_out")};
  row.value = number(json, "value");
  row.maps = whole(json, "maps");
  row.error_texels = number(json, "error_texels");
  row.error_ulp = number(json, "error_ulp");
  row.float_absolute_texels = number(json, "float_absolute_texels");
  row.float_relative_texels = number(json, "float_relative_texels");
  row.condition = number(json, "condition");
  row.jump = number(json, "jump", kNone);
  axis.rows.push_back(std::move(row));
}

void add_filter_row(const Json& json, Stability& stability) {
  const StabilityFilter wanted{json.at("axis"), json.at("label"), json.at("filter"), json.at("log"), {}};
  StabilityFilter& filter = entry_of<StabilityFilter>(stability.filters, wanted,
                                                      [](const StabilityFilter& a, const StabilityFilter& b) {
                                                        return a.axis == b.axis && a.filter == b.filter;
                                                      });
  filter.rows.push_back({number(json, "value"), number(json, "error"), number(json, "bound"),
                         number(json, "beyond"), json.at("within").get<bool>()});
}

void add_line(const Json& json, Stability& stability) {
  const std::string kind = json.value("kind", std::string());
  if (kind == "axis") add_axis_row(json, stability);
  if (kind == "filter") add_filter_row(json, stability);
  if (kind == "case")
    stability.cases.push_back(
        {whole(json, "row"), json.at("input"), json.at("required"), json.at("verdict"), json.at("found")});
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

double absolute_of(const StabilityRow& row) {
  return row.float_absolute_texels;
}
double relative_of(const StabilityRow& row) {
  return row.float_relative_texels;
}
double exact_of(const StabilityRow& row) {
  return row.error_texels;
}

struct Line {
  const char* name;
  double (*of)(const StabilityRow& row);
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
  for (const StabilityRow& row : axis.rows) {
    if (row.variant != "optimal" || row.used == before) continue;
    if (!before.empty())
      chart.mark({row.value, row.maps > 0 ? row.error_texels : 0.0}, kColor, kFallbackMark,
                 "at " + short_number(row.value) + ": " + row.used + " instead of " + before, 0);
    before = row.used;
  }
}

}  // namespace

Stability read_stability(const std::string& text, const std::string& where) {
  Stability stability;
  std::size_t number = 0;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    ++number;
    if (end == begin) continue;
    const std::string line = where + ":" + std::to_string(number);
    try {
      check_nesting(std::string_view(text).substr(begin, end - begin));
    } catch (const ReportError& error) {
      throw ReportError(line + ": " + error.what());
    }
    const Json json = Json::parse(text.substr(begin, end - begin), nullptr, false);
    if (!json.is_object()) throw ReportError(line + ": not a JSON object");
    try {
      add_line(json, stability);
    } catch (const Json::exception&) {
      throw ReportError(line + ": not a row of gnomon stress");
    } catch (const ReportError& error) {
      throw ReportError(line + ": " + error.what());
    }
  }
  const auto by_value = [](const auto& a, const auto& b) { return a.value < b.value; };
  for (StabilityAxis& axis : stability.axes) std::stable_sort(axis.rows.begin(), axis.rows.end(), by_value);
  for (StabilityFilter& filter : stability.filters)
    std::stable_sort(filter.rows.begin(), filter.rows.end(), by_value);
  return stability;
}

Chart stability_chart(const StabilityAxis& axis) {
  Axis x{axis.label, axis.logarithmic}, y{"error, texels"};
  std::vector<double> values, errors{kHalfTexel};
  for (const StabilityRow& row : axis.rows) {
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
  chart.legend_mark("something else is used", kFallbackMark);
  return chart;
}

Chart filter_chart(const StabilityFilter& filter) {
  Axis x{filter.label, filter.logarithmic}, y{"error of the answer"};
  std::vector<double> values, errors;
  std::vector<Point> error, bound;
  for (const StabilityFilterRow& row : filter.rows) {
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

}  // namespace gnomon::report
