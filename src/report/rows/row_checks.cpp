// Repeated rows, absent pictures and missing frames, found by what rows say of themselves.
#include "rows/row_checks.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "file.hpp"
#include "gnomon/report/rows_file.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

void drop_repeated(std::vector<Row>& rows, std::vector<std::string>& lines) {
  std::set<std::string> keys;
  const std::size_t dropped =
      std::erase_if(rows, [&keys](const Row& row) { return !keys.insert(row.key()).second; });
  if (dropped > 0) lines.push_back(counted(dropped, "row") + " repeated; each counts once");
}

/// The same pictures may stand in many rows.
void forget_absent_pictures(const fs::path& folder, std::vector<Row>& rows, std::vector<std::string>& lines) {
  std::map<std::string, bool> known;
  std::string first;
  const auto absent = [&](const std::string& name) {
    if (name.empty()) return false;
    const auto [at, is_new] = known.try_emplace(name, false);
    std::error_code ignored;
    if (is_new) at->second = !fs::exists(inside(folder, name), ignored);
    if (at->second && first.empty()) first = name;
    return at->second;
  };
  std::size_t without = 0;
  for (Row& row : rows) {
    const Pictures& p = row.pictures;
    const bool any =
        absent(p.image) || absent(p.truth) || absent(p.mask) || absent(p.difference) || absent(p.heat);
    if (!any) continue;
    row.pictures = {};
    ++without;
  }
  if (without > 0)
    lines.push_back(one_line(first) + " is not there; " + counted(without, "row") + " without pictures");
}

/// What rows of one view share, whichever frame and technique they are of.
std::string view_of(Row row) {
  row.technique = {};
  row.frame = 0;
  return row.view + '\n' + row.key();
}

void name_missing_frames(const std::vector<Row>& rows, std::vector<std::string>& lines) {
  struct OfView {
    const Row* first;
    std::map<std::string, std::set<int>> measured;  // by technique
  };
  std::map<std::string, OfView> views;
  for (const Row& row : rows)
    views.try_emplace(view_of(row), OfView{&row, {}})
        .first->second.measured[row.technique.name()]
        .insert(row.frame);
  for (const auto& [key, view] : views) {
    const int frames = view.first->frames;
    const auto few = [&](const auto& of) { return static_cast<int>(of.second.size()) < frames; };
    const auto first = std::find_if(view.measured.begin(), view.measured.end(), few);
    if (first == view.measured.end()) continue;
    const auto count = std::count_if(first, view.measured.end(), few);
    std::string name = view.first->view.empty() ? view.first->scene : view.first->view;
    if (view.first->light != "sun") name += ", " + view.first->light;
    lines.push_back(one_line(name + ": " + std::to_string(count) + " of " +
                             counted(view.measured.size(), "technique") + (count == 1 ? " lacks" : " lack") +
                             " frames (" + first->first + " has " + std::to_string(first->second.size()) +
                             " of " + std::to_string(frames) + "), so means are not over all frames"));
  }
}

}  // namespace

std::vector<std::string> check_rows(const fs::path& folder, std::vector<Row>& rows) {
  std::vector<std::string> lines;
  drop_repeated(rows, lines);
  forget_absent_pictures(folder, rows, lines);
  name_missing_frames(rows, lines);
  for (std::string& line : lines) line = one_line((folder / kRowsFile).string()) + ": " + line;
  return lines;
}

}  // namespace gnomon::report
