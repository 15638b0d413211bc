// Does `gnomon compare` measure from where it is told to, and do its rows say so?
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

TEST(Compare, measures_from_an_eye_or_a_path_of_its_own_and_says_so_in_each_row) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "walk.json";
  const auto write_path = [&path](const char* from) {
    std::ofstream(path) << R"({"keys":[{"position":[)" << from
                        << R"(],"target":[0,4,20]}],"near":0.5,"far":300})";
  };
  const auto rows_of = [&folder](std::vector<std::string> camera, bool resume = false) {
    std::vector<std::string> words{"compare",     "builtin:hangar",
                                   "--warps",     "none,optimal",
                                   "--filters",   "hard",
                                   "--cascades",  "1",
                                   "--map-sizes", "256",
                                   "--frames",    "1",
                                   "--rounds",    "1",
                                   "--size",      "320x180",
                                   "--out",       (folder.path() / "out").string()};
    words.insert(words.end(), camera.begin(), camera.end());
    if (resume) words.emplace_back("--resume");
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return report::read_rows(folder.path() / "out");
  };
  write_path("3,2.2,50");
  const std::vector<report::Row> by_path = rows_of({"--path", path.string()});
  ASSERT_EQ(by_path.size(), 2u);
  EXPECT_EQ(by_path[0].camera.rfind("path walk.json ", 0), 0u) << by_path[0].camera;
  // Another content of the same file is another measurement, and so is an eye; the same again is none.
  EXPECT_EQ(rows_of({"--path", path.string()}, true).size(), 2u);
  write_path("3,2.5,50");
  EXPECT_EQ(rows_of({"--path", path.string()}, true).size(), 4u);
  const std::vector<report::Row> all =
      rows_of({"--eye", "3,2.2,50", "--target", "0,4,20", "--near", "0.5"}, true);
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[4].camera, "eye 3,2.2,50 target 0,4,20 near 0.5");
  EXPECT_EQ(all[4].errors.pixels, by_path[0].errors.pixels);  // the same place
  for (const report::Row& row : all) {
    const double wrong = row.errors.false_lit + row.errors.false_shadow;
    ASSERT_TRUE(row.expected_wrong);
    EXPECT_GT(wrong, 0.01);
    EXPECT_GT(*row.expected_wrong, 0.4 * wrong) << row.technique.name();
    EXPECT_LT(*row.expected_wrong, 1.5 * wrong) << row.technique.name();
  }
}

TEST(Compare, refuses_cameras_that_do_not_go_together) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::vector<std::string>& more) {
    const Finished finished = run_gnomon(small_sweep(folder.path() / "none", more));
    EXPECT_EQ(finished.exit_code, 2) << more.back();
    EXPECT_FALSE(fs::exists(folder.path() / "none"));
    return finished.err;
  };
  EXPECT_NE(refusal({"--eye", "0,1,2"}).find("--eye and --target: give both"), std::string::npos);
  EXPECT_NE(refusal({"--eye", "0,1,2", "--target", "0,1,2"}).find("--target: must differ"),
            std::string::npos);
  EXPECT_NE(refusal({"--eye", "0,1", "--target", "0,1,2"}).find("--eye 0,1: wants three numbers"),
            std::string::npos);
  EXPECT_NE(refusal({"--near", "5", "--far", "2"}).find("--near: sight would begin at 5 and end at 2"),
            std::string::npos);
  EXPECT_NE(refusal({"--path", "/nowhere.json"}).find("/nowhere.json"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
