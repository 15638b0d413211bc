// Rows as a sweep would write them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/report/row.hpp"

namespace gnomon::report {

/// Every field set to something of its own.
[[nodiscard]] Row sample_row(std::uint64_t index = 0);
/// `scenes` x `techniques` x 2 frames.
[[nodiscard]] std::vector<Row> sample_rows(int scenes, int techniques);

/// All of a file.
[[nodiscard]] std::string text_of(const std::filesystem::path& file);
/// How often `part` stands in `text`.
[[nodiscard]] std::size_t count(const std::string& text, const std::string& part);

/// A folder of this test's own, empty, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace gnomon::report
