// `gnomon merge` and `gnomon report`: results of many runs into one folder, and the page again.
#include "merge.hpp"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "gnomon/report/page.hpp"
#include "gnomon/report/rows_file.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& line : warnings) std::fprintf(stderr, "gnomon: warning: %s\n", line.c_str());
}

}  // namespace

int run_merge(const std::vector<std::string>& folders, const std::string& out, bool json) {
  const std::vector<std::filesystem::path> paths(folders.begin(), folders.end());
  std::vector<std::string> warnings;
  const std::size_t rows = report::merge_rows(paths, out, &warnings);
  print_warnings(warnings);
  const std::string file = (std::filesystem::path(out) / report::kRowsFile).string();
  const std::string page = report::write_report(out).string();
  if (json) {
    print_line(nlohmann::json{{"count", rows}, {"rows", file}, {"report", page}}.dump());
  } else {
    print_line("rows:   " + std::to_string(rows) + " in " + file);
    print_line("report: " + page);
  }
  flush_output();
  return 0;
}

int run_report(const std::vector<std::string>& folders, bool json) {
  nlohmann::json pages = nlohmann::json::array();
  for (const std::string& folder : folders) {
    std::vector<std::string> warnings;
    pages.push_back(report::write_report(folder, &warnings).string());
    print_warnings(warnings);
    if (!json) print_line(pages.back().get<std::string>());
  }
  if (json) print_line(nlohmann::json{{"reports", pages}}.dump());
  flush_output();
  return 0;
}

}  // namespace gnomon::tool
