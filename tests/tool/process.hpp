// Runs the `gnomon` program as a user would, without a shell between.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::test {

struct Finished {
  int exit_code = -1;  ///< 128 + signal number where a signal ended it
  std::string out, err;
  [[nodiscard]] std::vector<std::string> lines() const;  ///< of `out`
};

/// Runs the program with these arguments and standard input. `out_file`: where standard output goes instead
/// of Finished::out, if not empty. A run of four minutes is ended; `err` has what its threads did.
[[nodiscard]] Finished run_gnomon(const std::vector<std::string>& arguments, const std::string& input = {},
                                  const std::filesystem::path& out_file = {});

/// A file as a whole; empty where it cannot be read.
[[nodiscard]] std::string content_of(const std::filesystem::path& file);

/// A folder of its own for a test, removed with its content at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a file into it and returns its full name.
  [[nodiscard]] std::string write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

}  // namespace gnomon::test
