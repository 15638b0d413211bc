// How sure is a difference between techniques: over how many views does it hold?
// Based on: Efron, Bootstrap Methods: Another Look at the Jackknife, 1979; the sign test of Arbuthnot, 1710.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "chart.hpp"
#include "gnomon/report/statistics.hpp"
#include "summary.hpp"

namespace gnomon::report {

/// What is gathered over views, by the keys of measures().
inline constexpr std::array<std::string_view, 6> kOverViews{"wrong",   "pixel_error", "mean_error",
                                                            "twinkle", "ratio",       "total_ms"};
/// Of them, the errors that techniques are chosen by.
inline constexpr std::array<std::string_view, 3> kErrors{"wrong", "pixel_error", "twinkle"};
/// A sign test below this chance makes a difference sure.
inline constexpr double kSure = 0.05;

/// "1.2 % (1.1 to 1.4)".
[[nodiscard]] std::string with_interval(const Measure& measure, const Estimate& e);

/// A view is a flight through one scene under one light, or its only frame: frames of one flight are too
/// alike to count each for itself. Its errors are means of the frames by their pixels, its times plain means.
/// Frames of fewer than kFewestPixels evaluated pixels do not count.
struct ViewTable {
  std::size_t views = 0;    ///< that count
  std::size_t dropped = 0;  ///< without a frame that counts
  std::string error;  ///< key that techniques are compared by: pixel_error, or wrong where that is missing
  /// [measure of kOverViews][technique of the summary][view]; not a number where it was not measured.
  std::array<std::vector<std::vector<double>>, kOverViews.size()> values;
  /// Median time of the baseline over that of the same baseline once more, in the rounds of each timed frame.
  std::vector<double> again;

  /// Median over the views with its interval; nothing where no view has it.
  [[nodiscard]] std::optional<Estimate> over(std::string_view measure, std::size_t technique) const;
  /// Techniques that a view has, by their median error, least first.
  [[nodiscard]] std::vector<std::size_t> by_median() const;
  /// True where every view has it.
  [[nodiscard]] bool everywhere(std::string_view measure, std::size_t technique) const;
  /// In how many views the first has the smaller value.
  [[nodiscard]] SignTest compared(std::string_view measure, std::size_t first, std::size_t second) const;
  /// Times of the same technique differ by less than this factor in 95 % of the frames; 1: not measured.
  [[nodiscard]] double noise() const;
};
[[nodiscard]] ViewTable view_table(const std::vector<Row>& rows, const Summary& summary);

/// Medians of error and time with their intervals, and how far times are noise.
[[nodiscard]] Chart view_chart(const ViewTable& table, const Summary& summary);
/// Heading, chart, medians and the pairs; empty where no view counts.
[[nodiscard]] std::string view_part(const std::vector<Row>& rows, const Summary& summary);
/// `head` names the columns of a technique, which `columns` writes.
[[nodiscard]] std::string views_csv(const std::vector<Row>& rows, const Summary& summary,
                                    const std::string& head, std::string (*columns)(const Technique&));

}  // namespace gnomon::report
