// Does `gnomon scenes` list and write what it can, and do commands have the options that docs/files.md says?
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

TEST(Scenes, are_listed_where_the_output_takes_them_and_written_to_files_alone) {
  EXPECT_EQ(run_gnomon({"scenes"}, "", "/dev/full").exit_code, 2);
  const TemporaryFolder folder;
  const Finished refused = run_gnomon({"scenes", "--write", "city", folder.path().string()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("cannot be written: Is a directory"), std::string::npos) << refused.err;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::stringstream stream(row.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(cell);
  return cells;
}

std::vector<std::string> quoted_in(const std::string& cell) {
  std::vector<std::string> words;
  const std::regex quoted("`([^`]+)`");
  for (std::sregex_iterator at(cell.begin(), cell.end(), quoted), end; at != end; ++at)
    words.push_back((*at)[1]);
  return words;
}

TEST(Scenes, are_opened_by_commands_with_the_options_that_the_page_has_in_its_table) {
  std::stringstream page(content_of(fs::path(GNOMON_CAPTURES) / "../../docs/files.md"));
  std::vector<std::vector<std::string>> options;  // by column
  int checked = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| command | `--path`")) {
      for (const std::string& cell : cells_of(line)) options.push_back(quoted_in(cell));
      std::getline(page, line);  // the rule
      continue;
    }
    if (options.empty()) continue;
    if (!line.starts_with("|")) break;
    const std::vector<std::string> cells = cells_of(line);
    ASSERT_GE(cells.size(), options.size());
    const std::string command = quoted_in(cells[0]).at(0), help = run_gnomon({command, "--help"}).out;
    for (std::size_t column = 1; column < options.size(); ++column) {
      for (const std::string& option : options[column]) {
        const bool has = std::regex_search(help, std::regex("\\n  " + option + "( |\\n)"));
        EXPECT_EQ(has, cells[column] == " yes ") << command << " " << option;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100);
}

}  // namespace
}  // namespace gnomon::test
