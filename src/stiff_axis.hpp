// What a table says of a stiff axis or of a strained filter: the worst row, where floats are off, where what
// is used changes. For the program's tables and the report's, whose rows are types of their own.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon {

/// The row with maps in which `get` is largest, the first of equals; nullptr where none has a value.
template <class Row, class Get>
[[nodiscard]] const Row* worst_row(const std::vector<Row>& rows, Get get) {
  const Row* worst = nullptr;
  for (const Row& row : rows) {
    if (row.maps == 0 || std::isnan(get(row))) continue;
    if (worst == nullptr || get(row) > get(*worst)) worst = &row;
  }
  return worst;
}

/// The first and the last value of the axis at which `get` is above half a texel: from there on a shader may
/// read another texel than it should.
template <class Row, class Get>
[[nodiscard]] std::optional<std::pair<double, double>> beyond_half_texel(const std::vector<Row>& rows,
                                                                         Get get) {
  constexpr double kHalfTexel = 0.5;
  std::optional<std::pair<double, double>> range;
  for (const Row& row : rows) {
    if (row.maps == 0 || !(get(row) > kHalfTexel)) continue;
    if (!range) range.emplace(row.value, row.value);
    range->second = row.value;
  }
  return range;
}

/// Rows of the map that may choose its warp at which it uses something else than at the value before; the
/// first of them is the first row.
template <class Row>
[[nodiscard]] std::vector<const Row*> changes_of_use(const std::vector<Row>& rows) {
  std::vector<const Row*> changes;
  for (const Row& row : rows) {
    if (row.variant == "optimal" && (changes.empty() || row.used != changes.back()->used))
      changes.push_back(&row);
  }
  return changes;
}

/// Of a filter along what strains it: the row of the largest error, with the largest `beyond` of all rows,
/// and `within` where all are. `rows` is not empty.
template <class Row>
[[nodiscard]] Row worst_of_filter(const std::vector<Row>& rows) {
  Row worst = rows.front();
  double beyond = 0.0;
  bool within = true;
  for (const Row& row : rows) {
    if (row.error > worst.error) worst = row;
    beyond = std::max(beyond, row.beyond);
    within = within && row.within;
  }
  worst.beyond = beyond;
  worst.within = within;
  return worst;
}

}  // namespace gnomon
