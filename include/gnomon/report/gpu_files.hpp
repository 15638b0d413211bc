// Rows that were measured on GPUs, for the report.
#pragma once

#include <filesystem>
#include <span>

namespace gnomon::report {

/// Copies files that `measure_gpu` of the portable folder wrote into `folder`/gpu, numbered in this order.
/// The report of the folder then has a column for each. Throws ReportError where a file names no machine.
void add_gpu_files(const std::filesystem::path& folder, std::span<const std::filesystem::path> files);

}  // namespace gnomon::report
