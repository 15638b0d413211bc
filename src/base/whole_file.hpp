// A file that is either there as a whole or as it was before: a full disk or a kill leaves no half one.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace gnomon {

/// Writes beside the target and renames. Answers why it could not, "" where it could; nothing of the attempt
/// is left then. A link stays one, and what it leads to is written. What is there and is no regular file is
/// refused: the renaming would put a file in the place of a device.
[[nodiscard]] inline std::string write_whole_file(const std::filesystem::path& named,
                                                  std::string_view bytes) {
  std::error_code error;
  const bool is_link = std::filesystem::is_symlink(named, error);
  const std::filesystem::path file = is_link ? std::filesystem::canonical(named, error) : named;
  if (error && is_link) return error.message();
  const std::filesystem::file_status there = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(there)) return std::strerror(EISDIR);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    return "is not a regular file";
  std::filesystem::path aside = file;
  aside += "." + std::to_string(::getpid());
  errno = 0;
  std::ofstream out(aside, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::string why;
  if (!out) why = errno != 0 ? std::strerror(errno) : "the system does not say why";
  if (why.empty()) {
    std::filesystem::rename(aside, file, error);
    if (error) why = error.message();
  }
  if (!why.empty()) std::filesystem::remove(aside, error);
  return why;
}

}  // namespace gnomon
