// Do the programs play animations: the viewer, its exact shadows, and the flight?
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "animated_gltf.hpp"
#include "gnomon/report/rows_file.hpp"
#include "gnomon/scene/pose.hpp"
#include "process.hpp"
#include "render/shared_context.hpp"
#include "stage.hpp"

namespace gnomon::tool::view {
namespace {

using test::Finished;
using test::spawn_gnomon;

constexpr int kWidth = 160, kHeight = 90;

/// The animated scene as a file.
struct SceneFile {
  test::TemporaryFolder folder;
  std::string file = folder.write("animated.glb", test::animated_gltf().file());
  std::string still = folder.write("still.glb", test::one_triangle().file());
};

State at(const SceneFile& scene, double time_s, View view = View::lit) {
  State state;
  state.scene = scene.file;
  state.view = view;
  state.a.plan.resolution.max_size = 512;
  state.playing = {"all", time_s, false, 1.0};
  return state;
}

Image picture(Stage& stage, const State& state) {
  EXPECT_EQ(stage.draw(state, kWidth, kHeight, true), "");
  if (stage.truth_progress()) {
    stage.finish_truth();
    EXPECT_EQ(stage.draw(state, kWidth, kHeight, true), "");
  }
  return stage.canvas().image();
}

/// Flies over the animated scene with these words, pictures in `folder`.
Finished fly(const SceneFile& scene, const std::string& folder, const std::vector<std::string>& more) {
  std::vector<std::string> words{"fly", scene.file, "--out", (scene.folder.path() / folder).string()};
  words.insert(words.end(), more.begin(), more.end());
  const Finished run = spawn_gnomon(words);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run;
}

TEST(Playing, the_picture_is_that_of_the_time_alone) {
  const SceneFile scene;
  Stage stage(load(scene.file, LoadLimits{}.triangles));
  const Image begin = picture(stage, at(scene, 0.0)), middle = picture(stage, at(scene, 1.0));
  EXPECT_NE(begin.rgba, middle.rgba);
  EXPECT_EQ(picture(stage, at(scene, 4.0)).rgba, begin.rgba) << "it repeats";
  EXPECT_EQ(picture(stage, at(scene, 1.0)).rgba, middle.rgba);
  Stage fresh(load(scene.file, LoadLimits{}.triangles));
  EXPECT_EQ(picture(fresh, at(scene, 1.0)).rgba, middle.rgba);
  State rest = at(scene, 1.0);
  rest.playing = {};
  const Image at_rest = picture(stage, rest);
  EXPECT_NE(at_rest.rgba, middle.rgba);
  Stage untouched(load(scene.file, LoadLimits{}.triangles));
  EXPECT_EQ(picture(untouched, rest).rgba, at_rest.rgba);
}

TEST(Playing, exact_shadows_are_those_of_the_pose) {
  const SceneFile scene;
  Stage stage(load(scene.file, LoadLimits{}.triangles));
  const Image begin = picture(stage, at(scene, 0.0, View::truth));
  for (const double time : {1.6, 2.4}) {
    EXPECT_NE(picture(stage, at(scene, time, View::truth)).rgba, begin.rgba);
    (void)picture(stage, at(scene, time, View::misclassified));
    const auto& errors = stage.side(0).errors;
    ASSERT_TRUE(errors);
    EXPECT_GT(errors->pixels, 1000u);
    // Rays against another pose would disagree over the whole shadow of the figures.
    EXPECT_LT(errors->false_lit + errors->false_shadow, 0.02);
  }
}

TEST(Playing, rays_go_against_the_present_pose_whatever_was_being_sorted) {
  const SceneFile scene;
  const auto loaded = load(scene.file, LoadLimits{}.triangles);
  render::Renderer renderer(loaded->scene);
  // Begins with the scene at rest, and is not waited for.
  PosedScene posed(std::shared_ptr<const Scene>(loaded, &loaded->scene), loaded->boxes);
  bool moved = false;
  ASSERT_EQ(posed.follow({"all", 2.0, false, 1.0}, renderer, moved), "");
  ASSERT_TRUE(moved);
  posed.take_tracer(true);
  // Down on the walking box and the one that it carries, half way through.
  trace::Ray down;
  down.origin = {3.0, 5.0, 3.5};
  down.direction = {0.0, -1.0, 0.0};
  EXPECT_NEAR(posed.tracer()->first_hit(down).t, 5.0 - 2.4, 1e-5);
}

TEST(Playing, an_animation_that_is_not_there_is_refused_and_the_picture_stays) {
  const SceneFile scene;
  Stage stage(load(scene.file, LoadLimits{}.triangles));
  const Image before = picture(stage, at(scene, 1.0));
  State other = at(scene, 1.0);
  other.playing.animation = "run";
  EXPECT_NE(stage.draw(other, kWidth, kHeight, true).find("it has all"), std::string::npos);
  EXPECT_EQ(stage.canvas().image().rgba, before.rgba);
}

TEST(Playing, commands_speak_it) {
  State state = at(SceneFile(), 1.25);
  EXPECT_NE(command_text(state).find("--animation all --animation-time=1.25"), std::string::npos);
  state.playing.on = true;
  state.playing.speed = -2.0;
  EXPECT_NE(command_text(state).find("--animate=-2"), std::string::npos);
  const State back = read_state(state_text(state));
  EXPECT_EQ(back.playing.animation, "all");
  EXPECT_EQ(back.playing.speed, -2.0);
  EXPECT_TRUE(back.playing.on);
}

TEST(Playing, the_accumulate_command_plays_up_to_the_frame_that_it_measures) {
  const SceneFile scene;
  const Finished finished = spawn_gnomon({"accumulate", scene.file, "--animation", "all", "--size", "160x90",
                                          "--map-size", "64", "--frames", "8", "--moving", "8", "--json"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::vector<nlohmann::json> rows;
  std::istringstream lines(finished.out);
  for (std::string line; std::getline(lines, line);) rows.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(rows.size(), 5u) << finished.out;
  EXPECT_EQ(rows[0].at("view"), "at rest");
  EXPECT_EQ(rows[3].at("view"), "animated, alone");
  EXPECT_EQ(rows[4].at("view"), "animated");
  EXPECT_EQ(rows[4].at("frames"), 8);
  EXPECT_GE(rows[4].at("ghosting"), 0.0);
  EXPECT_LT(rows[4].at("to_first"), 1.0) << finished.out;
  EXPECT_GT(rows[4].at("misclassified"), rows[0].at("misclassified")) << "moving casters do not converge";
  const Finished unknown = spawn_gnomon({"accumulate", scene.file, "--animation", "run", "--size", "160x90"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_EQ(std::count(unknown.err.begin(), unknown.err.end(), '\n'), 1) << unknown.err;
}

TEST(Playing, the_view_command_draws_a_pose) {
  const SceneFile scene;
  const auto draw = [&](const char* name, std::vector<std::string> more) {
    std::vector<std::string> words{"view",   scene.file, "--out",      (scene.folder.path() / name).string(),
                                   "--size", "160x90",   "--map-size", "256"};
    words.insert(words.end(), more.begin(), more.end());
    const Finished run = spawn_gnomon(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return test::content_of(scene.folder.path() / name);
  };
  const std::string rest = draw("rest.png", {}),
                    one = draw("one.png", {"--animation", "all", "--animation-time", "1"});
  EXPECT_NE(rest, one);
  EXPECT_EQ(draw("again.png", {"--animation-time", "5"}), one) << "the first animation, round once";
  const Finished unknown = spawn_gnomon({"view", scene.file, "--out", "x.png", "--animation", "run"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("it has all"), std::string::npos);
  const Finished none = spawn_gnomon({"view", scene.still, "--out", "x.png", "--animate", "1"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("has no animations"), std::string::npos);
}

TEST(Playing, the_fly_command_plays_while_it_flies) {
  const SceneFile scene;
  const auto pictures = [&](const char* name, std::vector<std::string> more) {
    more.insert(more.end(), {"--frames", "2", "--size", "96x54", "--map-size", "256"});
    (void)fly(scene, name, more);
    const auto folder = scene.folder.path() / name;
    return std::pair(test::content_of(folder / "frame_0000_image.png"),
                     test::content_of(folder / "frame_0001_image.png"));
  };
  const auto rest = pictures("rest", {}),
             plays = pictures("plays", {"--animation", "0", "--animation-fps", "1"});
  EXPECT_EQ(plays.first, rest.first) << "it begins at rest";
  EXPECT_NE(plays.second, rest.second);
  const auto later = pictures("later", {"--animation", "all", "--animation-start", "1"});
  EXPECT_NE(later.first, rest.first);
  const Finished unknown = spawn_gnomon({"fly", scene.file, "--animation", "run"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("it has all"), std::string::npos);
  const Finished hidden =
      spawn_gnomon({"fly", scene.file, "--animation", "0", "--filter", "pcss", "--resolution", "perceptual"});
  EXPECT_EQ(hidden.exit_code, 2);
  EXPECT_NE(hidden.err.find("at rest"), std::string::npos);
  EXPECT_EQ(spawn_gnomon({"fly", scene.file, "--animation-fps", "2"}).exit_code, 2);
}

TEST(Playing, stable_fits_fly_with_a_history_of_their_own) {
  const SceneFile scene;
  const auto pictures = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--animation", "all", "--animation-fps", "2", "--frames", "4", "--size",
                             "192x108", "--map-size", "256"});
    (void)fly(scene, "kept", more);
    std::string all;
    for (const char* frame : {"0001", "0002", "0003"})
      all += test::content_of(scene.folder.path() / "kept" / ("frame_" + std::string(frame) + "_image.png"));
    return all;
  };
  for (const char* fit : {"stable", "warped_stable"})
    EXPECT_EQ(pictures({"--fit", fit}), pictures({"--fit", fit, "--history"})) << fit;
  // Pages keep their grid without.
  EXPECT_FALSE(pictures({"--fit", "stable", "--pages", "clipmap", "--page-size", "64"}).empty());
}

TEST(Playing, stable_fits_are_shown_with_a_history_of_their_own) {
  const SceneFile scene;
  const auto pictures = [&](Fit fit, bool history) {
    Stage stage(load(scene.file, LoadLimits{}.triangles));
    std::vector<std::vector<std::uint8_t>> all;
    for (const double time : {0.0, 0.5, 1.0, 1.5}) {
      State state = at(scene, time);
      state.a.plan.fit = fit;
      state.a.history = history;
      all.push_back(picture(stage, state).rgba);
    }
    return all;
  };
  for (const Fit fit : {Fit::stable, Fit::warped_stable})
    EXPECT_EQ(pictures(fit, false), pictures(fit, true));
}

TEST(Playing, a_technique_is_chosen_by_the_poses_of_its_flight) {
  const SceneFile scene;
  const auto chosen = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--frames", "1", "--size", "160x90", "--target-error", "0.001"});
    const Finished run = fly(scene, "chosen", more);
    const std::size_t at = run.out.find("technique: ");
    EXPECT_NE(at, std::string::npos) << run.out;
    return run.out.substr(at, run.out.find('\n', at) - at);
  };
  const std::string rest = chosen({});
  EXPECT_EQ(chosen({"--animation", "all"}), rest) << "it begins at rest";
  EXPECT_NE(chosen({"--animation", "all", "--animation-start", "2"}), rest) << "other shadows";
  EXPECT_EQ(chosen({"--animation", "all", "--animation-start", "4"}), rest) << "round once";
}

TEST(Playing, the_compare_command_measures_each_frame_in_its_pose) {
  const SceneFile scene;
  const auto compare = [&](const char* name, std::vector<std::string> more) {
    const auto folder = scene.folder.path() / name;
    std::vector<std::string> words{
        "compare",  scene.file,  "--warps", "none",   "--cascades",   "2",           "--filters",
        "hard,pcf", "--frames",  "3",       "--size", "160x90",       "--map-sizes", "1024",
        "--rounds", "1",         "--fits",  "stable", "--pages",      "clipmap",     "--page-sizes",
        "64",       "--context", "osmesa",  "--out",  folder.string()};
    words.insert(words.end(), more.begin(), more.end());
    const Finished run = spawn_gnomon(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return report::read_rows(folder);
  };
  const std::vector<report::Row> rest = compare("rest", {}), plays = compare("plays", {"--animation", "all"});
  ASSERT_EQ(rest.size(), 12u);
  ASSERT_EQ(plays.size(), rest.size());
  bool saved = false;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_EQ(rest[i].animation, "");
    EXPECT_EQ(plays[i].animation, "all");
    // Four seconds in three parts, each frame in the middle of one.
    EXPECT_DOUBLE_EQ(plays[i].animation_time_s, 4.0 * (plays[i].frame + 0.5) / 3.0);
    EXPECT_NE(plays[i].key(), rest[i].key());
    EXPECT_EQ(plays[i].plan_status, "ok");
    // Rays against another pose would disagree over the whole shadow of the figures.
    constexpr double kOtherShadows = 0.005;
    EXPECT_LT(plays[i].errors.false_lit + plays[i].errors.false_shadow,
              rest[i].errors.false_lit + rest[i].errors.false_shadow + kOtherShadows)
        << plays[i].technique.name();
    EXPECT_NE(plays[i].errors.mean_error, rest[i].errors.mean_error) << "another pose, another error";
    EXPECT_LT(plays[i].flips, 0.03) << plays[i].technique.name();
    for (const report::LeftOut& l : plays[i].left_out) saved = saved || l.rule == "held_maps";
  }
  EXPECT_TRUE(saved);
  // What it is resumed with finds its rows again.
  const std::vector<report::Row> again = compare("plays", {"--animation", "all", "--resume"});
  EXPECT_EQ(again.size(), plays.size());
  const Finished unknown = spawn_gnomon(
      {"compare", scene.file, "--animation", "run", "--out", (scene.folder.path() / "none").string()});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("it has all"), std::string::npos) << unknown.err;
  EXPECT_FALSE(std::filesystem::exists(scene.folder.path() / "none"));
  const Finished none = spawn_gnomon({"compare", "builtin:fence", scene.file, "--animation", "all"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("builtin:fence: "), std::string::npos) << none.err;
}

}  // namespace
}  // namespace gnomon::tool::view
