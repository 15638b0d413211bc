// The report: one file of HTML that needs nothing else, and its charts and tables as files of their own.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::report {

/// Reads the rows in `folder` and, where they are, `stability.jsonl`; writes there
///   report.html         all of it, opens offline, readable without scripts,
///   charts/NAME.svg     the charts,
///   summary.csv         a line per scene and technique, frames.csv one per row.
/// Throws ReportError. Returns the path of the page.
std::filesystem::path write_report(const std::filesystem::path& folder);

}  // namespace gnomon::report
