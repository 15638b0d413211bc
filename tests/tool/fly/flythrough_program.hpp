// Runs the flythrough program and tells what it answered.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace flythrough_test {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out, error;
};

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Flythrough : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("flythrough_" + std::to_string(::getpid()) + "_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path out() const { return folder_ / "pictures"; }
  /// `before`: of the shell, in front of the program.
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& before = "",
                            const std::string& folder = "") const {
    const std::string command = before + " env -u DISPLAY -u WAYLAND_DISPLAY " FLYTHROUGH " --out " +
                                (folder.empty() ? out().string() : folder) + " " + arguments + " > " +
                                (folder_ / "out").string() + " 2> " + (folder_ / "error").string();
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder_ / "out"),
            text_of(folder_ / "error")};
  }

  fs::path folder_;
};

/// Fields of a line of CSV, quotes taken off.
inline std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

inline constexpr const char* kOneFrame = "builtin:fence --frames 1 --size 64x32 --map-size 64 --cascades 1 ";

}  // namespace flythrough_test
