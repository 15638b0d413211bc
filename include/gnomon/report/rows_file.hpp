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

/// Keeps a folder of results for one writer while it lives; it ends with the process, however that ends.
/// Take it before the rows are read that decide what is written.
class ResultsLock {
 public:
  /// The folder must exist. Throws ReportError where another writer holds it ("in use by process N"), or
  /// nothing can be written there.
  explicit ResultsLock(const std::filesystem::path& folder);
  /// Takes the lock of `other`, which then holds none.
  ResultsLock(ResultsLock&& other) noexcept;
  ~ResultsLock();
  ResultsLock(const ResultsLock&) = delete;
  ResultsLock& operator=(const ResultsLock&) = delete;
  ResultsLock& operator=(ResultsLock&&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Appends rows; each is on the disk when append() returns.
class RowsFile {
 public:
  /// Opens the file or makes it, and locks its folder. An unfinished last line, which a killed run leaves, is
  /// cut off. Throws ReportError.
  explicit RowsFile(const std::filesystem::path& file);
  /// The same, in a folder that is locked already.
  RowsFile(const std::filesystem::path& file, ResultsLock lock);
  ~RowsFile();
  RowsFile(const RowsFile&) = delete;
  RowsFile& operator=(const RowsFile&) = delete;
  /// Throws ReportError where the disk does not take it; the file is then as it was before.
  void append(const Row& row);

 private:
  ResultsLock lock_;
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::size_t size_ = 0;  ///< of the file, in bytes
};

/// All rows of a file, or of `kRowsFile` in a folder. Lines that are not whole, as killed runs leave them,
/// are skipped, with one warning for all of them. Any other line that is no row is refused: throws
/// ReportError with file and line.
[[nodiscard]] std::vector<Row> read_rows(const std::filesystem::path& path,
                                         std::vector<std::string>* warnings = nullptr);

/// The same from text in memory; `name` stands in front of errors. Throws ReportError.
[[nodiscard]] std::vector<Row> rows_from_text(std::string_view text, const std::string& name,
                                              std::vector<std::string>* warnings = nullptr);

/// Which files of scenes rows were measured with: one for each name.
class SceneHashes {
 public:
  /// False where the scene is known under another hash. One that is empty says nothing.
  [[nodiscard]] bool agree(const std::string& scene, const std::string& hash);

 private:
  std::map<std::string, std::string> known_;
};

/// Writes the rows of `folders` to `out`, ordered by their place in the sweep; of rows with the same key the
/// first stands. Their pictures are copied along. Rows of one scene under different hashes are refused, and
/// so is a folder `out` that is locked. Returns how many there are. Warnings as read_rows. Throws
/// ReportError.
std::size_t merge_rows(std::span<const std::filesystem::path> folders, const std::filesystem::path& out,
                       std::vector<std::string>* warnings = nullptr);

}  // namespace gnomon::report
