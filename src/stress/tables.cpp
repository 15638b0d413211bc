// The stress test for people: a line per case, a line per axis with its worst.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "rows.hpp"

namespace gnomon::stress {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string number(double value) {
  if (std::isnan(value)) return "-";
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

/// The rows of one axis.
std::vector<const AxisRow*> rows_of(const Results& results, std::string_view axis) {
  std::vector<const AxisRow*> rows;
  for (const AxisRow& row : results.axes) {
    if (row.axis == axis) rows.push_back(&row);
  }
  return rows;
}

struct Worst {
  double value = kNone;
  const AxisRow* row = nullptr;
  /// "1.2e-3 (optimal x4 at 1e9)"
  [[nodiscard]] std::string text() const {
    if (row == nullptr) return "-";
    return number(value) + " (" + std::string(row->variant) + " at " + number(row->value) + ")";
  }
};

template <typename Get>
Worst worst_of(const std::vector<const AxisRow*>& rows, Get get) {
  Worst worst;
  for (const AxisRow* row : rows) {
    const double value = get(*row);
    if (row->maps == 0 || std::isnan(value) || value <= worst.value) continue;
    worst = {value, row};
  }
  return worst;
}

/// The values at which floats are off by more than half a texel, from the first to the last.
template <typename Get>
std::string beyond_half_texel(const std::vector<const AxisRow*>& rows, Get get) {
  constexpr double kHalf = 0.5;
  double low = kNone, high = kNone;
  for (const AxisRow* row : rows) {
    if (row->maps == 0 || get(*row) <= kHalf) continue;
    if (std::isnan(low)) low = row->value;
    high = row->value;
  }
  if (std::isnan(low)) return "nowhere";
  return low == high ? number(low) : number(low) + " to " + number(high);
}

/// Where what is used changes along the axis, for the map that may choose its warp.
std::string fallbacks(const std::vector<const AxisRow*>& rows) {
  std::string text, before;
  int changes = 0;
  constexpr int kShown = 4;
  for (const AxisRow* row : rows) {
    if (row->variant != "optimal" || row->used == before) continue;
    if (changes++ < kShown)
      text += (text.empty() ? "" : "; ") + row->used + (before.empty() ? "" : " from " + number(row->value));
    before = row->used;
  }
  if (changes > kShown) text += "; " + std::to_string(changes - kShown) + " changes more";
  return text;
}

std::string axis_line(const Results& results, const Axis& axis) {
  const std::vector<const AxisRow*> rows = rows_of(results, axis.name);
  if (rows.empty()) return {};
  const Worst error = worst_of(rows, [](const AxisRow& r) { return r.worst.error_texels; });
  const auto relative = [](const AxisRow& r) { return r.worst.float_relative_texels; };
  const auto absolute = [](const AxisRow& r) { return r.worst.float_absolute_texels; };
  std::string line = "| " + std::string(axis.name) + " | " + error.text() + " | " +
                     (error.row == nullptr ? "-" : number(error.row->worst.error_ulp)) + " | " +
                     worst_of(rows, relative).text() + " | " + beyond_half_texel(rows, relative) + " | " +
                     beyond_half_texel(rows, absolute) + " | " +
                     worst_of(rows, [](const AxisRow& r) { return r.worst.condition; }).text() + " | " +
                     worst_of(rows, [](const AxisRow& r) { return r.jump; }).text() + " | ";
  return line + fallbacks(rows) + " |\n";
}

std::string escaped_bars(std::string text) {
  for (std::size_t at = 0; (at = text.find(" | ", at)) != std::string::npos;) text.replace(at, 3, " / ");
  return text;
}

}  // namespace

std::string tables(const Results& results) {
  std::string out;
  if (!results.cases.empty()) {
    out += "| row | case | verdict | required | found |\n|--|--|--|--|--|\n";
    for (const CaseRow& row : results.cases)
      out += "| " + std::to_string(row.row) + " | " + std::string(row.input) + " | " +
             std::string(row.verdict) + " | " + std::string(row.required) + " | " + row.found + " |\n";
    out += "\n";
  }
  if (!results.axes.empty()) {
    out +=
        "| axis | double against long double, texels | ulp | float relative to the camera, texels | over "
        "half a "
        "texel at | absolute float over half a texel at | condition | texels per area, change for a step of "
        "1e-6 | "
        "used |\n|--|--|--|--|--|--|--|--|--|\n";
    Results flat = results;
    for (AxisRow& row : flat.axes) row.used = escaped_bars(row.used);
    for (const Axis& axis : all_axes()) out += axis_line(flat, axis);
    out += "\n";
  }
  if (!results.filters.empty()) {
    out +=
        "| strain | filter | largest error | at | bound there | share beyond their bound | answers in [0, 1] "
        "|\n"
        "|--|--|--|--|--|--|--|\n";
    for (std::size_t i = 0; i < results.filters.size();) {
      const FilterRow& first = results.filters[i];
      FilterRow worst = first;
      for (; i < results.filters.size() && results.filters[i].axis == first.axis &&
             results.filters[i].filter == first.filter;
           ++i) {
        const FilterRow& row = results.filters[i];
        const double beyond = std::max(worst.beyond, row.beyond);
        const bool within = worst.within && row.within;
        if (row.error > worst.error) worst = row;
        worst.beyond = beyond;
        worst.within = within;
      }
      out += "| " + worst.axis + " | " + worst.filter + " | " + number(worst.error) + " | " +
             number(worst.value) + " | " + number(worst.bound) + " | " + number(worst.beyond) + " | " +
             (worst.within ? "yes" : "no") + " |\n";
    }
  }
  return out;
}

}  // namespace gnomon::stress
