// The report: one file of HTML that needs nothing else, and its charts and tables as files of their own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::report {

/// Reads from `folder` its rows, its `stability.jsonl` (what gnomon stress writes) and its `gpu`
/// (gpu_files.hpp), or one of them; writes there
///   report.html         all of it, opens offline, readable without scripts,
///   charts/NAME.svg     the charts,
///   summary.csv         a line per scene and technique,
///   frames.csv          a line per row,
///   views.csv           medians over views with their intervals, a line per technique,
///   kinds.csv           the same, a line per kind of scene and technique,
///   pairs.csv           techniques that differ in one choice, and what it changes,
///   budgets.json        the technique of least error for each budget of time, with the machine,
///   fronts.md           what no other technique beats on each scene, as tables,
///   tables.tex          the same for LaTeX,
///   method.tex          how it was measured, for LaTeX.
/// Files that are there already are replaced, each as a whole. A folder with none of them is refused.
/// Warnings are those of read_rows, and lines about repeated rows, missing frames and absent pictures. Throws
/// ReportError. Returns the path of the page.
std::filesystem::path write_report(const std::filesystem::path& folder,
                                   std::vector<std::string>* warnings = nullptr);

}  // namespace gnomon::report
