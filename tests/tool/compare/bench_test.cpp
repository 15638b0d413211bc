// `gnomon bench`: a short study within its time, an answer for each budget, and what is refused.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;

Finished bench(const fs::path& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"bench", "--size", "64x36", "--context", "osmesa", "--out", out.string()};
  words.insert(words.end(), more.begin(), more.end());
  return run_gnomon(words);
}

TEST(Bench, stops_when_its_time_is_over_and_goes_on_where_it_stopped) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  // Less than a view takes: one is measured all the same.
  const Finished first = bench(out, {"--minutes", "0.01"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::vector<report::Row> rows = report::read_rows(out);
  ASSERT_EQ(rows.size() % 12, 0u) << "views are whole";
  const std::size_t views = rows.size() / 12;
  EXPECT_GE(views, 1u);
  EXPECT_LT(views, 14u);
  EXPECT_NE(first.out.find("views:  " + std::to_string(views) + " of 14, as many as time allowed"),
            std::string::npos)
      << first.out;
  EXPECT_EQ(rows[0].technique.map_size, 64) << "maps shrink with the picture";
  const Finished more = bench(out, {"--resume", "--minutes", "0.01", "--json"});
  ASSERT_EQ(more.exit_code, 0) << more.err;
  const json answer = json::parse(more.out);
  EXPECT_GE(report::read_rows(out).size(), rows.size() + 12);
  EXPECT_EQ(answer, json::parse(content_of(out / "budgets.json")));
  EXPECT_GE(answer["views"], 2);
  EXPECT_GE(answer["noise_factor"], 1.0);
  EXPECT_NE(answer["machine"]["renderer"], "");
  EXPECT_GT(answer["machine"]["cores"], 0);
  for (const char* error : {"wrong", "pixel_error", "twinkle"}) {
    const json& choices = answer["choices"][error];
    ASSERT_FALSE(choices.empty()) << error;
    for (std::size_t i = 1; i < choices.size(); ++i) {
      EXPECT_GE(choices[i]["budget_ms"], choices[i - 1]["budget_ms"]);
      EXPECT_LT(choices[i]["error"]["median"], choices[i - 1]["error"]["median"]);
      EXPECT_LE(choices[i]["ms"]["median"], choices[i]["budget_ms"]);
    }
  }
  EXPECT_NE(content_of(out / "report.html").find("Which technique for which budget"), std::string::npos);
}

TEST(Bench, refuses_in_one_line_what_it_does_not_take) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"--minutes", "0"},
                                                                                     {"--minutes", "soon"},
                                                                                     {"--minutes", "nan"},
                                                                                     {"--size", "8"},
                                                                                     {"builtin:fence"}}) {
    const Finished finished = bench(out, words);
    EXPECT_EQ(finished.exit_code, 2) << words.front();
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_FALSE(fs::exists(out));
  }
}

}  // namespace
}  // namespace gnomon::test
