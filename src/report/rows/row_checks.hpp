// Which rows would mislead whoever compares their means? Repeated ones, and techniques without some frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/report/row.hpp"

namespace gnomon::report {

/// Drops all but the first of rows that are the same measurement, and the pictures of rows that lack one in
/// `folder`. Returns a line for each kind of what was dropped, and for each scene whose techniques lack
/// frames.
[[nodiscard]] std::vector<std::string> check_rows(const std::filesystem::path& folder,
                                                  std::vector<Row>& rows);

}  // namespace gnomon::report
