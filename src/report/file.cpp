// Whole files in and out, with errors that name them.
#include "file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

#include "base/whole_file.hpp"
#include "gnomon/report/row.hpp"
#include "text.hpp"

namespace gnomon::report {

namespace fs = std::filesystem;

void refuse(const fs::path& path, const std::string& why) {
  throw ReportError(one_line(path.string() + ": " + why));
}

namespace {

constexpr std::uint64_t kMaxTextBytes = 1ull << 30;      // half a million rows
constexpr std::uint64_t kMaxPictureBytes = 64ull << 20;  // a frame of 4096 x 4096 in PNG

std::string read_descriptor(int descriptor, const fs::path& file, std::uint64_t max_bytes) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) refuse(file, std::strerror(errno));
  if (!S_ISREG(status.st_mode)) refuse(file, "cannot be read: is not a regular file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > max_bytes) refuse(file, "is larger than " + std::to_string(max_bytes) + " bytes");
  std::string text(static_cast<std::size_t>(size), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t got = ::read(descriptor, text.data() + done, text.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(file, std::string("cannot be read: ") + std::strerror(errno));
    if (got == 0) break;  // became shorter meanwhile
    done += static_cast<std::size_t>(got);
  }
  text.resize(done);
  return text;
}

std::string read_regular(const fs::path& file, std::uint64_t max_bytes) {
  // O_NONBLOCK: opening a pipe must not wait for a writer.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) refuse(file, std::string("cannot be read: ") + std::strerror(errno));
  try {
    std::string text = read_descriptor(descriptor, file, max_bytes);
    ::close(descriptor);
    return text;
  } catch (...) {
    ::close(descriptor);
    throw;
  }
}

}  // namespace

std::string read_text(const fs::path& file) {
  return read_regular(file, kMaxTextBytes);
}

std::string read_picture(const fs::path& file) {
  constexpr std::string_view kMagic = "\x89PNG\r\n\x1a\n";
  std::string bytes = read_regular(file, kMaxPictureBytes);
  if (!bytes.starts_with(kMagic)) refuse(file, "is not a PNG");
  return bytes;
}

std::string optional_text(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored) ? read_text(file) : std::string();
}

void write_text(const fs::path& file, const std::string& text) {
  const std::string why = write_whole_file(file, text);
  if (!why.empty()) refuse(file, "cannot be written: " + why);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) refuse(folder, "cannot be made a folder");
}

fs::path inside(const fs::path& folder, const std::string& name) {
  const fs::path relative = fs::path(name).lexically_normal();
  if (relative.is_absolute() || relative.empty() || *relative.begin() == "..")
    refuse(folder, "a row names the file '" + name + "' outside of its folder");
  std::error_code error;
  const fs::path base = fs::weakly_canonical(folder, error),
                 led = fs::weakly_canonical(base / relative, error);
  const auto [end, rest] = std::mismatch(base.begin(), base.end(), led.begin(), led.end());
  if (error || end != base.end() || rest == led.end())
    refuse(folder, "a row names the file '" + name + "', a link out of its folder");
  return folder / relative;
}

}  // namespace gnomon::report
