// `gnomon compare study.json`: one file that is the whole study, and what is wrong with others.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "compare/texel_shares.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

/// Writes the text as study.json and compares by it.
Finished compared_by(const TemporaryFolder& folder, const std::string& text,
                     const std::vector<std::string>& more = {}) {
  const fs::path file = folder.path() / "study.json";
  std::ofstream(file) << text;
  std::vector<std::string> words{"compare", file.string(), "--context",
                                 "osmesa",  "--out",       (folder.path() / "out").string()};
  words.insert(words.end(), more.begin(), more.end());
  return run_gnomon(words);
}

const std::string kTwoViews =
    R"({"schema": "gnomon-study/1", "filters": ["hard", "pcf:footprint=1"], "warps": "none",
  "cascades": 1, "map_sizes": [256], "frames": 1, "rounds": 1, "size": "64x36", "views": [
    {"scenes": ["builtin:fence", "builtin:hangar"]},
    {"scenes": "builtin:fence", "eye": "0,20,120", "target": "0,1,0", "filters": ["hard"]}]})";

TEST(StudyFile, measures_every_view_with_its_own_fields_and_is_continued) {
  const TemporaryFolder folder;
  const Finished first = compared_by(folder, kTwoViews);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path() / "out");
  ASSERT_EQ(rows.size(), 5u);
  std::set<std::uint64_t> places;
  for (const report::Row& row : rows) places.insert(row.index);
  EXPECT_EQ(places, (std::set<std::uint64_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(rows[1].technique.filter, "pcf:footprint=1");
  EXPECT_EQ(rows[3].scene, "builtin:hangar");
  EXPECT_EQ(rows[4].camera, "eye 0,20,120 target 0,1,0");
  ASSERT_TRUE(rows[0].pixel.has_value());
  EXPECT_GT(rows[0].pixel->pixels, 500u);
  EXPECT_GT(rows[0].pixel->error, 0.0);
  EXPECT_GT(rows[0].times.baseline_again_ms, 0.0);
  // The same scene through two cameras is two scenes to the report.
  const std::string page = [&] {
    std::ifstream in(folder.path() / "out/report.html");
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  EXPECT_NE(page.find("builtin:fence, eye 0,20,120 target 0,1,0"), std::string::npos);
  EXPECT_EQ(compared_by(folder, kTwoViews).exit_code, 2) << "results are there already";
  EXPECT_EQ(compared_by(folder, kTwoViews, {"--resume"}).exit_code, 0);
  EXPECT_EQ(report::read_rows(folder.path() / "out").size(), 5u);
}

TEST(StudyFile, is_refused_by_the_field_that_is_wrong) {
  const struct {
    const char *text, *names;
  } cases[] = {
      {"[]", "study.json: needs an object"},
      {"{}", "study.json: schema: must be \"gnomon-study/1\""},
      {R"({"schema": "gnomon-study/1"})", "study.json: scenes: is missing"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fenc"})", "study.json: scenes builtin:fenc"},
      {R"({"schema": "gnomon-study/1", "views": []})", "study.json: views: needs a list"},
      {R"({"schema": "gnomon-study/1", "views": [{}]})", "study.json: views[0].scenes: is missing"},
      {R"({"schema": "gnomon-study/1", "views": [{"scenes": "builtin:fence", "frames": 1.5}]})",
       "study.json: views[0].frames: needs a whole number"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "filters": ["hard", "pcg"]})",
       "study.json: filters"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "rounds": 0})",
       "study.json: rounds: is not from 1"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "visible_depths": "yes"})",
       "study.json: visible_depths: needs true or false"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "eye": "0,1"})", "study.json: eye"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "eye": "0,1,2"})",
       "study.json: --eye and --target"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "filter": "hard"})",
       "did you mean 'filters'"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "out": "x"})",
       "study.json: out: belongs on the command line"},
      {R"({"schema": "gnomon-study/1", "views": [{"name": "a", "scenes": "builtin:fence"}, {"name": "a", "scenes": "builtin:room"}]})",
       "study.json: views[1].name: is the name of another view"},
      {R"({"schema": "gnomon-study/1", "views": [{"scenes": "builtin:fence", "optional": 1}]})",
       "study.json: views[0].optional: needs true or false"},
      {R"({"schema": "gnomon-study/1", "views": [{"scenes": "builtin:fence", "licence": ""}]})",
       "study.json: views[0].licence: needs a text"},
      {R"({"schema": "gnomon-study/1", "views": [{"scenes": "builtin:fence", "hash": "0123456789abcdef"}]})",
       "study.json: views[0].hash: builtin:fence has none, and not 0123456789abcdef"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "local_lights": 2, "light": "spot"})",
       "study.json: local_lights: does not go with light"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "exact": "x"})",
       "study.json: exact: belongs on the command line"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "techniques": {}})",
       "study.json: techniques: needs a list"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "techniques": [{"filter": "pcg"}]})",
       "study.json: techniques[0]: --filters 'pcg'"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "techniques": [{"cascades": 9}]})",
       "study.json: techniques[0].cascades: is not from 1"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "techniques": [{"wrap": "none"}]})",
       "study.json: techniques[0].wrap: is no field of a study; did you mean 'warp'"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "techniques": [{"name": "theirs", "source": "a", "differs": "b"}]})",
       "study.json: techniques[0].checked: needs a text"},
      {R"({"schema": "gnomon-study/1", "scenes": "builtin:fence", "techniques": [{"name": "a/b", "source": "a", "differs": "b", "checked": "c"}]})",
       "study.json: techniques[0].name: wants at most 60"},
      {R"({"schema": "gnomon-study/1", "views": [{"scenes": "builtin:fence", "techniques": [{"pages": "clipmap", "page_texels": 100}]}]})",
       "study.json: views[0].techniques[0].page_texels: wants 64, 128 or 256"},
      {R"({"schema": "gnomon-study/1", )", "study.json: "},
  };
  for (const auto& [text, names] : cases) {
    const TemporaryFolder folder;
    const Finished finished = compared_by(folder, text);
    EXPECT_EQ(finished.exit_code, 2) << text;
    EXPECT_NE(finished.err.find(names), std::string::npos) << text << "\n" << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_FALSE(fs::exists(folder.path() / "out")) << text;
  }
}

