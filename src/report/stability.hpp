// What `gnomon stress` found, as charts and tables.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "chart.hpp"

namespace gnomon::report {

/// A plan at one value of a stiff axis. Infinite where the file says null.
struct StabilityRow {
  std::string variant, status, used, left_out;
  double value = 0.0;
  int maps = 0;
  double error_texels = 0.0, error_ulp = 0.0;
  double float_absolute_texels = 0.0, float_relative_texels = 0.0;
  double condition = 0.0;
  double jump = std::numeric_limits<double>::quiet_NaN();  ///< NaN: there was no next value
};
struct StabilityAxis {
  std::string name, label;
  bool logarithmic = true;
  std::vector<StabilityRow> rows;  ///< by value
};
struct StabilityCase {
  int row = 0;
  std::string input, required, verdict, found;
};
/// A filter at one value of what strains it.
struct StabilityFilterRow {
  double value = 0.0, error = 0.0, bound = 0.0;
  double beyond = 0.0;  ///< share of the answers that are off by more than their own bound
  bool within = true;
};
struct StabilityFilter {
  std::string axis, label, filter;
  bool logarithmic = true;
  std::vector<StabilityFilterRow> rows;
};
struct Stability {
  std::vector<StabilityAxis> axes;
  std::vector<StabilityCase> cases;
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
