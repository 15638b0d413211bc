// Do rows come out as JSON and CSV that can be read back?
#include "rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon::stress {
namespace {

Results some_results() {
  Results results;
  results.cases.push_back({3, "name", "near, \"far\"", "required", "holds", "found"});
  AxisRow row;
  row.axis = "cone";
  row.variant = "optimal";
  row.value = 1e-6;
  row.used = "cube, 5 faces | none";
  row.maps = 5;
  row.worst.float_absolute_texels = std::numeric_limits<double>::infinity();
  results.axes.push_back(row);
  results.filters.push_back({"exponent", "c", "esm", true, 80.0, 1e-3, 1e-2, 0.0, true});
  return results;
}

TEST(Rows, are_a_json_object_per_line_and_what_is_not_finite_is_null) {
  std::istringstream lines(json_lines(some_results()));
  std::string line;
  std::vector<nlohmann::json> rows;
  while (std::getline(lines, line)) rows.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["kind"], "case");
  EXPECT_EQ(rows[0]["input"], "near, \"far\"");
  EXPECT_EQ(rows[1]["kind"], "axis");
  EXPECT_EQ(rows[1]["value"].get<double>(), 1e-6);
  EXPECT_TRUE(rows[1]["float_absolute_texels"].is_null());
  EXPECT_EQ(rows[2]["filter"], "esm");
}

TEST(Rows, are_csv_with_as_many_fields_in_each_line) {
  std::istringstream lines(csv(some_results()));
  std::string line;
  std::size_t fields = 0, count = 0;
  while (std::getline(lines, line)) {
    std::size_t here = 1;
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      here += c == ',' && !quoted ? 1 : 0;
    }
    EXPECT_FALSE(quoted) << line;
    if (count++ == 0) fields = here;
    EXPECT_EQ(here, fields) << line;
  }
  EXPECT_EQ(count, 4u);
}

TEST(Rows, of_csv_keep_spreadsheets_from_taking_text_for_formulas) {
  Results results;
  results.cases.push_back({1, "name", "=1+1", "-3", "holds", "said \"so\""});
  const std::string text = csv(results);
  EXPECT_NE(text.find("\"'=1+1\",\"'-3\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"said \"\"so\"\"\""), std::string::npos) << text;
}

TEST(Rows, hold_only_where_everything_holds) {
  Results results = some_results();
  EXPECT_TRUE(results.all_hold());
  results.cases[0].verdict = "fails";
  EXPECT_FALSE(results.all_hold());
  results = some_results();
  results.axes[0].worst.finite = false;
  EXPECT_FALSE(results.all_hold());
  results = some_results();
  results.filters[0].within = false;
  EXPECT_FALSE(results.all_hold());
}

TEST(Tables, keep_their_columns) {
  std::istringstream lines(tables(some_results()));
  std::string line;
  std::ptrdiff_t bars = 0;
  int rows = 0;
  while (std::getline(lines, line)) {
    rows += line.find('|') != std::string::npos ? 1 : 0;
    const auto here = std::count(line.begin(), line.end(), '|');
    if (here == 0 || bars == 0) bars = here;
    EXPECT_EQ(here, bars) << line;
  }
  EXPECT_EQ(rows, 9) << "three tables: head, rule and a row";
}

}  // namespace
}  // namespace gnomon::stress