TEST(StudyFile, measures_techniques_beside_the_product_by_their_names) {
  const TemporaryFolder folder;
  const std::string text = R"({"schema": "gnomon-study/1", "filters": "hard", "warps": "none", "cascades": 1,
    "map_sizes": 64, "frames": 1, "rounds": 1, "size": "64x36", "scenes": "builtin:fence", "techniques": [
    {"filter": "hard", "map_size": 64},
    {"filter": "pcf", "warp": "optimal", "map_size": 128},
    {"name": "theirs", "fit": "stable", "split": "practical", "cascades": 2, "map_size": 64, "source": "a", "differs": "b", "checked": "c"},
    {"name": "their pages", "pages": "clipmap", "cascades": 2, "map_size": 256, "page_texels": 64, "source": "a", "differs": "b", "checked": "c"}]})";
  const Finished finished = compared_by(folder, text);
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path() / "out");
  ASSERT_EQ(rows.size(), 4u) << "the first is the product's";
  EXPECT_EQ(rows[1].technique.name(), "optimal / auto / 1 x 128 / pcf");
  EXPECT_EQ(rows[2].technique.name(), "theirs / 2 x 64 / hard");
  EXPECT_EQ(rows[2].technique.fit, "stable");
  EXPECT_FALSE(rows[2].technique.is_given());
  EXPECT_EQ(rows[2].costs.maps, 2);
  EXPECT_GT(rows[2].times.plan_ns.median, 0.0);
  EXPECT_EQ(rows[3].technique.entry, "their pages");
  EXPECT_GT(rows[3].costs.maps, 0);
  // The same plan without a name has the same errors.
  const TemporaryFolder other;
  std::string unnamed = text;
  const std::string name = R"("name": "theirs", )";
  unnamed.erase(unnamed.find(name), name.size());
  ASSERT_EQ(compared_by(other, unnamed).exit_code, 0);
  const report::Row plain = report::read_rows(other.path() / "out").at(2);
  EXPECT_EQ(plain.technique.name(), "none / practical stable / 2 x 64 / hard");
  EXPECT_EQ(plain.errors.false_lit, rows[2].errors.false_lit);
  EXPECT_EQ(plain.errors.false_shadow, rows[2].errors.false_shadow);
}

TEST(StudyFile, measures_each_of_many_lights_that_share_their_texels) {
  const TemporaryFolder folder;
  const std::string text = R"({"schema": "gnomon-study/1", "filters": "hard", "warps": "none", "cascades": 1,
    "splits": ["auto", "auto:budget"], "map_sizes": 64, "frames": 1, "rounds": 1, "size": "64x36",
    "local_lights": 4, "scenes": "builtin:hangar", "near": 0.3})";
  const Finished finished = compared_by(folder, text);
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path() / "out");
  ASSERT_EQ(rows.size(), 8u);
  std::set<std::string> lights, keys;
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    EXPECT_EQ(rows[i].technique.split, "auto");
    EXPECT_EQ(rows[i + 1].technique.split, "auto:budget");
    EXPECT_EQ(rows[i].light, rows[i + 1].light);
    lights.insert(rows[i].light);
    keys.insert({rows[i].key(), rows[i + 1].key()});
  }
  EXPECT_EQ(lights, (std::set<std::string>{"spot 1 of 4", "point 2 of 4", "point 3 of 4", "spot 4 of 4"}));
  EXPECT_EQ(keys.size(), 8u);
  EXPECT_EQ(compared_by(folder, text, {"--resume"}).exit_code, 0);
  EXPECT_EQ(report::read_rows(folder.path() / "out").size(), 8u);
}

