// `gnomon panes`: its figures hold what the documentation promises, and bad input is refused in one line.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;

std::vector<json> rows_of(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"panes", "--json", "--frames", "2",         "--rounds",
                                     "1",     "--size", "192x108",  "--context", "osmesa"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished finished = run_gnomon(arguments);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  std::vector<json> rows;
  std::istringstream lines(finished.out);
  for (std::string line; std::getline(lines, line);) rows.push_back(json::parse(line));
  return rows;
}

TEST(PanesCommand, light_behind_glass_is_right_within_two_percent) {
  const std::vector<json> rows = rows_of({});
  ASSERT_EQ(rows.size(), 2u);
  for (const json& row : rows) {
    EXPECT_EQ(row.at("scene"), "builtin:glass");
    EXPECT_GT(row.at("tinted").get<double>(), 0.2);
    EXPECT_LT(row.at("mean_error").get<double>(), 0.02);
    EXPECT_GT(row.at("panes_ms").get<double>(), 0.0);
  }
}

TEST(PanesCommand, a_scene_without_panes_costs_nothing) {
  for (const json& row : rows_of({"builtin:hangar"})) {
    EXPECT_EQ(row.at("tinted"), 0.0);
    EXPECT_EQ(row.at("mean_error"), 0.0);
    EXPECT_EQ(row.at("panes_ms"), 0.0);
  }
}

TEST(PanesCommand, refuses_what_is_no_scene_in_one_line) {
  for (const char* scene : {"builtin:glas", "/nowhere.glb"}) {
    const Finished finished = run_gnomon({"panes", scene});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

}  // namespace
}  // namespace gnomon::test
