// What was measured on GPUs and in software, side by side.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gnomon::report {

/// The folder of files that `measure_gpu` of the portable folder wrote, below a folder of results.
inline constexpr const char* kGpuFolder = "gpu";

/// Masks of one kind against those of software.
struct MaskCounts {
  std::size_t masks = 0, equal = 0, pixels = 0, visibly = 0;
  double most = 0.0;  ///< the largest difference of visibility
};

/// Percentiles of a time, milliseconds.
struct GpuTime {
  double p50 = 0.0, p99 = 0.0;
};

/// What one file holds. Keys are what was measured.
struct GpuRun {
  std::string device;   ///< "software", or the renderer that OpenGL names
  std::string machine;  ///< renderer, version, processor
  bool timers_trusted = false;
  std::map<std::string, MaskCounts> masks;     ///< by source: maps, pages, lights ...
  std::map<std::string, GpuTime> wall, timer;  ///< by filter, kernel and map size, or by flight
};

/// Reads rows; those of other parts, and lines that are not whole, are skipped. `where` names the text in
/// errors. Throws ReportError where no row names a machine.
[[nodiscard]] GpuRun read_gpu_run(const std::string& text, const std::string& where);

/// All files of `folder`/gpu, by name; none where there is no such folder. Throws ReportError.
[[nodiscard]] std::vector<GpuRun> read_gpu_runs(const std::filesystem::path& folder);

/// A column for each run; empty without runs.
[[nodiscard]] std::string gpu_section(const std::vector<GpuRun>& runs);

}  // namespace gnomon::report
