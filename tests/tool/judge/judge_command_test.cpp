// `gnomon judge`: figures, findings, limits, pictures in a scene, and what it refuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "gnomon/gnomon.hpp"
#include "gnomon/scene/load.hpp"
#include "judge/plan_capture.hpp"
#include "process.hpp"

namespace gnomon::test {
namespace {

using Json = nlohmann::ordered_json;

std::string capture(const char* name) {
  return std::string(GNOMON_CAPTURES "/") + name;
}

/// A plan of ours for a built-in scene as any engine would hand its maps in.
std::string plan_as_capture(const TemporaryFolder& folder, const std::string& scene_name) {
  const Scene scene = load_scene(scene_name);
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
  const glm::dvec3 middle = 0.5 * (scene.bounds_world.min + scene.bounds_world.max);
  const double size = glm::length(scene.bounds_world.max - scene.bounds_world.min);
  const Camera camera = perspective_camera(middle + glm::dvec3(0.25, 0.15, 0.25) * size, {-1.0, -0.6, -1.0},
                                           {0, 1, 0}, 1.0, 1.5, 0.002 * size, size, 240, 160);
  const DirectionalLight sun{{0.4, -1.0, -0.3}};
  PlanOptions options;
  options.cascades = 2;
  options.resolution.max_size = 512;
  const ShadowPlan plan = make_plan(camera, sun, {boxes, boxes}, options);
  nlohmann::json file = judge::test::plan_capture(plan, camera, sun.direction);
  file["bias"] = {{"texels", 0.15}, {"slope_texels", 0.5}, {"follows_plane", true}};
  return folder.write("plan.json", file.dump());
}

TEST(EngineMaps, prints_figures_and_findings) {
  const Finished text = run_gnomon({"judge", capture("babylon_cascades.json")});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("swimming: "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("gnomon, fit tight: 4 maps"), std::string::npos) << text.out;
  const Json found = Json::parse(run_gnomon({"judge", capture("babylon_cascades.json"), "--json"}).out);
  EXPECT_EQ(found["frames"], 8);
  EXPECT_EQ(found["lights"][0]["m_of_maps"].size(), 4u);
  EXPECT_EQ(found["findings"].size(), 2u);
  EXPECT_GT(found["lights"][0]["m"]["p95"], found["lights"][0]["gnomon"][0]["m"]["p95"]);
}

TEST(EngineMaps, exits_with_one_beyond_a_limit) {
  const std::string file = capture("three_csm.json");
  EXPECT_EQ(run_gnomon({"judge", file, "--max-m", "6.5"}).exit_code, 1);
  EXPECT_EQ(run_gnomon({"judge", file, "--max-m", "6.7"}).exit_code, 0);
  EXPECT_EQ(run_gnomon({"judge", file, "--max-findings", "0"}).exit_code, 0);
  EXPECT_EQ(run_gnomon({"judge", capture("babylon_cascades.json"), "--max-findings", "1"}).exit_code, 1);
  EXPECT_EQ(run_gnomon({"judge", capture("babylon_cascades.json"), "--max-findings", "2"}).exit_code, 0);
}

TEST(EngineMaps, writes_a_page_that_needs_nothing_else) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "judged").string();
  const Finished run = run_gnomon({"judge", capture("babylon_cascades.json"), "--out", out});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string page = content_of(folder.path() / "judged/judge.html");
  EXPECT_NE(page.find("Edges in map"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(Json::parse(content_of(folder.path() / "judged/judge.json"))["engine"], "Babylon.js 9.35.0");
}

TEST(EngineMaps, keeps_names_of_a_capture_out_of_the_page) {
  const TemporaryFolder folder;
  Json file = Json::parse(content_of(capture("ogre_pssm.json")));
  file["name"] = "<script>alert(1)</script>";
  file["engine"] = "\"><img src=x>";
  const std::string out = (folder.path() / "judged").string();
  EXPECT_EQ(run_gnomon({"judge", folder.write("c.json", file.dump()), "--out", out}).exit_code, 0);
  const std::string page = content_of(folder.path() / "judged/judge.html");
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<img src=x"), std::string::npos);
}

TEST(EngineMaps, a_plan_of_ours_draws_as_well_as_itself) {
  const TemporaryFolder folder;
  const Finished run =
      run_gnomon({"judge", plan_as_capture(folder, "builtin:city"), "builtin:city", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json found = Json::parse(run.out);
  const Json& drawn = found["lights"][0]["drawn"];
  EXPECT_GT(drawn["pixels"], 5000);
  EXPECT_GT(drawn["capture"]["misclassified"], 0.0);
  EXPECT_NEAR(drawn["capture"]["misclassified"], drawn["gnomon"]["misclassified"], 1e-3);
  EXPECT_NEAR(found["lights"][0]["m"]["p95"], found["lights"][0]["gnomon"][0]["m"]["p95"], 0.02);
  // What is missing there comes from the scene, and is sound.
  for (const Json& finding : found["findings"]) ADD_FAILURE() << finding.dump();
  const std::string limit = "0.001";
  EXPECT_EQ(run_gnomon({"judge", (folder.path() / "plan.json").string(), "builtin:city",
                        "--max-misclassified", limit})
                .exit_code,
            1);
}

TEST(EngineMaps, within_no_limit_where_nothing_was_compared) {
  const TemporaryFolder folder;
  Json c = Json::parse(content_of(capture("three_spot.json"))), two = c;
  // A second spot that reaches nothing in view takes nothing from what was compared of the first.
  two["lights"].push_back(c["lights"][0]);
  two["lights"][1]["position"][1] = 1000.0;
  two["lights"][1]["direction"] = {0, 1, 0};
  two["maps"].push_back(c["maps"][0]);
  two["maps"][1]["light"] = 1;
  EXPECT_EQ(run_gnomon({"judge", folder.write("two.json", two.dump()), "--max-m", "1000"}).exit_code, 0);
  // Far above all that is there: another scene, or another unit.
  c["camera"]["view_from_world"][13] = -1e5;
  const std::string file = folder.write("c.json", c.dump());
  EXPECT_EQ(run_gnomon({"judge", file}).exit_code, 0);
  EXPECT_EQ(run_gnomon({"judge", file, "--max-m", "1000"}).exit_code, 1);
  EXPECT_EQ(run_gnomon({"judge", file, "builtin:street", "--max-misclassified", "50"}).exit_code, 1);
}

TEST(EngineMaps, refuses_in_one_line) {
  const TemporaryFolder folder;
  const auto refused = [](const std::vector<std::string>& arguments, const std::string& what) {
    const Finished run = run_gnomon(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_NE(run.err.find(what), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "");
  };
  refused({"judge", (folder.path() / "none.json").string()}, "none.json: ");
  refused({"judge", folder.path().string()}, "is a folder");
  refused({"judge", folder.write("half.json", "{\"format\": \"gnomon-capt")}, "half.json: ");
  refused({"judge", capture("babylon_cascades.json"), "builtin:city"}, "left-handed");
  refused({"judge", capture("three_spot.json"), "builtin:citty"}, "builtin:city");
  refused({"judge", capture("three_spot.json"), "--max-misclassified", "3"}, "SCENE");
}

}  // namespace
}  // namespace gnomon::test
