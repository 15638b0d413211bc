// The viewer's state: its file reads back, a broken one is refused, and it is a command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "process.hpp"
#include "view_pictures.hpp"

namespace gnomon::tool::view {
namespace {

/// A state in which nothing has its default.
State unusual() {
  State state = hangar();
  state.eye = CameraKey{{1.5, 2.25, 3.0}, {-4.0, 1.0 / 3.0, 0.1}, {0.25, -1.0, 0.5}};
  state.panes = true;
  state.edits = {true, {{{0, 1, 0}, 2.5}, {{-1, 0, 0.25}, 1}}, "simple.glb", UpAxis::z, true};
  state.frozen = CameraKey{{1.0, 2.0, 3.0}, {0.0, 0.0, 0.0}};
  state.path = {{{0.0, 1.0, 2.0}, {3.0, 4.0, 5.0}}, {{1.0, 1.0, 2.5}, {3.0, 4.0, 5.0}}};
  state.fov_y_deg = 41.5;
  state.height_world = 12.25;
  state.frozen_sight = {0.5, 88.0};
  state.near_depth = 0.25;
  state.far_depth = 77.0;
  state.light.sun = {LightKind::spot, 12.5, -33.0};
  state.light.spot = SpotLight{{1, 9, 2}, {0.1, -1, 0.2}, 0.7, 55.5};
  state.light.point = PointLight{{3, 2, 1}, 44.0};
  state.light.all = true;
  state.a.plan.cascades = 3;
  state.a.plan.split.scheme = SplitScheme::given;
  state.a.plan.split.given[0] = 3.5;
  state.a.plan.split.given[1] = 14.25;
  state.a.plan.warp.focus = Box{{-1, 0, -2}, {1, 3, 2}};
  state.a.plan.warp.planes[0] = {{1, 0, 2}, {0.5, 1, 0}, 0.125};
  state.a.plan.bias.slope_texels = 1.25;
  state.a.plan.clip_space.reversed_z = true;
  state.a.plan.cadence.largest_turn = 0.125;
  state.a.plan.prune = kPruneNothing;
  state.b.filter = render::parse_filter("evsm4:radius=3,format=fp16").settings;
  state.b.transition = render::SplitTransition::dither;
  state.b.layer = render::DepthLayer::midpoint;
  state.b.identifiers = render::IdentifierTest{render::IdentifierOf::triangle, 2};
  state.b.linear_depth = true;
  state.b.map_passes = render::MapPasses::layered;
  state.b.pages = {&page_policies::tiled, 256, 77, 2.5};
  state.b.history = state.b.visible_depths = true;
  state.view = View::checker;
  state.map = 2;
  state.comparison = Comparison::difference;
  state.b_is_truth = true;
  state.wipe = 0.25;
  state.gain = 7.0;
  state.drawn = {false, false, true, true, true};
  state.motion = {true, true, 12.0, -5.0, 0.5};
  state.playing = {"walk", 1.5, true, -0.5};
  return state;
}

TEST(ViewState, reads_back_what_it_wrote) {
  for (const State& state : {State{}, hangar(), unusual()}) {
    const std::string text = state_text(state);
    EXPECT_EQ(state_text(read_state(text)), text);
  }
  const State back = read_state(state_text(unusual()));
  EXPECT_EQ(back.a.plan.split.given[1], 14.25);
  EXPECT_EQ(back.a.plan.warp.focus.max.y, 3.0);
  EXPECT_EQ(back.a.plan.warp.planes, unusual().a.plan.warp.planes);
  EXPECT_TRUE(back.a.plan.clip_space.reversed_z);
  EXPECT_TRUE(back.panes);
  EXPECT_EQ(back.edits, unusual().edits);
  EXPECT_NEAR(back.a.plan.cadence.largest_turn, 0.125, 1e-15);
  EXPECT_EQ(back.b.filter.format, render::TexelFormat::fp16);
  EXPECT_EQ(back.b.layer, render::DepthLayer::midpoint);
  ASSERT_TRUE(back.b.identifiers);
  EXPECT_EQ(back.b.identifiers->of, render::IdentifierOf::triangle);
  EXPECT_EQ(back.b.identifiers->neighbours, 2);
  EXPECT_TRUE(back.b.linear_depth);
  EXPECT_EQ(back.b.map_passes, render::MapPasses::layered);
  EXPECT_FALSE(back.a.identifiers);
  EXPECT_EQ(back.b.pages, unusual().b.pages);
  EXPECT_EQ(back.height_world, 12.25);
  EXPECT_EQ(back.light.spot->range, 55.5);
  EXPECT_TRUE(back.light.all);
  EXPECT_EQ(back.eye->up, glm::dvec3(0.25, -1.0, 0.5));
  ASSERT_EQ(back.path.size(), 2u);
  EXPECT_EQ(back.path[1].position, glm::dvec3(1.0, 1.0, 2.5));
  EXPECT_FALSE(read_state(state_text(State{})).eye);
}

TEST(ViewState, that_is_broken_is_refused_with_the_key) {
  const auto refusal = [](const std::string& text) {
    try {
      (void)read_state(text);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  const std::string good = state_text(unusual());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  EXPECT_EQ(refusal(good), "was read");
  EXPECT_TRUE(refusal("").starts_with("no JSON"));
  EXPECT_TRUE(refusal(good.substr(0, good.size() / 2)).starts_with("no JSON"));
  EXPECT_EQ(refusal("[]"), "needs an object");
  EXPECT_EQ(refusal("{}"), "gnomon_view: is missing: this is no state of the viewer");
  EXPECT_EQ(refusal(std::string(10'000, '[')), "brackets are nested too deep");
  EXPECT_EQ(refusal(with("\"wipe\": 0.25", "\"wipe\": 2")), "wipe: 2 is not in 0..1");
  EXPECT_EQ(refusal("{\"gnomon_view\": 1, \"section\": [[0, 1, 0]]}"),
            "section: needs planes of four numbers");
  EXPECT_EQ(refusal("{\"gnomon_view\": 1, \"section\": 5}"), "section: needs a list of at most 8 planes");
  EXPECT_EQ(refusal("{\"gnomon_view\": 1, \"path\": 5}"), "path: needs a list of at most 1024 keys");
  EXPECT_EQ(refusal("{\"gnomon_view\": 1, \"path\": [{\"position\": [1, 2, 3], \"target\": [1, 2, 3]}]}"),
            "path[0]: position and target must differ");
  EXPECT_EQ(refusal(with("\"wipe\"", "\"wip\"")), "wip: unknown key; did you mean 'wipe'?");
  EXPECT_TRUE(
      refusal(with("\"cascades\": 3", "\"cascades\": \"x\"")).starts_with("a.options.cascades: needs"));
  for (const char* of_cases : {"pages", "lights"}) {
    const std::string named = "\"" + std::string(of_cases) + "\": {}, \"cascades\": 3";
    EXPECT_TRUE(refusal(with("\"cascades\": 3", named))
                    .starts_with("a.options." + std::string(of_cases) + ": unknown key"));
  }
  EXPECT_TRUE(refusal(with("evsm4:", "evsn4:")).starts_with("b.filter: "));
  EXPECT_TRUE(refusal(with("\"tiled\"", "\"tild\"")).starts_with("b.pages.policy: is \"tild\""));
  EXPECT_EQ(refusal(with("\"page_texels\": 256", "\"page_texels\": 96")),
            "b.pages.page_texels: 96 is not 64, 128 or 256");
  EXPECT_EQ(refusal(with("\"capacity\": 77", "\"capacity\": 0")), "b.pages.capacity: 0 is not in 1..65536");
  EXPECT_TRUE(refusal(with("\"triangle\"", "\"triangles\"")).starts_with("b.identifiers: is \"triangles\""));
  EXPECT_EQ(refusal(with("\"identifier_neighbours\": 2", "\"identifier_neighbours\": 1.5")),
            "b.identifier_neighbours: 1.5 is not a whole number");
  EXPECT_EQ(refusal(with("\"capacity\": 77", "\"capacity\": 77.5")),
            "b.pages.capacity: 77.5 is not a whole number");
  EXPECT_TRUE(refusal(with("\"layered\"", "\"layers\"")).starts_with("b.map_passes: is \"layers\""));
  EXPECT_TRUE(refusal(with("\"checker\"", "\"chequer\"")).find("did you mean 'checker'") !=
              std::string::npos);
  EXPECT_TRUE(refusal(with("\"position\": [\n", "\"position\": [\"a\",\n")).find("needs three numbers") !=
              std::string::npos);
  EXPECT_THROW((void)load_state("/no/such/file.json"), std::runtime_error);
}

TEST(ViewCommand, takes_a_blend_for_the_split_that_blends) {
  const test::TemporaryFolder folder;
  const auto picture_by = [&](const std::vector<std::string>& words) {
    const std::string file = folder.path() / "cascades.png";
    std::vector<std::string> command{"view",   "builtin:fence", "--view", "cascades", "--map-size", "64",
                                     "--size", "64x36",         "--out",  file,       "--context",  "osmesa"};
    command.insert(command.end(), words.begin(), words.end());
    const test::Finished finished = test::spawn_gnomon(command);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return test::content_of(file);
  };
  const std::string uniform = picture_by({"--lambda", "0"});
  EXPECT_EQ(uniform, picture_by({"--split", "practical", "--lambda", "0"}));
  EXPECT_NE(uniform, picture_by({"--lambda", "1"}));
  const test::Finished refused = test::spawn_gnomon(
      {"view", "builtin:hangar", "--out", "x.png", "--lambda", "0.5", "--split", "uniform"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--lambda: --split uniform takes none"), std::string::npos) << refused.err;
}

TEST(ViewState, is_a_command_that_names_what_is_not_the_default) {
  State state = hangar();
  EXPECT_EQ(command_text(state), "gnomon view builtin:hangar --map-size 256 --filter pcf");
  state.a.pages.page_texels = 64;
  EXPECT_EQ(command_text(state), "gnomon view builtin:hangar --map-size 256 --filter pcf");
  state.a.pages = {&page_policies::clipmap, 64, 1024, 0.5};
  EXPECT_EQ(command_text(state),
            "gnomon view builtin:hangar --map-size 256 --pages clipmap --page-size 64 --page-target 0.5 "
            "--filter pcf");
  state.a.plan.bias.slope_texels = 2.0;
  state.a.plan.cadence.largest_turn = 0.5;
  state.view = View::heat;
  state.a.layer = render::DepthLayer::back;
  state.eye = CameraKey{{1, 2, 3}, {0, 0, -1}};
  const std::string command = command_text(state);
  EXPECT_NE(command.find("--options '{\"bias\":{"), std::string::npos) << command;
  EXPECT_NE(command.find("cadence_turn_deg"), std::string::npos) << command;
  EXPECT_NE(command.find(" --layer back"), std::string::npos) << command;
  EXPECT_NE(command.find("--eye=1,2,3 --target=0,0,-1 --view heat"), std::string::npos) << command;
  state = hangar();
  state.a.plan.split.lambda = 0.5;
  EXPECT_EQ(command_text(state),
            "gnomon view builtin:hangar --map-size 256 --split auto --lambda 0.5 --filter pcf");
  state.a.plan.split.scheme = SplitScheme::uniform;
  EXPECT_EQ(command_text(state), "gnomon view builtin:hangar --map-size 256 --split uniform --filter pcf")
      << "a blend of none is refused";
  state = hangar();
  state.edits = {true, {{{-1, 0, 0}, 2.5}, {{0, 1, 0}, 3}}, "low.glb", UpAxis::z, true};
  state.height_world = 30.0;
  EXPECT_EQ(command_text(state),
            "gnomon view builtin:hangar --up z --open-sky --ground --section=-1,0,0,2.5/0,1,0,3 --proxies "
            "low.glb --map-size 256 "
            "--filter pcf --orthographic 30");
  state = hangar();
  state.a.linear_depth = true;
  state.a.map_passes = render::MapPasses::each;
  state.a.identifiers = render::IdentifierTest{};
  EXPECT_EQ(
      command_text(state),
      "gnomon view builtin:hangar --map-size 256 --filter identifiers --linear-depth --map-passes each");
  state.a.identifiers = render::IdentifierTest{render::IdentifierOf::triangle, 3};
  EXPECT_NE(command_text(state).find(" --filter identifiers:of=triangle,neighbours=3 "), std::string::npos);
}

}  // namespace
}  // namespace gnomon::tool::view
