// The stress test for people: a line per case, a line per axis with its worst.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>

#include "rows.hpp"

namespace gnomon::stress {
namespace {

std::string number(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

std::vector<AxisRow> rows_of(const Results& results, std::string_view axis) {
  std::vector<AxisRow> rows;
  std::copy_if(results.axes.begin(), results.axes.end(), std::back_inserter(rows),
               [&](const AxisRow& row) { return row.axis == axis; });
  return rows;
}

/// "1.2e-3 (optimal x4 at 1e9)"
template <typename Get>
std::string worst_text(const std::vector<AxisRow>& rows, Get get) {
  const AxisRow* row = worst_row(rows, get);
  if (row == nullptr) return "-";
  return number(get(*row)) + " (" + row->variant + " at " + number(row->value) + ")";
}

template <typename Get>
std::string half_texel_text(const std::vector<AxisRow>& rows, Get get) {
  const auto range = beyond_half_texel(rows, get);
  if (!range) return "nowhere";
  const auto [low, high] = *range;
  return low == high ? number(low) : number(low) + " to " + number(high);
}

std::string fallbacks(const std::vector<AxisRow>& rows) {
  constexpr std::size_t kShown = 4;
  const std::vector<const AxisRow*> changes = changes_of_use(rows);
  std::string text;
  for (std::size_t i = 0; i < std::min(changes.size(), kShown); ++i)
    text += i == 0 ? changes[i]->used : "; " + changes[i]->used + " from " + number(changes[i]->value);
  if (changes.size() > kShown) text += "; " + std::to_string(changes.size() - kShown) + " changes more";
  return text;
}

std::string axis_line(const Results& results, const Axis& axis) {
  const std::vector<AxisRow> rows = rows_of(results, axis.name);
  if (rows.empty()) return {};
  const auto error = [](const AxisRow& r) { return r.worst.error_texels; };
  const auto relative = [](const AxisRow& r) { return r.worst.float_relative_texels; };
  const auto absolute = [](const AxisRow& r) { return r.worst.float_absolute_texels; };
  const AxisRow* worst = worst_row(rows, error);
  return "| " + std::string(axis.name) + " | " + worst_text(rows, error) + " | " +
         (worst == nullptr ? "-" : number(worst->worst.error_ulp)) + " | " + worst_text(rows, relative) +
         " | " + half_texel_text(rows, relative) + " | " + half_texel_text(rows, absolute) + " | " +
         worst_text(rows, [](const AxisRow& r) { return r.worst.condition; }) + " | " +
         worst_text(rows, [](const AxisRow& r) { return r.jump; }) + " | " + fallbacks(rows) + " |\n";
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
      out += "| " + std::to_string(row.row) + " | " + row.input + " | " + row.verdict + " | " + row.required +
             " | " + row.found + " |\n";
    out += "\n";
  }
  if (!results.axes.empty()) {
    out +=
        "| parameter | double against long double, texels | ulp | float relative to the camera, texels | "
        "over "
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
        "| parameter | filter | largest error | at | bound there | results beyond their bound | results in "
        "[0, 1] "
        "|\n"
        "|--|--|--|--|--|--|--|\n";
    for (auto row = results.filters.begin(); row != results.filters.end();) {
      const auto end = std::find_if(row, results.filters.end(), [&](const FilterRow& other) {
        return other.axis != row->axis || other.filter != row->filter;
      });
      const FilterRow worst = worst_of_filter(std::vector<FilterRow>(row, end));
      out += "| " + worst.axis + " | " + worst.filter + " | " + number(worst.error) + " | " +
             number(worst.value) + " | " + number(worst.bound) + " | " + number(worst.beyond) + " | " +
             (worst.within ? "yes" : "no") + " |\n";
      row = end;
    }
  }
  return out;
}

}  // namespace gnomon::stress
