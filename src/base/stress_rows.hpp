// What `gnomon stress` finds, row by row: one type for the program that writes the rows and the report that
// shows them, with the names of their fields and what a table states about them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::stress {

/// How far a plan is from exact arithmetic: the largest of each over the maps of a plan, at the corners of
/// what each map shows and at points between. Errors in texels; 0 where there is no map.
struct Judgement {
  bool finite = true;  ///< every number of the plan
  /// Doubles, as a consumer evaluates them, against long double: the place of a point in the map (its
  /// rectangle refitted to the exact body, its divisor, its grid), and how far a shadow lands from where the
  /// exact light ray leads.
  double error_texels = 0.0;
  double error_ulp = 0.0;              ///< the same in units of the last place of a double of the map's size
  double drift_texels = 0.0;           ///< the part of it that is the light ray's
  double float_absolute_texels = 0.0;  ///< world points and matrix in float
  double float_relative_texels = 0.0;  ///< offsets from the camera and clip_from_camera_relative
  double condition = 0.0;              ///< of the matrix over the map's own body: the map itself
  double condition_world = 0.0;  ///< over all coordinates up to the body's: what absolute coordinates add
};

/// The verdict on one extreme case.
struct CaseRow {
  int row = 0;
  std::string name, input, required;
  std::string verdict;  ///< "holds", "fails", "skipped"
  std::string found;
};

/// A plan at one value of a stiff axis, the worst over its scenes.
struct AxisRow {
  std::string axis, label, variant;
  bool logarithmic = true;
  double value = 0.0;
  std::string status, used, left_out;  ///< each different one once, joined by " | "
  int maps = 0;                        ///< most of any scene
  Judgement worst;
  /// Largest |change| of texels per area at a point of the world for a step of 1e-6 of the value; NaN where
  /// there is no next value.
  double jump = std::numeric_limits<double>::quiet_NaN();
};

/// A filter at one value of something that strains it.
struct FilterRow {
  std::string axis, label, filter;
  bool logarithmic = true;
  double value = 0.0;
  double error = 0.0;   ///< largest distance of the shader's answer from the reference in double
  double bound = 0.0;   ///< largest change of the answer by what formats and hardware round, derived
  double beyond = 0.0;  ///< share of the answers whose error is above their own bound
  bool within = true;   ///< every answer is a number in [0, 1]
};

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The fields of a row as its file names them, "kind" aside: field(name, value) for each, and for numbers
/// field(name, value, what null stands for). `row` may be const.
template <class Row, class Field>
void for_each_field(Row& row, Field&& field) {
  using Type = std::remove_const_t<Row>;
  if constexpr (std::is_same_v<Type, CaseRow>) {
    field("row", row.row);
    field("name", row.name);
    field("input", row.input);
    field("required", row.required);
    field("verdict", row.verdict);
    field("found", row.found);
  } else if constexpr (std::is_same_v<Type, AxisRow>) {
    auto& worst = row.worst;
    field("axis", row.axis);
    field("label", row.label);
    field("log", row.logarithmic);
    field("variant", row.variant);
    field("value", row.value, kInfinite);
    field("status", row.status);
    field("finite", worst.finite);
    field("maps", row.maps);
    field("used", row.used);
    field("left_out", row.left_out);
    field("error_texels", worst.error_texels, kInfinite);
    field("error_ulp", worst.error_ulp, kInfinite);
    field("drift_texels", worst.drift_texels, kInfinite);
    field("float_absolute_texels", worst.float_absolute_texels, kInfinite);
    field("float_relative_texels", worst.float_relative_texels, kInfinite);
    field("condition", worst.condition, kInfinite);
    field("condition_world", worst.condition_world, kInfinite);
    field("jump", row.jump, std::numeric_limits<double>::quiet_NaN());
  } else {
    static_assert(std::is_same_v<Type, FilterRow>);
    field("axis", row.axis);
    field("label", row.label);
    field("log", row.logarithmic);
    field("filter", row.filter);
    field("value", row.value, kInfinite);
    field("error", row.error, kInfinite);
    field("bound", row.bound, kInfinite);
    field("beyond", row.beyond, kInfinite);
    field("within", row.within);
  }
}

/// The row with maps in which `get` is largest, the first of equals; nullptr where none has a value.
template <class Get>
[[nodiscard]] const AxisRow* worst_row(const std::vector<AxisRow>& rows, Get get) {
  const AxisRow* worst = nullptr;
  for (const AxisRow& row : rows) {
    if (row.maps == 0 || std::isnan(get(row))) continue;
    if (worst == nullptr || get(row) > get(*worst)) worst = &row;
  }
  return worst;
}

/// The first and the last value of the axis at which `get` is above half a texel: from there on a shader may
/// read another texel than it should.
template <class Get>
[[nodiscard]] std::optional<std::pair<double, double>> beyond_half_texel(const std::vector<AxisRow>& rows,
                                                                         Get get) {
  constexpr double kHalfTexel = 0.5;
  std::optional<std::pair<double, double>> range;
  for (const AxisRow& row : rows) {
    if (row.maps == 0 || !(get(row) > kHalfTexel)) continue;
    if (!range) range.emplace(row.value, row.value);
    range->second = row.value;
  }
  return range;
}

/// Rows of the map that may choose its warp at which it uses something else than at the value before; the
/// first of them is the first row.
[[nodiscard]] inline std::vector<const AxisRow*> changes_of_use(const std::vector<AxisRow>& rows) {
  std::vector<const AxisRow*> changes;
  for (const AxisRow& row : rows) {
    if (row.variant == "optimal" && (changes.empty() || row.used != changes.back()->used))
      changes.push_back(&row);
  }
  return changes;
}

/// Of a filter along what strains it: the row of the largest error, with the largest `beyond` of all rows,
/// and `within` where all are. `rows` is not empty.
[[nodiscard]] inline FilterRow worst_of_filter(const std::vector<FilterRow>& rows) {
  FilterRow worst = rows.front();
  double beyond = 0.0;
  bool within = true;
  for (const FilterRow& row : rows) {
    if (row.error > worst.error) worst = row;
    beyond = std::max(beyond, row.beyond);
    within = within && row.within;
  }
  worst.beyond = beyond;
  worst.within = within;
  return worst;
}

}  // namespace gnomon::stress
