// What `gnomon stress` found, as charts and tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/stress_rows.hpp"
#include "chart.hpp"

namespace gnomon::report {

/// The rows of one stiff axis, by value. Infinite where the file says null.
struct StabilityAxis {
  std::string name, label;
  bool logarithmic = true;
  std::vector<stress::AxisRow> rows;
};
/// The rows of one filter along what strains it, by value.
struct StabilityFilter {
  std::string axis, label, filter;
  bool logarithmic = true;
  std::vector<stress::FilterRow> rows;
};
struct Stability {
  std::vector<StabilityAxis> axes;
  std::vector<stress::CaseRow> cases;
  std::vector<StabilityFilter> filters;
  [[nodiscard]] bool empty() const noexcept { return axes.empty() && cases.empty() && filters.empty(); }
};

/// The rows of a kind that is known; others are left out. `where` names the text in errors. Throws
/// ReportError for a line that is no JSON object, or lacks what its kind has.
[[nodiscard]] Stability read_stability(const std::string& text, const std::string& where);

/// Error in texels over the stiff parameter: double, float, float relative to the camera, the worst over all
/// variants; marks where floats pass half a texel and where the plan takes something else.
[[nodiscard]] Chart stability_chart(const StabilityAxis& axis);
/// Error over what strains the filter, and its bound.
[[nodiscard]] Chart filter_chart(const StabilityFilter& filter);

[[nodiscard]] std::string stability_section(const Stability& stability);
/// charts/stability_N.svg and charts/filter_limits_N.svg. Throws ReportError.
void write_stability_charts(const Stability& stability, const std::filesystem::path& folder);

}  // namespace gnomon::report
