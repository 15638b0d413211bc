// Files of rows that a killed run leaves whole, and many of them made one.
#include "gnomon/report/rows_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <system_error>

#include "file.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

// A row takes about 2 KB; its longest part is the list of what a plan left out.
constexpr std::size_t kMaxLineBytes = 1u << 20;

[[noreturn]] void fail(const fs::path& file) {
  throw ReportError(one_line(file.string()) + ": " + std::strerror(errno));
}

fs::path rows_path(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored) ? path / kRowsFile : path;
}

void copy_picture(const std::string& name, const fs::path& from, const fs::path& to) {
  if (name.empty()) return;
  const fs::path source = inside(from, name), target = inside(to, name);
  std::error_code error;
  if (!fs::exists(source, error) || fs::equivalent(source, target, error)) return;
  fs::create_directories(target.parent_path(), error);
  write_text(target, read_picture(source));
}

void copy_pictures(const Row& row, const fs::path& from, const fs::path& to) {
  const Pictures& p = row.pictures;
  for (const std::string* name : {&p.image, &p.truth, &p.mask, &p.difference, &p.heat})
    copy_picture(*name, from, to);
}

}  // namespace

RowsFile::RowsFile(const fs::path& file) : file_(file) {
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(file_);
  const std::string text = read_text(file);
  const std::size_t last_end = text.rfind('\n');
  const std::size_t whole = last_end == std::string::npos ? 0 : last_end + 1;
  if (::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0 || ::lseek(descriptor_, 0, SEEK_END) < 0)
    fail(file_);
}

RowsFile::~RowsFile() {
  ::close(descriptor_);
}

void RowsFile::append(const Row& row) {
  const std::string line = to_json_line(row) + "\n";
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t written = ::write(descriptor_, line.data() + done, line.size() - done);
    if (written < 0 && errno != EINTR) fail(file_);
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  if (::fsync(descriptor_) != 0) fail(file_);
}

std::vector<Row> rows_from_text(std::string_view text, const std::string& name) {
  std::vector<Row> rows;
  std::size_t number = 0;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    ++number;
    if (end == begin) continue;
    const std::string where = name + ":" + std::to_string(number);
    if (end - begin > kMaxLineBytes)
      throw ReportError(where + ": longer than " + std::to_string(kMaxLineBytes) + " bytes");
    rows.push_back(row_from_json(std::string(text.substr(begin, end - begin)), where));
  }
  return rows;
}

std::vector<Row> read_rows(const fs::path& path) {
  const fs::path file = rows_path(path);
  return rows_from_text(read_text(file), file.string());
}

bool SceneHashes::agree(const std::string& scene, const std::string& hash) {
  return hash.empty() || known_.try_emplace(scene, hash).first->second == hash;
}

std::size_t merge_rows(std::span<const fs::path> folders, const fs::path& out) {
  std::vector<Row> rows;
  std::set<std::string> keys;
  std::vector<fs::path> from;  // of each row
  SceneHashes scenes;
  for (const fs::path& folder : folders) {
    for (Row& row : read_rows(folder)) {
      if (!scenes.agree(row.scene, row.scene_hash))
        throw ReportError(
            one_line(folder.string() + ": " + row.scene + " is not the one that was measured before"));
      if (!keys.insert(row.key()).second) continue;
      from.push_back(rows_path(folder).parent_path());
      rows.push_back(std::move(row));
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) copy_pictures(rows[i], from[i], out);
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.index < b.index; });
  std::string text;
  for (const Row& row : rows) text += to_json_line(row) + "\n";
  make_folder(out);
  write_text(out / kRowsFile, text);
  return rows.size();
}

}  // namespace gnomon::report
