// `gnomon bias` and `gnomon compare --layers` from outside: their rows, and what they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/render/depth_layer.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;

TEST(Bias, table_shows_the_acne_of_the_first_surface_and_that_other_layers_lack_it) {
  const Finished finished = run_gnomon({"bias", "builtin:terrain", "--size", "96x54", "--map-size", "256",
                                        "--biases", "zero,default", "--context", "osmesa", "--json"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::map<std::pair<std::string, std::string>, json> rows;
  std::istringstream lines(finished.out);
  for (std::string line; std::getline(lines, line);) {
    const json row = json::parse(line);
    EXPECT_EQ(row.at("scene"), "builtin:terrain");
    EXPECT_GE(row.at("contact_gap_texels"), 0.0);
    rows[{row.at("layer"), row.at("bias")}] = row;
  }
  ASSERT_EQ(rows.size(), 2u * render::kDepthLayerCount);
  const auto false_shadow = [&](const char* layer, const char* bias) {
    return rows.at({layer, bias}).at("false_shadow").get<double>();
  };
  EXPECT_GT(false_shadow("front", "zero"), 0.2);
  EXPECT_LT(false_shadow("front", "default"), 0.02);
  // The hills' sheet has no other surface behind it, and culled front faces leave nothing to be shadowed by.
  EXPECT_LT(false_shadow("back", "zero"), 0.02);
  EXPECT_LT(false_shadow("dual", "zero"), 0.02);
}

TEST(Bias, identifiers_need_no_bias_where_nothing_shadows_itself) {
  const auto false_shadow = [](const char* filter, const char* layers) {
    const Finished finished =
        run_gnomon({"bias", "builtin:terrain", "--size", "96x54", "--map-size", "256", "--filter", filter,
                    "--layers", layers, "--biases", "zero", "--context", "osmesa", "--json"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return json::parse(finished.out).at("false_shadow").get<double>();
  };
  const double by_depth = false_shadow("hard", "front"), by_instance = false_shadow("identifiers", "front");
  EXPECT_GT(by_depth, 0.2);
  EXPECT_LT(by_instance, 0.1 * by_depth);
  EXPECT_LE(false_shadow("identifiers:neighbours=1", "front"), by_instance);
  EXPECT_GT(false_shadow("identifiers:of=triangle", "front"), by_instance);
}

TEST(Bias, linear_depths_are_a_row_beside_their_layer) {
  const Finished finished = run_gnomon({"bias", "builtin:hangar", "--light", "point", "--size", "64x36",
                                        "--map-size", "256", "--layers", "front,front:linear", "--biases",
                                        "zero,default", "--context", "osmesa", "--json"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::map<std::string, int> rows;
  std::istringstream lines(finished.out);
  for (std::string line; std::getline(lines, line);) ++rows[json::parse(line).at("layer").get<std::string>()];
  EXPECT_EQ(rows, (std::map<std::string, int>{{"front", 2}, {"front:linear", 2}}));
}

TEST(Bias, refuses_bad_input_in_one_line) {
  const std::vector<std::vector<std::string>> bad = {
      {"bias", "builtin:nowhere"},
      {"bias", "--layers", "front,behind"},
      {"bias", "--biases", "none"},
      {"bias", "--filter", "irregular"},
      {"bias", "--filter", "identifiers:of=object"},
      {"bias", "--filter", "identifiers:neighbours=9"},
      {"bias", "--filter", "identifiers:"},
      {"bias", "--filter", "identifiers", "--layers", "back"},
      {"bias", "--layers", "front:even"},
      {"compare", "builtin:fence", "--layers", "front:linear", "--filters", "identifiers"},
      {"compare", "builtin:fence", "--warps", "optimal", "--shapes", "logarithmic", "--filters",
       "identifiers"},
      {"bias", "--filter", "blur"},
      {"bias", "--warp", "bent"},
      {"bias", "--cascades", "9"},
      {"bias", "--size", "10"},
      {"bias", "--light-near-share", "0"},
      {"bias", "--light-near-share", "0.6"},
      {"compare", "builtin:fence", "--layers", "middle"},
      {"compare", "builtin:fence", "--layers", "back,dual", "--filters", "irregular"},
  };
  for (const std::vector<std::string>& words : bad) {
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 2) << words.back() << finished.out;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

TEST(Bias, refusals_name_the_option_that_was_given) {
  EXPECT_NE(run_gnomon({"bias", "--warp", "bent"}).err.find("--warp bent: wants auto, none"),
            std::string::npos);
  EXPECT_NE(run_gnomon({"bias", "--filter", "blur"}).err.find("--filter "), std::string::npos);
  EXPECT_NE(run_gnomon({"bias", "--biases", "none"}).err.find("--biases none: wants all"), std::string::npos);
}

TEST(CompareLayers, every_layer_has_a_row_and_irregular_is_measured_once) {
  const TemporaryFolder folder;
  const Finished finished = run_gnomon({"compare",     "builtin:fence",
                                        "--warps",     "none",
                                        "--cascades",  "1",
                                        "--filters",   "hard,irregular,identifiers:of=triangle",
                                        "--layers",    "all,front:linear",
                                        "--frames",    "1",
                                        "--size",      "64x36",
                                        "--rounds",    "1",
                                        "--map-sizes", "128",
                                        "--context",   "osmesa",
                                        "--out",       folder.path().string()});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.err.find("--layers skips irregular"), std::string::npos) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path());
  EXPECT_NE(finished.err.find("--layers skips identifiers"), std::string::npos) << finished.err;
  ASSERT_EQ(rows.size(), render::kDepthLayerCount + 3);
  std::map<std::string, report::Row> by_layer;
  for (const report::Row& row : rows) {
    EXPECT_GT(row.times.total_ms.median, 0.0);
    if (row.technique.filter == "hard") by_layer[row.technique.layer] = row;
  }
  ASSERT_EQ(by_layer.size(), render::kDepthLayerCount + 1);
  EXPECT_EQ(by_layer.at("front:linear").costs.triangles, by_layer.at("").costs.triangles);
  const report::Row& front = by_layer.at("");
  EXPECT_EQ(front.technique.name().find("layer"), std::string::npos);
  for (const char* layer : {"back", "second", "midpoint", "dual"}) {
    const report::Row& row = by_layer.at(layer);
    const bool peels = std::string(layer) != "back";
    EXPECT_EQ(row.costs.triangles, (peels ? 2 : 1) * front.costs.triangles) << layer;
    EXPECT_NE(row.technique.name().find(std::string(layer) + " layer"), std::string::npos);
    // The usual bias hides the difference between the first surface and one close behind it.
    const bool far_behind = std::string(layer) == "back" || std::string(layer) == "second";
    if (far_behind) {
      EXPECT_NE(row.errors.false_lit, front.errors.false_lit) << layer;
    }
  }
}

TEST(BiasSweep, sets_each_bias_beside_the_default_in_the_same_view) {
  const std::vector<std::string> one_view{"bias",  "builtin:terrain", "--size",
                                          "96x54", "--context",       "osmesa"};
  std::vector<std::string> words = one_view;
  for (const char* word :
       {"--sweep", "--filters", "hard", "--warps", "none", "--map-sizes", "256", "--lights", "sun",
        "--constants", "0", "--slopes", "0", "--max-slopes", "8", "--normal-offsets", "0"})
    words.emplace_back(word);
  const Finished table = run_gnomon(words);
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_NE(table.out.find("| 0.15 | 0.5 | 0.1 | 4 | all | "), std::string::npos) << table.out;
  EXPECT_NE(table.out.find(" | 1.000 | 1.000 | 1.00 | 0 of 1 | "), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("| 0 | 0 | 0 | 8 | hard | "), std::string::npos) << table.out;

  words.push_back("--json");
  const Finished rows = run_gnomon(words);
  ASSERT_EQ(rows.exit_code, 0) << rows.err;
  std::istringstream lines(rows.out);
  std::string first, second, third;
  ASSERT_TRUE(std::getline(lines, first) && std::getline(lines, second) && !std::getline(lines, third));
  const json of_default = json::parse(first), without = json::parse(second);
  EXPECT_GT(of_default.at("pixels"), 1000.0);
  EXPECT_GT(without.at("false_shadow"), of_default.at("false_shadow"));
  EXPECT_GT(without.at("too_dark"), of_default.at("too_dark"));

  // The same frame by the other table of this command.
  std::vector<std::string> single = one_view;
  for (const char* word : {"--biases", "default", "--layers", "front", "--map-size", "256", "--json"})
    single.emplace_back(word);
  const Finished known = run_gnomon(single);
  ASSERT_EQ(known.exit_code, 0) << known.err;
  const json row = json::parse(known.out);
  EXPECT_NEAR(row.at("false_shadow").get<double>(), of_default.at("false_shadow").get<double>(), 1e-9);
  EXPECT_NEAR(row.at("false_light").get<double>(), of_default.at("false_light").get<double>(), 1e-9);
}

TEST(BiasSweep, refuses_what_it_cannot_draw_by_name) {
  const auto refused = [](std::vector<std::string> words, const char* text) {
    words.insert(words.begin(), "bias");
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_NE(finished.err.find(text), std::string::npos) << finished.err;
  };
  refused({"--sweep", "--lights", "moon"}, "--lights moon: wants sun, spot or point");
  refused({"--sweep", "--lights", "sun:91"}, "--lights 91: wants a number between 0.1 and 90");
  refused({"--sweep", "--slopes", "-1"}, "--slopes -1: wants a number between 0 and 1e+06");
  refused({"--sweep", "--filters", "irregular"}, "irregular");
  refused({"--slopes", "1"}, "--sweep");
  refused({"--sweep", "--filter", "hard"}, "--filter");
}

}  // namespace
}  // namespace gnomon::test
