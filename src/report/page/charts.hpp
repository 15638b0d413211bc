// The report's charts: which numbers they show.
#pragma once

#include <string>
#include <vector>

#include "chart.hpp"
#include "summary.hpp"

namespace gnomon::report {

/// Error against run time, a mark per technique, with the front of those that nothing beats.
[[nodiscard]] Chart error_time_chart(const Summary& summary, std::size_t scene);
/// The time it takes each filter, with its best parametrization, to come below an error.
[[nodiscard]] Chart time_to_error_chart(const Summary& summary, std::size_t scene);
/// A measure along the flight of a scene, a line for each of `techniques`.
[[nodiscard]] Chart flight_chart(const Summary& summary, const std::vector<Row>& rows, std::size_t scene,
                                 std::size_t measure, const std::vector<std::size_t>& techniques);
/// One line about a technique on a scene, for hovering.
[[nodiscard]] std::string tip_of(const Summary& summary, std::size_t scene, std::size_t technique);
[[nodiscard]] std::string label_of(const Measure& measure);

/// Techniques that a chart of a flight draws, at most.
inline constexpr std::size_t kFlightLines = 8;
/// Techniques of the scene's front at the default axes, at most `limit`, and never none where one was
/// measured.
[[nodiscard]] std::vector<std::size_t> notable(const Summary& summary, std::size_t scene, std::size_t limit);

}  // namespace gnomon::report
