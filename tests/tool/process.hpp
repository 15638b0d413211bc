// Runs the `gnomon` program as a user would, without a shell between.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::test {

struct Finished {
  int exit_code = -1;  ///< 128 + signal number where a signal ended it
  std::string out, err;
  [[nodiscard]] std::vector<std::string> lines() const;  ///< of `out`
};

/// Runs the program with these arguments and standard input, in a process forked from the test's own: most of the time
/// of a short run is loading the program. For tests that drew nothing before, whose driver has no threads yet.
/// `out_file`: where standard output goes instead of Finished::out, if not empty. A run that hangs is ended;
/// `err` has what its threads did.
[[nodiscard]] Finished run_gnomon(const std::vector<std::string>& arguments, const std::string& input = {},
                                  const std::filesystem::path& out_file = {});

/// The same with the program as it is installed, from its file.
[[nodiscard]] Finished spawn_gnomon(const std::vector<std::string>& arguments, const std::string& input = {},
                                    const std::filesystem::path& out_file = {});

/// What both are made of: `run` is called in the new process with the program's name and arguments.
[[nodiscard]] Finished run_process(const std::vector<std::string>& arguments, const std::string& input,
                                   const std::filesystem::path& out_file, int (*run)(std::vector<char*>& argv));

/// How many lines a program's messages have, those of its progress aside: a slow machine prints some.
[[nodiscard]] std::ptrdiff_t message_lines(const std::string& err);

/// Processor time that a process took so far, in all its threads; 0 once it has ended.
[[nodiscard]] std::chrono::nanoseconds processor_time(pid_t process);

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
