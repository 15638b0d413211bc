// Rows of the stress test as JSON lines, CSV and tables.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "axes.hpp"
#include "cases.hpp"

namespace gnomon::stress {

struct Results {
  std::vector<CaseRow> cases;
  std::vector<AxisRow> axes;
  std::vector<FilterRow> filters;
  [[nodiscard]] bool all_hold() const noexcept;
};

/// A JSON object per line, "kind" first: case, axis, filter. Numbers that are not finite are null.
[[nodiscard]] std::string json_lines(const Results& results);
/// The same with a line of names on top; fields that a kind does not have are empty.
[[nodiscard]] std::string csv(const Results& results);
/// Tables in Markdown: the verdict of each case, the worst of each axis.
[[nodiscard]] std::string tables(const Results& results);

}  // namespace gnomon::stress
