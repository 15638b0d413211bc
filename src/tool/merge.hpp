// `gnomon merge` and `gnomon report`: results of many runs into one folder, and the page again.
#pragma once

#include <string>
#include <vector>

namespace gnomon::tool {

/// Joins the folders' rows and pictures in `out` and writes the report there. Returns the exit code.
int run_merge(const std::vector<std::string>& folders, const std::string& out, bool json);
/// Writes the report of each folder anew. Returns the exit code.
int run_report(const std::vector<std::string>& folders, bool json);

}  // namespace gnomon::tool
