// Files of rows that a killed run leaves whole, and many of them made one.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/report/row.hpp"

namespace gnomon::report {

/// Name of the file of rows in a folder of results.
inline constexpr const char* kRowsFile = "results.jsonl";

/// Appends rows; each is on the disk when append() returns.
class RowsFile {
 public:
  /// Opens the file or makes it. What a killed run left of a last, unfinished line is cut off. Throws
  /// ReportError.
  explicit RowsFile(const std::filesystem::path& file);
  ~RowsFile();
  RowsFile(const RowsFile&) = delete;
  RowsFile& operator=(const RowsFile&) = delete;
  /// Throws ReportError where the disk does not take it.
  void append(const Row& row);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// All rows of a file, or of `kRowsFile` in a folder. A last line without its end is left out. Throws
/// ReportError with file and line.
[[nodiscard]] std::vector<Row> read_rows(const std::filesystem::path& path);

/// The same from text in memory; `name` stands in front of errors. Throws ReportError.
[[nodiscard]] std::vector<Row> rows_from_text(std::string_view text, const std::string& name);

/// Which files of scenes rows were measured with: one for each name.
class SceneHashes {
 public:
  /// False where the scene is known under another hash. One that is empty says nothing.
  [[nodiscard]] bool agree(const std::string& scene, const std::string& hash);

 private:
  std::map<std::string, std::string> known_;
};

/// Writes the rows of `folders` to `out`, ordered by their place in the sweep; of rows with the same key the
/// first stands. Their pictures are copied along. Rows of one scene under different hashes are refused.
/// Returns how many there are. Throws ReportError.
std::size_t merge_rows(std::span<const std::filesystem::path> folders, const std::filesystem::path& out);

}  // namespace gnomon::report
