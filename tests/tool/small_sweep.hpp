// A sweep small enough to run often, and what lasts of its rows.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/report/rows_file.hpp"
#include "process.hpp"

namespace gnomon::test {

namespace fs = std::filesystem;

/// Four techniques on two frames of one scene: small enough to run often.
inline std::vector<std::string> small_sweep(const fs::path& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"compare", "builtin:fence", "--warps",     "none,lispsm", "--cascades",
                                     "1",       "--filters",     "hard,pcf",    "--frames",    "2",
                                     "--size",  "64x36",         "--map-sizes", "128",         "--rounds",
                                     "1",       "--context",     "osmesa",      "--out",       out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}
inline constexpr std::size_t kSmallRows = 8;

/// Runs the program, and shows its messages where it fails.
inline void expect_success(const std::vector<std::string>& arguments) {
  const Finished finished = run_gnomon(arguments);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
}

inline std::vector<std::string> lasting(const fs::path& folder) {
  std::vector<std::string> lines;
  for (const report::Row& row : report::read_rows(folder)) lines.push_back(report::without_times(row));
  return lines;
}

/// The whole sweep, measured once for all tests.
inline const fs::path& whole() {
  static const TemporaryFolder folder;
  static const fs::path out = [] {
    fs::path path = folder.path() / "whole";
    const Finished finished = spawn_gnomon(small_sweep(path));
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return path;
  }();
  return out;
}

}  // namespace gnomon::test
