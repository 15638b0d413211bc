// Does `gnomon compare` measure from where it is told to, and do its rows say so?
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

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
    EXPECT_NEAR(*row.expected_wrong, wrong, 0.05 * wrong) << row.technique.name();
  }
}

TEST(Compare, measures_edited_scenes_and_orthographic_pictures_and_says_so_in_each_row) {
  const TemporaryFolder folder;
  std::vector<report::Row> rows;
  const auto measure = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"compare",     "builtin:hangar",
                                   "--warps",     "none",
                                   "--filters",   "hard",
                                   "--frames",    "1",
                                   "--rounds",    "1",
                                   "--map-sizes", "512",
                                   "--size",      "160x90",
                                   "--out",       (folder.path() / "out").string(),
                                   "--resume"};
    words.insert(words.end(), more.begin(), more.end());
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    rows = report::read_rows(folder.path() / "out");
    return finished.err;
  };
  (void)measure({"--cascades", "1"});
  const auto exact_files = [&] {
    return std::distance(fs::directory_iterator(folder.path() / "exact"), fs::directory_iterator());
  };
  const auto plain_files = exact_files();
  // Another scene is another measurement, and its exact shadows are others; the same again is none.
  for (int i = 0; i < 2; ++i) (void)measure({"--cascades", "1", "--section", "0,1,0,3"});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_GT(exact_files(), plain_files);
  (void)measure({"--cascades", "1", "--ground"});
  (void)measure({"--cascades", "1", "--orthographic", "30"});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].edits, "");
  EXPECT_EQ(rows[1].edits, "section 0,1,0,3");
  EXPECT_EQ(rows[2].edits, "ground");
  EXPECT_EQ(rows[3].camera, "orthographic 30");
  EXPECT_NE(rows[0].errors.pixels, rows[1].errors.pixels);
  EXPECT_NE(rows[0].errors.pixels, rows[3].errors.pixels);
  for (const report::Row& row : rows) {
    EXPECT_GT(row.errors.pixels, 1000u);
    // The hangar's own ground shadows one that is added.
    if (row.edits != "ground") {
      EXPECT_LT(row.errors.false_lit + row.errors.false_shadow, 0.1) << row.edits << row.camera;
    }
  }
  // The report keeps them apart.
  EXPECT_NE(content_of(folder.path() / "out" / "summary.csv").find("builtin:hangar, ground"),
            std::string::npos);
}

TEST(Compare, measures_what_proxies_cost_against_rays_of_the_originals) {
  const TemporaryFolder folder;
  const auto measure = [&](const char* out, const std::vector<std::string>& more) {
    std::vector<std::string> words{"compare",     "builtin:hangar",
                                   "--warps",     "none",
                                   "--filters",   "hard",
                                   "--frames",    "1",
                                   "--rounds",    "1",
                                   "--size",      "160x90",
                                   "--cascades",  "1",
                                   "--map-sizes", "1024",
                                   "--out",       (folder.path() / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_gnomon(words);
  };
  // The terrain is no part of the hangar.
  const Finished unmatched = measure("none", {"--proxies", "builtin:terrain"});
  EXPECT_EQ(unmatched.exit_code, 2);
  EXPECT_NE(unmatched.err.find("builtin:terrain: no mesh is a shadow proxy of a node"), std::string::npos)
      << unmatched.err;
  EXPECT_EQ(std::count(unmatched.err.begin(), unmatched.err.end(), '\n'), 1);
  EXPECT_FALSE(fs::exists(folder.path() / "none"));
  // Its own meshes are proxies that cost nothing.
  const Finished own = measure("own", {"--proxies", "builtin:hangar", "--write-masks"});
  ASSERT_EQ(own.exit_code, 0) << own.err;
  const std::string masks = (folder.path() / "own" / "masks" / "technique0").string();
  const Finished judged = measure("judged", {"--entry", "proxies=" + masks});
  ASSERT_EQ(judged.exit_code, 0) << judged.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path() / "judged");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(report::read_rows(folder.path() / "own")[0].edits, "proxies builtin:hangar 0000000000000000");
  EXPECT_GT(rows[1].errors.pixels, 1000u);
  EXPECT_NEAR(rows[0].errors.false_lit, rows[1].errors.false_lit, 0.002);
  EXPECT_NEAR(rows[0].errors.false_shadow, rows[1].errors.false_shadow, 0.002);
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
