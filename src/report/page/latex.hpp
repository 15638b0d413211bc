// Tables and a section on method for a paper, in LaTeX.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "summary.hpp"

namespace gnomon::report {

/// Text in which no character has a meaning to LaTeX; what is not ASCII becomes '?'.
[[nodiscard]] std::string latex_text(std::string_view text);
/// Two tables for `booktabs`: medians over views with intervals, and the best technique of each kind of
/// scene. The second is missing where views have no kind.
[[nodiscard]] std::string latex_tables(const std::vector<Row>& rows, const Summary& summary);
/// How the rows were measured, as paragraphs.
[[nodiscard]] std::string latex_method(const std::vector<Row>& rows, const Summary& summary);

}  // namespace gnomon::report