TEST(StudyFile, drops_a_field_that_does_not_go_with_one_of_a_view) {
  const TemporaryFolder folder;
  const Finished finished = compared_by(folder, R"({"schema": "gnomon-study/1", "filters": "hard",
    "warps": "none", "cascades": 1, "map_sizes": 64, "frames": 1, "rounds": 1, "size": "64x36", "near": 0.3,
    "local_lights": 2, "views": [{"scenes": "builtin:hangar"}, {"scenes": "builtin:hangar", "light": "point"}]})");
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::set<std::string> lights;
  for (const report::Row& row : report::read_rows(folder.path() / "out")) lights.insert(row.light);
  EXPECT_EQ(lights, (std::set<std::string>{"spot 1 of 2", "point 2 of 2", "point"}));
}

TEST(TexelShares, gives_lights_sizes_of_their_own_within_the_texels_of_equal_maps) {
  const Box ground{{-30.0, -1.0, -30.0}, {30.0, 0.0, 30.0}}, house{{-4.0, 0.0, -8.0}, {4.0, 6.0, -2.0}};
  const std::vector<Box> boxes{ground, house};
  const SceneBounds bounds{boxes, boxes};
  const std::vector<Light> lights = local_lights(16, {{-30.0, 0.0, -30.0}, {30.0, 6.0, 30.0}});
  const Camera camera =
      perspective_camera({0, 5, 25}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.3, 200.0, 240, 160);
  tool::SweepEntry entry;
  entry.technique.map_size = 64;
  LightOptions options;
  options.plan = entry.plan;
  options.least_size = options.most_size = 64;
  std::vector<LightRequest> requests;
  for (const Light& light : lights) requests.push_back({light});
  std::vector<std::byte> memory(light_memory(requests.size(), 0));
  const LightPlan equal = plan_lights(gnomon::View(camera), requests, bounds, options, memory);
  ASSERT_GT(equal.texels, 0);
  const tool::TexelShares shares(lights);
  std::int64_t texels = 0;
  std::set<int> sizes;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const int size = shares.options_of(i, gnomon::View(camera), bounds, entry).resolution.max_size;
    if (equal.lights[i].map_count == 0) continue;
    sizes.insert(size);
    texels += std::int64_t{equal.lights[i].map_count} * size * size;
  }
  EXPECT_GT(sizes.size(), 1u);
  EXPECT_LE(texels, equal.texels);
  EXPECT_GT(2 * texels, equal.texels) << "most of the budget is used";
}

TEST(StudyFile, omits_an_optional_view_whose_file_is_absent_and_names_it) {
  const TemporaryFolder folder;
  const std::string text = R"({"schema": "gnomon-study/1", "filters": "hard", "warps": "none", "cascades": 1,
    "map_sizes": 64, "frames": 1, "rounds": 1, "size": "64x36", "views": [
    {"name": "thin: fence", "scenes": "builtin:fence"},
    {"name": "lost", "scenes": "nowhere/scene.gltf", "optional": true, "hash": "0", "licence": "CC0-1.0"},
    {"name": "thin: low sun", "scenes": "builtin:fence", "light_elevation_deg": 10}]})";
  const Finished finished = compared_by(folder, text);
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.err.find("study.json: views[1]: nowhere/scene.gltf is not there"), std::string::npos)
      << finished.err;
  EXPECT_EQ(message_lines(finished.err), 1) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path() / "out");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].view, "thin: fence");
  EXPECT_EQ(rows[1].view, "thin: low sun");
  const TemporaryFolder other;
  const Finished none = compared_by(
      other,
      R"({"schema": "gnomon-study/1", "views": [{"scenes": "nowhere/scene.gltf", "optional": true}]})");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("study.json: no view is left"), std::string::npos) << none.err;
}

TEST(StudyFile, takes_no_field_from_the_command_line) {
  const TemporaryFolder folder;
  const Finished finished = compared_by(folder, kTwoViews, {"--filters", "hard"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_NE(finished.err.find("--filters: not beside a study"), std::string::npos) << finished.err;
}

}  // namespace
}  // namespace gnomon::test
