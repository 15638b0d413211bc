// Files of rows that a killed run leaves whole, and many of them made one.
#include "gnomon/report/rows_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

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

/// A row that a kill or a crash cut short is no JSON. Accepting needs no stack, however deep the line nests.
bool is_torn(const std::string& line) {
  return !nlohmann::json::accept(line);
}

struct TornLines {
  std::size_t count = 0, first = 0;

  void add(std::size_t line) {
    if (count++ == 0) first = line;
  }
  [[nodiscard]] std::string warning(const std::string& name) const {
    return name + ":" + std::to_string(first) + ": " +
           (count == 1
                ? "a row is not whole and was skipped"
                : "the first of " + std::to_string(count) + " rows that are not whole and were skipped");
  }
};

}  // namespace

RowsFile::RowsFile(const fs::path& file) : RowsFile(file, ResultsLock(file.parent_path())) {}

RowsFile::RowsFile(const fs::path& file, ResultsLock lock) : lock_(std::move(lock)), file_(file) {
  const std::string text = optional_text(file);
  const std::size_t last_end = text.rfind('\n');
  size_ = last_end == std::string::npos ? 0 : last_end + 1;
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_APPEND, 0666);
  if (descriptor_ < 0) fail(file_);
  if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) fail(file_);
}

RowsFile::~RowsFile() {
  ::close(descriptor_);
}

void RowsFile::append(const Row& row) {
  const std::string line = to_json_line(row) + "\n";
  // One write for the row. It takes less only where the disk fills up: the next one then says why.
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t written = ::write(descriptor_, line.data() + done, line.size() - done);
    if (written > 0) done += static_cast<std::size_t>(written);
    if (written > 0 || errno == EINTR) continue;
    const int why = errno;
    (void)!::ftruncate(descriptor_, static_cast<off_t>(size_));
    errno = why;
    fail(file_);
  }
  size_ += line.size();
  if (::fsync(descriptor_) != 0) fail(file_);
}

std::vector<Row> rows_from_text(std::string_view text, const std::string& name,
                                std::vector<std::string>* warnings) {
  std::vector<Row> rows;
  std::size_t number = 0;
  TornLines torn;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    ++number;
    if (end == begin) continue;
    const std::string where = name + ":" + std::to_string(number);
    if (end - begin > kMaxLineBytes)
      throw ReportError(where + ": longer than " + std::to_string(kMaxLineBytes) + " bytes");
    std::string line(text.substr(begin, end - begin));
    try {
      rows.push_back(row_from_json(line, where));
    } catch (const ReportError&) {
      if (!is_torn(line)) throw;
      torn.add(number);
    }
  }
  // Not a row that was torn, but a file of something else.
  if (rows.empty() && torn.count > 0)
    throw ReportError(one_line(name + ":" + std::to_string(torn.first) + ": is no row"));
  if (!text.empty() && text.back() != '\n') torn.add(number + 1);
  if (torn.count > 0 && warnings != nullptr) warnings->push_back(one_line(torn.warning(name)));
  return rows;
}

std::vector<Row> read_rows(const fs::path& path, std::vector<std::string>* warnings) {
  const fs::path file = rows_path(path);
  return rows_from_text(read_text(file), file.string(), warnings);
}

bool SceneHashes::agree(const std::string& scene, const std::string& hash) {
  return hash.empty() || known_.try_emplace(scene, hash).first->second == hash;
}

std::size_t merge_rows(std::span<const fs::path> folders, const fs::path& out,
                       std::vector<std::string>* warnings) {
  std::error_code ignored;
  std::optional<ResultsLock> lock;  // before reading: `out` may be one of the folders
  if (fs::is_directory(out, ignored)) lock.emplace(out);
  std::vector<Row> rows;
  std::set<std::string> keys;
  std::vector<fs::path> from;  // of each row
  SceneHashes scenes;
  for (const fs::path& folder : folders) {
    for (Row& row : read_rows(folder, warnings)) {
      if (!scenes.agree(row.scene, row.scene_hash))
        throw ReportError(
            one_line(folder.string() + ": " + row.scene + " is not the one that was measured before"));
      if (!keys.insert(row.key()).second) continue;
      from.push_back(rows_path(folder).parent_path());
      rows.push_back(std::move(row));
    }
  }
  make_folder(out);
  if (!lock) lock.emplace(out);
  for (std::size_t i = 0; i < rows.size(); ++i) copy_pictures(rows[i], from[i], out);
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.index < b.index; });
  std::string text;
  for (const Row& row : rows) text += to_json_line(row) + "\n";
  write_text(out / kRowsFile, text);
  return rows.size();
}

}  // namespace gnomon::report
