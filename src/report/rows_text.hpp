// Rows from text that is already in memory.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gnomon/report/row.hpp"

namespace gnomon::report {

/// read_rows on text; `name` stands in front of errors and warnings. Throws ReportError.
[[nodiscard]] std::vector<Row> rows_from_text(std::string_view text, const std::string& name,
                                              std::vector<std::string>* warnings = nullptr);

}  // namespace gnomon::report
