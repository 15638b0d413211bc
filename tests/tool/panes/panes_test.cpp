// `gnomon panes`: its figures hold what the documentation promises, and bad input is refused in one line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/scene/image.hpp"
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

TEST(PanesCommand, exact_shadows_pages_and_many_lights_hold_their_bounds_too) {
  // Edges of panes are as wide as a texel, but for exact shadows.
  for (const auto& [by, bound] :
       {std::pair("irregular", 0.001), std::pair("pages", 0.02), std::pair("lights", 0.02)})
    for (const json& row : rows_of({"--by", by})) {
      EXPECT_EQ(row.at("by"), by);
      EXPECT_GT(row.at("tinted").get<double>(), 0.2) << by;
      EXPECT_LT(row.at("mean_error").get<double>(), bound) << by;
      EXPECT_EQ(row.at("hard_and_panes_over_msm").is_null(), row.at("by") == "lights");
    }
}

TEST(PanesCommand, maps_that_bend_lines_tint_by_exact_shadows_alone_and_the_viewer_says_so) {
  for (const json& row : rows_of({"--warp", "tsm:logarithmic", "--by", "irregular"}))
    EXPECT_LT(row.at("mean_error").get<double>(), 0.001);
  const Finished finished =
      run_gnomon({"view", "builtin:glass", "--context", "osmesa", "--panes", "--warp", "tsm", "--shape",
                  "logarithmic", "--size", "192x108", "--out", testing::TempDir() + "gnomon_panes_bent.png"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_NE(finished.err.find("no panes with shape logarithmic"), std::string::npos) << finished.err;
}

TEST(PanesCommand, a_scene_without_panes_costs_nothing) {
  for (const json& row : rows_of({"builtin:hangar"})) {
    EXPECT_EQ(row.at("tinted"), 0.0);
    EXPECT_EQ(row.at("mean_error"), 0.0);
    EXPECT_EQ(row.at("panes_ms"), 0.0);
  }
}

TEST(PanesCommand, the_viewer_shows_tinted_light_where_the_word_says_so_and_a_hard_shadow_else) {
  const auto picture = [](const std::vector<std::string>& more) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "gnomon_panes_view.png";
    std::vector<std::string> words{"view", "builtin:glass", "--size", "160x90", "--map-size",
                                   "256",  "--context",     "osmesa", "--out",  file.string()};
    words.insert(words.end(), more.begin(), more.end());
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    std::filesystem::remove(file);
    return decode_image({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "view",
                        1u << 20);
  };
  const Image solid = picture({}), tinted = picture({"--panes"});
  ASSERT_EQ(solid.rgba.size(), tinted.rgba.size());
  std::size_t brighter = 0;
  for (std::size_t i = 0; i < solid.rgba.size(); i += 4)
    brighter += tinted.rgba[i] + tinted.rgba[i + 1] + tinted.rgba[i + 2] >
                solid.rgba[i] + solid.rgba[i + 1] + solid.rgba[i + 2] + 30;
  EXPECT_GT(brighter, solid.rgba.size() / 4 / 20) << "light that panes stopped before";
}

TEST(PanesCommand, refuses_another_way_in_one_line) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"panes", "--by", "clouds"},
                                                {"panes", "--by", "lights", "--local-lights", "0"},
                                                {"panes", "--warp", "tsm:logarithmic"}}) {
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
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
