// Do findings hold in other spaces and lights than those that captures are shipped in, and say what mends
// them?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "captures.hpp"

namespace gnomon::judge::test {
namespace {

/// Of the first finding of the kind; empty: there is none.
std::string sentence(const Judgement& judgement, FindingKind kind) {
  for (const Finding& finding : judgement.findings)
    if (finding.kind == kind) return finding.what + " " + finding.change;
  return {};
}

Json& only_light(Json& c) {
  return c["lights"][0];
}

Json first_frame(Json c) {
  if (!c.contains("frames")) return c;
  const Json frame = c["frames"][0];
  c.erase("frames");
  c.update(frame);
  return c;
}

TEST(FreshFaults, a_sun_that_lights_nothing_in_view_is_held_to_its_maps) {
  // The ground does not face a sun from below. OGRE's maps are warped, those of three.js are parallel.
  const Json ground = {{0.0, 0.0, 20.0, 0.0, 1.0, 0.0}, {5.0, 0.0, 0.0, 0.0, 1.0, 0.0}};
  for (const char* name : {"ogre_pssm", "three_csm"}) {
    Json c = first_frame(sound(name));
    c["points"] = ground;
    for (Json& x : only_light(c)["direction"]) x = -x.get<double>();
    EXPECT_THAT(sentence(judged(c), FindingKind::light_direction), testing::HasSubstr("the other way"))
        << name;
  }
}

TEST(FreshFaults, a_spot_that_shines_the_other_way_is_named_though_it_lights_nothing) {
  Json c = sound("three_spot");
  for (Json& x : only_light(c)["direction"]) x = -x.get<double>();
  EXPECT_THAT(sentence(judged(c), FindingKind::light_direction), testing::HasSubstr("180 degrees"));
}

TEST(FreshFaults, texture_coordinates_of_a_spot_are_named) {
  Json c = sound("three_spot");
  glm::dmat4 texture = scaled(0.5, -0.5, 1.0);
  texture[3][0] = texture[3][1] = 0.5;
  transform_maps(c, texture);
  EXPECT_THAT(kinds(judged(c)), testing::Contains("texture_space"));
}

TEST(FreshFaults, a_spots_map_twice_as_wide_as_its_cone_wastes_texels) {
  Json c = sound("three_spot");
  transform_maps(c, scaled(0.5, 0.5, 1.0));
  EXPECT_THAT(sentence(judged(c), FindingKind::texels_unseen), testing::HasSubstr("75 %"));
}

TEST(FreshFaults, neighbouring_cascades_that_are_exchanged_are_named_though_both_hold_the_points) {
  Json c = sound("three_csm");
  for (Json& frame : c["frames"])
    std::swap(frame["maps"][0]["clip_from_world"], frame["maps"][1]["clip_from_world"]);
  EXPECT_THAT(sentence(judged(c), FindingKind::selection_disagrees),
              testing::AllOf(testing::HasSubstr("map 0 is chosen"), testing::HasSubstr("map 1")));
}

TEST(FreshFaults, maps_listed_coarse_first_are_named) {
  Json c = sound("babylon_stabilized");
  for (Json& frame : c["frames"]) {
    std::reverse(frame["maps"].begin(), frame["maps"].end());
    for (Json& map : frame["maps"]) map.erase("depths");
  }
  EXPECT_THAT(sentence(judged(c), FindingKind::selection_disagrees), testing::HasSubstr("finest"));
}

TEST(FreshFaults, a_far_plane_that_cuts_is_named_where_another_map_holds_the_points) {
  Json c = sound("three_sunlight");
  glm::dmat4 nearer(1.0);
  nearer[2][2] = 1.1;  // the receivers of map 0 lie at 0.64 to 0.76 of -1..1
  nearer[3][2] = 0.3;
  transform_maps(c, nearer, 0);
  const Judgement judgement = judged(c);
  EXPECT_THAT(sentence(judgement, FindingKind::receivers_cut), testing::HasSubstr("behind its far plane"));
  EXPECT_THAT(kinds(judgement), testing::Not(testing::Contains("selection_disagrees")));
}

TEST(FreshFaults, a_gap_narrower_than_the_points_is_named_by_its_depths) {
  Json c = sound("three_csm");
  for (Json& frame : c["frames"])
    frame["maps"][0]["depths"][1] = frame["maps"][0]["depths"][1].get<double>() - 0.25;
  EXPECT_THAT(sentence(judged(c), FindingKind::gap_between_maps), testing::HasSubstr("32.3 to 32.6"));
}

TEST(FreshFaults, a_camera_of_the_other_range_of_depths_is_named) {
  for (const char* name : {"three_csm", "babylon_stabilized"}) {
    Json c = sound(name);
    c["clip_space"]["ndc_depth"] = "zero_to_one";
    EXPECT_THAT(sentence(judged(c), FindingKind::depth_convention), testing::HasSubstr("near plane")) << name;
  }
}

TEST(FreshFaults, a_plane_that_cuts_is_no_other_range_of_depths_where_the_camera_fits) {
  Json c = sound("bevy_cascades");
  glm::dmat4 nearer(1.0);
  nearer[2][2] = 1.6;
  nearer[3][2] = -0.6;
  transform_maps(c, nearer);
  const auto found = kinds(judged(c));
  EXPECT_THAT(found, testing::Contains("receivers_cut"));
  EXPECT_THAT(found, testing::Not(testing::Contains("depth_convention")));
}

TEST(FreshFaults, few_texels_are_a_step_of_density_and_no_wrong_order) {
  Json c = sound("three_csm");
  for_each_map(c, [](Json& map, std::size_t i) {
    if (i == 0) map["width"] = map["height"] = 64;
  });
  const Judgement judgement = judged(c);
  EXPECT_THAT(sentence(judgement, FindingKind::density_step), testing::HasSubstr("as many texels"));
  EXPECT_THAT(kinds(judgement), testing::Not(testing::Contains("selection_disagrees")));
}

TEST(FreshFaults, a_map_that_serves_few_points_is_held_still_as_others_are) {
  Json c = sound("three_csm");
  double sum = 0.0;
  for (Json& frame : c["frames"]) {
    Json& map = frame["maps"][3];
    glm::dmat4 shift(1.0);
    shift[3][0] = sum * 2.0 / map["width"].get<double>();
    map["clip_from_world"] = numbers(shift * matrix(map["clip_from_world"]));
    sum += 0.2;
  }
  EXPECT_THAT(sentence(judged(c), FindingKind::swimming), testing::HasSubstr("map 3"));
}

TEST(FreshSound, slopes_of_a_bias_count_against_steps_of_depth) {
  Json c = sound("ogre_pssm");
  for_each_map(c, [](Json& map, std::size_t) { map["bias"] = {{"slope_factor", 1.5}}; });
  EXPECT_THAT(kinds(judged(c)), testing::Not(testing::Contains("depth_precision")));
}

TEST(FreshSound, a_sun_with_depths_and_a_spot_without_choose_each_by_its_own) {
  Json c = sound("three_csm"), spot = sound("three_spot");
  for (Json& frame : c["frames"]) {
    frame["lights"].push_back(spot["lights"][0]);
    Json map = spot["maps"][0];
    map["light"] = 1;
    frame["maps"].push_back(map);
  }
  EXPECT_THAT(kinds(judged(c)), testing::IsEmpty());
  const Capture capture = read_capture(c.dump());
  EXPECT_THAT(capture.frames[0].selection,
              testing::ElementsAre(MapSelection::view_depth, MapSelection::first_holding));
}

TEST(FreshSound, a_few_points_do_not_say_that_a_map_is_unseen) {
  Json c = sound("ogre_pssm");
  Json points = Json::array();
  for (int i = 0; i < 600; ++i) points.push_back({-20.0 + i % 40, 0.0, 20.0 + i / 40 % 15, 0.0, 1.0, 0.0});
  c["points"] = points;
  EXPECT_THAT(kinds(judged(c)), testing::Not(testing::Contains("map_unseen")));
}

TEST(Findings, have_a_place_and_a_bias_in_units_of_engines) {
  const Judgement judgement = judged(shipped("babylon_cascades"));
  ASSERT_EQ(judgement.findings.size(), 2u);
  for (const Finding& finding : judgement.findings) EXPECT_TRUE(finding.pixel) << finding.what;
  EXPECT_THAT(judgement.findings[0].change, testing::HasSubstr("a normal offset of"));
  Json c = shipped("babylon_cascades");
  for_each_map(c, [](Json& map, std::size_t) { map.erase("bias"); });
  EXPECT_THAT(sentence(judged(c), FindingKind::bias_small),
              testing::HasSubstr("the capture gives it no bias"));
}

TEST(Captures, name_the_line_of_what_is_wrong) {
  const auto refusal = [](const std::string& text) -> std::string {
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
  EXPECT_EQ(refusal(text), "line " + std::to_string(line) + ", maps[1].width: must lie in 1..65536");
  // Also of what all frames share.
  Json shared = c;
  shared["frames"] = {{{"camera", shared["camera"]}}};
  shared.erase("camera");
  EXPECT_THAT(refusal(shared.dump(1)), testing::EndsWith(", frames[0].maps[1].width: must lie in 1..65536"));
  EXPECT_THAT(refusal(shared.dump(1)), testing::StartsWith("line 1"));
  EXPECT_EQ(refusal(c.dump()), "maps[1].width: must lie in 1..65536");
  EXPECT_EQ(refusal("{\n\"name\": \"a\\\"[{\",\n\"format\": \"x\"}"),
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

/// The boxes in view as a picture of depths, in their place.
Json with_depth_picture(const Json& c) {
  const Capture capture = read_capture(c.dump());
  const CapturedFrame& frame = capture.frames[0];
  const SeenSurfaces seen = seen_surfaces(frame, capture.scenes[0]);
  std::vector<double> depths(static_cast<std::size_t>(kRayColumns) * kRayRows, 0.0);
  for (std::size_t p = 0; p < seen.points.size(); ++p) {
    const auto column = static_cast<std::size_t>(seen.pixels[p].x / frame.camera.width * kRayColumns);
    const auto row = static_cast<std::size_t>(seen.pixels[p].y / frame.camera.height * kRayRows);
    depths[row * kRayColumns + column] = seen.depths[p];
  }
  Json out = c;
  out.erase("receivers");
  out["depth_picture"] = {{"width", kRayColumns}, {"height", kRayRows}, {"depths", depths}};
  return out;
}

TEST(DepthPictures, show_the_surfaces_that_boxes_have) {
  const Json boxes = sound("ogre_pssm");
  const Json c = with_depth_picture(boxes);
  EXPECT_THAT(kinds(judged(c)), testing::IsEmpty());
  const CapturedScene scene = read_capture(c.dump()).scenes[0];
  const Capture of_boxes = read_capture(boxes.dump());
  const SeenSurfaces seen = seen_surfaces(of_boxes.frames[0], of_boxes.scenes[0]);
  EXPECT_GT(scene.points.size(), seen.points.size() * 95 / 100);
  // Of axis-aligned boxes.
  const auto straight = std::count_if(scene.normals.begin(), scene.normals.end(), [](const glm::dvec3& n) {
    return std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) > 0.999;
  });
  EXPECT_GT(straight, static_cast<std::ptrdiff_t>(scene.normals.size() * 9 / 10));
}

TEST(DepthPictures, that_are_half_written_or_of_several_cameras_are_refused) {
  const auto refusal = [](const Json& c) -> std::string {
    try {
      (void)read_capture(c.dump());
    } catch (const CaseError& error) {
      return error.what();
    }
    return "taken";
  };
  Json c = with_depth_picture(sound("ogre_pssm"));
  EXPECT_EQ(refusal(c), "taken");
  Json half = c;
  half["depth_picture"]["depths"].erase(0);
  EXPECT_EQ(refusal(half), "depth_picture.depths: needs 5184 numbers, has 5183");
  Json large = c;
  large["depth_picture"]["width"] = 60000;
  EXPECT_EQ(refusal(large), "depth_picture.depths: must be at most 100000 pixels");
  Json both = c;
  both["points"] = {{0, 0, 0}};
  EXPECT_EQ(refusal(both), "depth_picture: stands beside points: one of both");
  Json shared = sound("three_csm");
  shared["depth_picture"] = c["depth_picture"];
  EXPECT_EQ(refusal(shared), "depth_picture: stands beside frames: each has its own");
  shared.erase("depth_picture");
  shared["frames"][0]["depth_picture"] = c["depth_picture"];
  EXPECT_EQ(refusal(shared), "taken");
}

}  // namespace
}  // namespace gnomon::judge::test
