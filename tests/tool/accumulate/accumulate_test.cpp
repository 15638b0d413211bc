// `gnomon accumulate` from outside: its rows, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "process.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;

TEST(Accumulate, has_fewer_misclassified_pixels_after_more_frames_at_rest_and_on_the_way) {
  const Finished finished = run_gnomon({"accumulate", "builtin:city", "--size", "160x90", "--map-size", "128",
                                        "--frames", "1,16", "--moving", "16", "--json"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::vector<json> rows;
  std::istringstream lines(finished.out);
  for (std::string line; std::getline(lines, line);) rows.push_back(json::parse(line));
  ASSERT_EQ(rows.size(), 4u) << finished.out;
  EXPECT_EQ(rows[0].at("frames"), 1);
  EXPECT_EQ(rows[1].at("frames"), 16);
  EXPECT_GT(rows[0].at("misclassified"), 0.0);
  EXPECT_LT(rows[1].at("to_first"), 0.6);
  EXPECT_LT(rows[1].at("flips"), rows[0].at("flips"));
  EXPECT_EQ(rows[2].at("view"), "moving, alone");
  EXPECT_EQ(rows[3].at("view"), "moving");
  EXPECT_LT(rows[3].at("misclassified"), rows[2].at("misclassified"));
  EXPECT_GE(rows[3].at("ghosting"), 0.0);
}

TEST(Accumulate, writes_a_picture_for_each_scene_and_filter) {
  const TemporaryFolder folder;
  const Finished finished = run_gnomon({"accumulate", "builtin:fence", "builtin:room", "--size", "32x18",
                                        "--map-size", "64", "--frames", "1", "--moving", "0", "--filters",
                                        "pcf:radius=1", "pcf:radius=2", "--out", folder.path().string()});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder.path()))
    names.push_back(file.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"fence_pcf_1.png", "fence_pcf_radius_2_1.png", "room_pcf_1.png",
                                             "room_pcf_radius_2_1.png"}));
}

TEST(Accumulate, refuses_bad_input_in_one_line) {
  const std::vector<std::vector<std::string>> bad = {
      {"accumulate"},
      {"accumulate", "builtin:nowhere"},
      {"accumulate", "builtin:fence", "--frames", "0"},
      {"accumulate", "builtin:fence", "--frames", "5000"},
      {"accumulate", "builtin:fence", "--confidence-power", "-1"},
      {"accumulate", "builtin:fence", "--memory", "0.5"},
      {"accumulate", "builtin:fence", "--noise", "red"},
      {"accumulate", "builtin:fence", "--filters", "blur"},
      {"accumulate", "builtin:fence", "--size", "10"},
      {"accumulate", "builtin:fence", "--warp", "bent"},
  };
  for (const std::vector<std::string>& words : bad) {
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 2) << words.back() << finished.out;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

}  // namespace
}  // namespace gnomon::test
