// `gnomon stress` from outside: tables, JSON, CSV, files, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"

namespace gnomon::test {
namespace {

TEST(Stress, cases_are_a_table_of_32_that_hold) {
  const Finished run = run_gnomon({"stress", "--cases"});
  EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
  EXPECT_EQ(run.lines().size(), 34u);
  EXPECT_EQ(run.out.find("| fails |"), std::string::npos);
}

TEST(Stress, an_axis_is_json_lines_with_a_row_per_value_and_variant) {
  const Finished run = run_gnomon({"stress", "--axis", "cascades", "--scenes", "1", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_EQ(run.lines().size(), 50u);
  int refused = 0;
  for (const std::string& line : run.lines()) {
    const nlohmann::json row = nlohmann::json::parse(line);
    EXPECT_EQ(row["axis"], "cascades");
    refused += row["used"] == "refused: options.cascades" ? 1 : 0;
  }
  EXPECT_EQ(refused, 10);
}

TEST(Stress, the_same_seed_says_the_same_and_another_does_not) {
  const auto run = [](const char* seed) {
    return run_gnomon({"stress", "--axis", "fov", "--samples", "3", "--seed", seed, "--csv"}).out;
  };
  const std::string first = run("1");
  EXPECT_EQ(first, run("1"));
  EXPECT_NE(first, run("2"));
}

TEST(Stress, files_appear_whole_and_nothing_beside_them) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "a/b").string();
  const Finished run = run_gnomon({"stress", "--axis", "gap", "--samples", "4", "--out", out});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(out)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"stability.csv", "stability.jsonl"}));
}

TEST(Stress, random_cases_are_the_same_for_a_seed_and_each_kind_that_fails_has_a_file) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "cases").string();
  const std::vector<std::string> arguments{"stress", "--random", "60", "--seed", "4", "--out", out};
  const Finished run = run_gnomon(arguments), again = run_gnomon(arguments);
  // Slow machines see progress, and nothing else.
  std::istringstream errors(run.err);
  for (std::string line; std::getline(errors, line);)
    ASSERT_TRUE(line.starts_with("gnomon stress --random: ")) << run.err;
  EXPECT_NE(run.out.find("60 random cases, seed 4: "), std::string::npos) << run.out;
  // All but the times.
  const auto fails = [](const Finished& finished) {
    std::vector<std::string> kinds;
    for (const std::string& line : finished.lines()) {
      if (line.starts_with("fails: ")) kinds.push_back(line);
    }
    return kinds;
  };
  EXPECT_EQ(fails(run), fails(again));
  EXPECT_EQ(run.exit_code, fails(run).empty() ? 0 : 1);
  std::vector<std::string> replay{"stress", "--replay"};
  if (std::filesystem::exists(out)) {
    for (const auto& entry : std::filesystem::directory_iterator(out)) replay.push_back(entry.path());
  }
  ASSERT_EQ(replay.size() - 2, fails(run).size());
  if (replay.size() == 2) return;
  const Finished replayed = run_gnomon(replay);
  EXPECT_EQ(replayed.exit_code, 1) << replayed.err;
  EXPECT_EQ(replayed.out.find("keeps every promise"), std::string::npos) << replayed.out;
}

TEST(Stress, refuses_with_one_line) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"stress", "--axis", "nonsense"},
                                                    {"stress", "--samples", "1"},
                                                    {"stress", "--random", "0"},
                                                    {"stress", "--replay", file},
                                                    {"stress", "--replay", file + ".nowhere"},
                                                    {"stress", "--cases", "--out", file + "/x"},
                                                    {"stress", "--json", "--csv", "--cases"},
                                                    {"stress", "--filters", "--context", "nonsense"}}) {
    const Finished run = run_gnomon(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments.back();
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "");
  }
}

}  // namespace
}  // namespace gnomon::test
