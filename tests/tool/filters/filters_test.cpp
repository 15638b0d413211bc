// `gnomon filters` from outside: the list, and the table of cost.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "process.hpp"
#include "support/one_line.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;

TEST(Filters, lists_every_filter_with_its_source_and_options) {
  const Finished finished = run_gnomon({"filters", "--json"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json list = json::parse(finished.out);
  std::set<std::string> names;
  for (const json& filter : list) {
    names.insert(filter.at("name").get<std::string>());
    EXPECT_FALSE(filter.at("source").get<std::string>().empty());
    for (const json& option : filter.at("options"))
      EXPECT_LE(option.at("min").get<double>(), option.at("default").get<double>());
  }
  EXPECT_TRUE(names.contains("hard"));
  EXPECT_TRUE(names.contains("convolution"));
  const std::string text = run_gnomon({"filters"}).out;
  for (const std::string& name : names) EXPECT_NE(text.find(name + ": "), std::string::npos) << name;
}

TEST(Filters, prints_the_options_of_one_filter_with_range_default_unit_and_source) {
  const json list = json::parse(run_gnomon({"filters", "--json"}).out);
  ASSERT_GE(list.size(), 12u);
  for (const json& filter : list) {
    const auto name = filter.at("name").get<std::string>();
    const Finished finished = run_gnomon({"filters", name});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    const std::string text = in_one_line(finished.out);
    EXPECT_NE(text.find("Source: " + filter.at("source").get<std::string>()), std::string::npos) << text;
    for (const json& option : filter.at("options")) {
      EXPECT_NE(text.find(option.at("summary").get<std::string>()), std::string::npos) << text;
      EXPECT_NE(finished.out.find("\n  " + option.at("name").get<std::string>() + " "), std::string::npos);
    }
    EXPECT_EQ(json::parse(run_gnomon({"filters", name, "--json"}).out), filter);
  }
  const std::string pcss = run_gnomon({"filters", "pcss"}).out;
  EXPECT_TRUE(
      std::regex_search(pcss, std::regex("\n  angle_deg +0.01 to 60 +2 +apparent diameter .* degrees")))
      << pcss;
}

TEST(Filters, refuses_a_filter_that_does_not_exist_and_suggests_one_that_does) {
  const Finished finished = run_gnomon({"filters", "vmsm"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.out, "");
  EXPECT_NE(finished.err.find("there is no filter 'vmsm'; did you mean 'vsm'?"), std::string::npos)
      << finished.err;
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  EXPECT_EQ(run_gnomon({"filters", "vsm", "--cost"}).exit_code, 2);
}

TEST(Filters, counts_passes_and_bytes_of_each_blur_against_hard) {
  const Finished finished = run_gnomon(
      {"filters", "--cost", "--json", "--filters", "vsm,pcf", "--map-sizes", "64", "--rounds", "1"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::vector<json> rows;
  for (const std::string& line : finished.lines()) rows.push_back(json::parse(line));
  ASSERT_GE(rows.size(), 5u);  // hard, vsm unblurred, 3 x 3 and 7 x 7, and pcf
  EXPECT_EQ(rows[0].at("ms_ratio"), 1.0);
  EXPECT_EQ(rows[0].at("prefilter_passes"), 0);
  EXPECT_EQ(rows[1].at("prefilter_passes"), 1);
  EXPECT_EQ(rows[3].at("prefilter_passes"), 2);
  // Depth 4 bytes, two floats 8; as much again while it is blurred is scratch.
  EXPECT_EQ(rows[1].at("bytes_ratio"), 3.0);
  EXPECT_EQ(rows[3].at("bytes_ratio"), 3.0);
  EXPECT_GE(rows[3].at("scratch_bytes"), 64 * 64 * 8);
}

TEST(Filters, says_what_the_maps_of_a_scene_need_and_what_that_saves) {
  const auto fit = [](const std::string& bound) {
    const Finished finished = run_gnomon({"filters", "--fit", "builtin:hangar", "--fit-bound", bound,
                                          "--json", "--filters", "esm", "lvsm:layers=3", "pcf"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    std::vector<json> rows;
    for (const std::string& line : finished.lines()) rows.push_back(json::parse(line));
    return rows;
  };
  const std::vector<json> strict = fit("0.5"), lax = fit("255");
  ASSERT_EQ(strict.size(), 2u) << "pcf stores nothing";
  ASSERT_EQ(lax.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GT(strict[i].at("receivers"), 100);
    EXPECT_LE(strict[i].at("error").get<double>(), 0.5 / 255);
    EXPECT_LE(lax[i].at("bytes_per_texel").get<double>(), strict[i].at("bytes_per_texel").get<double>());
    EXPECT_LE(strict[i].at("bytes_per_texel").get<double>(),
              strict[i].at("bytes_per_texel_asked").get<double>());
  }
  EXPECT_EQ(lax[1].at("needed"), "lvsm:layers=1");
  EXPECT_EQ(lax[1].at("channels_asked"), 6);
}

TEST(Filters, says_what_is_wrong_in_one_line) {
  const Finished finished = run_gnomon({"filters", "--cost", "--filters", "soft"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.out.find("| "), std::string::npos);
  EXPECT_NE(finished.err.find("'soft'"), std::string::npos);
  const TemporaryFolder folder;
  const std::string below_a_file = folder.write("file", "") + "/gallery";
  for (const auto& [arguments, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"filters", "--filters", "pcf"}, "--filters requires --cost, --contacts or --fit"},
           {{"filters", "--fit-bound", "1"}, "--fit-bound requires --fit"},
           {{"filters", "--fit", "builtin:nowhere"}, "nowhere"},
           {{"filters", "--cost", "--context", "glfw"}, "--context glfw: wants auto, osmesa or egl"},
           {{"filters", "--gallery", below_a_file},
            "--gallery " + below_a_file + ": cannot be made a folder"}}) {
    const Finished refused = run_gnomon(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find(said), std::string::npos) << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
}

}  // namespace
}  // namespace gnomon::test
