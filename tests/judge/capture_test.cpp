// Is every broken capture refused by the key that is wrong?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "captures.hpp"

namespace gnomon::judge::test {
namespace {

std::string refusal_after(void (*change)(Json& c)) {
  Json c = shipped("ogre_pssm");
  change(c);
  return refusal(c.dump());
}

TEST(Captures, are_read_frame_by_frame) {
  const Capture capture = read_capture(shipped("three_csm").dump());
  EXPECT_EQ(capture.engine, "three.js 0.187");
  ASSERT_EQ(capture.frames.size(), 8u);
  EXPECT_EQ(capture.scenes.size(), 1u);
  EXPECT_EQ(capture.scenes[0].receivers.size(), 41u);
  const CapturedFrame& frame = capture.frames[3];
  EXPECT_EQ(frame.maps.size(), 4u);
  EXPECT_EQ(frame.selection.front(), MapSelection::view_depth);
  EXPECT_EQ(frame.maps[2].path, "frames[3].maps[2]");
  EXPECT_TRUE(frame.maps[0].stores_back);
  EXPECT_NEAR(frame.camera.near_depth, 0.5, 1e-6);
}

TEST(Captures, of_maps_without_depths_choose_by_what_maps_hold) {
  EXPECT_EQ(read_capture(shipped("three_spot").dump()).frames[0].selection.front(),
            MapSelection::first_holding);
}

TEST(Captures, that_are_broken_are_refused_by_key) {
  EXPECT_THAT(refusal("{"), testing::Not("taken"));
  EXPECT_EQ(refusal("{}"), "format: is missing");
  EXPECT_EQ(refusal_after([](Json& c) { c["format"] = "gnomon-capture/7"; }),
            "format: is \"gnomon-capture/7\", not gnomon-capture/1");
  EXPECT_THAT(refusal_after([](Json& c) { c["cameras"] = 1; }), testing::StartsWith("cameras: unknown key"));
  EXPECT_EQ(refusal_after([](Json& c) { c.erase("lights"); }), "lights: is missing");
  EXPECT_EQ(refusal_after([](Json& c) { c["maps"] = Json::array(); }), "maps: needs a list of maps");
  EXPECT_EQ(refusal_after([](Json& c) { c["maps"][1].erase("width"); }), "maps[1].width: is missing");
  EXPECT_EQ(refusal_after([](Json& c) { c["maps"][1]["width"] = 0; }), "maps[1].width: must lie in 1..65536");
  EXPECT_EQ(refusal_after([](Json& c) { c["maps"][1]["light"] = 4; }), "maps[1].light: there is no light 4");
  EXPECT_EQ(refusal_after([](Json& c) {
              c["maps"][0]["clip_from_world"] = Json::array({1, 2});
            }),
            "maps[0].clip_from_world: needs 16 numbers");
  EXPECT_EQ(refusal_after([](Json& c) { c["maps"][0]["clip_from_world"][5] = nullptr; }),
            "maps[0].clip_from_world[5]: needs a number, is null");
  EXPECT_EQ(refusal_after([](Json& c) { c["maps"][0]["clip_from_world"][5] = 1e31; }),
            "maps[0].clip_from_world: has an entry beyond 1e30");
  EXPECT_EQ(refusal_after([](Json& c) { c["maps"][0]["clip_from_world"] = std::vector<double>(16, 0.0); }),
            "maps[0].clip_from_world: is singular");
  EXPECT_EQ(refusal_after([](Json& c) {
              c["maps"][0]["depths"] = {5, 1};
            }),
            "maps[0].depths: needs two view depths, the nearer first");
  EXPECT_EQ(refusal_after([](Json& c) {
              c["maps"][0]["atlas"] = {0.5, 0, 1, 1};
            }),
            "maps[0].atlas: needs x, y, width, height: whole numbers of texels");
  EXPECT_EQ(refusal_after([](Json& c) { c["maps"][0]["depth_bits"] = 12; }),
            "maps[0].depth_bits: must be 16, 24 or 32, or 0 for single precision");
  EXPECT_EQ(refusal_after([](Json& c) { c["selection"] = "nearest"; }),
            "selection: is \"nearest\", not one of view_depth, first_holding, finest");
  EXPECT_EQ(refusal_after([](Json& c) {
              c["lights"][0]["direction"] = {0, 0, 0};
            }),
            "lights[0].direction: must not be zero");
  EXPECT_EQ(refusal_after([](Json& c) {
              c["points"] = {{1, 2}};
            }),
            "points[0]: needs three numbers, or six with the normal");
  EXPECT_EQ(refusal_after([](Json& c) {
              c["points"] = {{1, 2, 3, 0, 0, 0}};
            }),
            "points[0]: has a normal without length");
  EXPECT_EQ(refusal("[]"), "capture: needs an object, is array");
  EXPECT_EQ(refusal_after([](Json& c) {
              c["casters"] = {{{"min", {1, 0, 0}}, {"max", {0, 1, 1}}}};
            }),
            "casters[0]: has min above max");
  EXPECT_EQ(refusal_after([](Json& c) { c["frames"] = Json::array(); }),
            "frames: needs a list of 1 to 4096 frames");
  EXPECT_EQ(refusal_after([](Json& c) { c["frames"] = {1}; }), "frames[0]: needs an object");
  EXPECT_THAT(refusal_after([](Json& c) {
                c["clip_space"]["handedness"] = "left";
                c["camera_clip_space"] = c["clip_space"];
              }),
              testing::StartsWith("camera: "));
  for (int i = 0; i < 8; ++i) {
    Json c = shipped("ogre_pssm");
    for (int k = 0; k <= i; ++k) c["maps"].push_back(c["maps"][0]);
    EXPECT_EQ(refusal(c.dump()) == "taken", i < 4) << i;
  }
}

TEST(Captures, name_the_line_of_what_is_wrong) {
  const auto refusal_of_file = [](const std::string& text) -> std::string {
    const std::string name = testing::TempDir() + "/line.json";
    std::ofstream(name) << text;
    try {
      (void)load_capture(name);
    } catch (const CaseError& error) {
      const std::string message = error.what();
      return message.substr(message.find(".json: ") + 7);
    }
    return "taken";
  };
  Json c = shipped("ogre_pssm");
  c["maps"][1]["width"] = 0;
  const std::string text = c.dump(1), before = text.substr(0, text.find("\"width\": 0"));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  EXPECT_EQ(refusal_of_file(text), "line " + std::to_string(line) + ", maps[1].width: must lie in 1..65536");
  // Also of what all frames share.
  Json shared = c;
  shared["frames"] = {{{"camera", shared["camera"]}}};
  shared.erase("camera");
  EXPECT_THAT(refusal_of_file(shared.dump(1)),
              testing::EndsWith(", frames[0].maps[1].width: must lie in 1..65536"));
  EXPECT_THAT(refusal_of_file(shared.dump(1)), testing::StartsWith("line 1"));
  EXPECT_EQ(refusal_of_file(c.dump()), "maps[1].width: must lie in 1..65536");
  EXPECT_EQ(refusal_of_file("{\n\"name\": \"a\\\"[{\",\n\"format\": \"x\"}"),
            "line 3, format: is \"x\", not gnomon-capture/1");
}

TEST(Captures, with_depths_of_some_maps_of_a_light_are_refused) {
  Json c = shipped("ogre_pssm");
  c["maps"][2].erase("depths");
  EXPECT_THROW((void)read_capture(c.dump()), CaseError);
  c["selection"] = "finest";
  EXPECT_NO_THROW((void)read_capture(c.dump()));
  c["maps"][2]["bias"] = {{"depth", 3.0}};
  EXPECT_THROW((void)read_capture(c.dump()), CaseError);
}

TEST(Captures, with_nothing_in_view_have_their_matrices_checked_alone) {
  Json c = shipped("ogre_pssm");
  c["receivers"] = Json::array();
  c["casters"] = Json::array();
  const Judgement judgement = judged(c);
  EXPECT_THAT(kinds(judgement), testing::IsEmpty());
  ASSERT_FALSE(judgement.notes.empty());
  EXPECT_THAT(judgement.notes[0], testing::HasSubstr("only the matrices"));
}

TEST(Captures, with_degenerate_matrices_and_points_end) {
  Json c = shipped("ogre_pssm");
  c["points"] = {{0, 0, 0, 0, 1, 0}, {1e29, 0, 0, 0, 1, 0}, {0, 0, -30, 0, 1, 0}};
  for (Json& map : c["maps"]) map["clip_from_world"] = numbers(glm::dmat4(1e-20));
  const Judgement judgement = judged(c);
  for (const Finding& finding : judgement.findings) EXPECT_FALSE(finding.what.empty());
}

}  // namespace
}  // namespace gnomon::judge::test
