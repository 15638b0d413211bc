// Output that can fail, on standard output or in files: a plan that did not arrive must not look like
// success.
#include "output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/whole_file.hpp"

namespace gnomon::tool {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error(std::string("standard output: ") + std::strerror(errno));
}

}  // namespace

void print_line(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fputc('\n', stdout) == EOF)
    fail();
}

void flush_output() {
  if (std::fflush(stdout) != 0) fail();
}

void check_folder(const std::string& option, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder, error).lexically_normal();
  while (!std::filesystem::exists(there, error) && there.has_relative_path() && there != there.parent_path())
    there = there.parent_path();
  if (!std::filesystem::is_directory(there, error))
    throw std::runtime_error(option + " " + folder.string() + ": cannot be made a folder: " + there.string() +
                             " is no folder");
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    throw std::runtime_error(option + " " + folder.string() + ": cannot be written: " + std::strerror(errno));
}

void check_file(const std::string& option, const std::filesystem::path& file,
                const std::vector<std::filesystem::path>& kept) {
  namespace fs = std::filesystem;
  check_folder(option, file.has_parent_path() ? file.parent_path() : fs::path("."));
  std::error_code error;
  if (!file.has_filename() || fs::is_directory(file, error))
    throw std::runtime_error(option + " " + file.string() + ": names no file");
  const fs::path whole = fs::weakly_canonical(file, error);
  for (const fs::path& other : kept) {
    if (!other.empty() && (fs::equivalent(file, other, error) || fs::weakly_canonical(other, error) == whole))
      throw std::runtime_error(option + " " + file.string() + ": would overwrite " + other.string());
  }
}

void make_folder(const std::string& option, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw std::runtime_error(option + " " + folder.string() +
                             ": cannot be made a folder: " + error.message());
}

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  const std::string why = write_whole_file(file, bytes);
  if (!why.empty()) throw std::runtime_error(file.string() + ": cannot be written: " + why);
}

}  // namespace gnomon::tool
