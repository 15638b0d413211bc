// Whole files in and out, with errors that name them.
#include "file.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>

#include "base/bounded_file.hpp"
#include "base/whole_file.hpp"
#include "gnomon/report/row.hpp"
#include "text.hpp"

namespace gnomon::report {

namespace fs = std::filesystem;

void refuse(const fs::path& path, const std::string& why) {
  throw ReportError(one_line(path.string() + ": " + why));
}

namespace {

constexpr std::uint64_t kMaxPictureBytes = 64ull << 20;  // a frame of 4096 x 4096 in PNG

std::string read_regular(const fs::path& file, std::uint64_t max_bytes) {
  std::string bytes;
  const std::string why = read_bounded_file(file, max_bytes, Readable::regular_file, bytes);
  if (!why.empty()) refuse(file, why);
  return bytes;
}

}  // namespace

std::string read_text(const fs::path& file, std::uint64_t max_bytes) {
  return read_regular(file, max_bytes);
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
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) refuse(folder, "cannot be made a folder: " + error.message());
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
