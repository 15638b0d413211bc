// Does the error that plans are expected to have agree with the one that was measured?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chart.hpp"
#include "gnomon/report/row.hpp"

namespace gnomon::report {

/// Over the rows of hard comparison whose error was expected.
struct ExpectedCheck {
  std::size_t rows = 0;      ///< with at least kCountedPixels misclassified
  std::size_t without = 0;   ///< of them, that were expected to misclassify none
  double within = 0.0;       ///< share of them that are expected within a factor of kAlike
  double ratio = 0.0;        ///< geometric mean of expected over measured, where some were expected
  std::size_t views = 0;     ///< frames of a scene with at least kCountedRows of them, whose errors differ
  double correlation = 0.0;  ///< mean over the views of the rank correlation of expected and measured
};
inline constexpr double kAlike = 1.3;
/// Fewer pixels are mostly chance.
inline constexpr double kCountedPixels = 30.0;
inline constexpr std::size_t kCountedRows = 4;

[[nodiscard]] ExpectedCheck check_expected(const std::vector<Row>& rows);
/// Nothing where no row counts.
[[nodiscard]] std::optional<Chart> expected_chart(const std::vector<Row>& rows);
/// Heading, chart and figures; empty where no row counts.
[[nodiscard]] std::string expected_part(const std::vector<Row>& rows);

}  // namespace gnomon::report
