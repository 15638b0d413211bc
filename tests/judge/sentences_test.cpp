// Does a finding's sentence tell a planted fault from those that look like it?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

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

TEST(PlantedFaults, a_sun_that_lights_nothing_in_view_is_held_to_its_maps) {
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

TEST(PlantedFaults, a_spot_that_shines_the_other_way_is_named_though_it_lights_nothing) {
  Json c = sound("three_spot");
  for (Json& x : only_light(c)["direction"]) x = -x.get<double>();
  EXPECT_THAT(sentence(judged(c), FindingKind::light_direction), testing::HasSubstr("180 degrees"));
}

TEST(PlantedFaults, a_mirrored_map_of_a_spot_that_lights_nothing_is_named) {
  Json c = sound("three_spot");
  only_light(c)["range"] = 0.01;
  transform_maps(c, scaled(-1.0, 1.0, 1.0));
  EXPECT_THAT(kinds(judged(c)), testing::ElementsAre("mirrored"));
}

TEST(PlantedFaults, texture_coordinates_of_a_spot_are_named) {
  Json c = sound("three_spot");
  glm::dmat4 texture = scaled(0.5, -0.5, 1.0);
  texture[3][0] = texture[3][1] = 0.5;
  transform_maps(c, texture);
  EXPECT_THAT(kinds(judged(c)), testing::Contains("texture_space"));
}

TEST(PlantedFaults, maps_that_are_seen_in_one_corner_are_no_texture_coordinates) {
  Json c = sound("three_sunlight");
  glm::dmat4 corner = scaled(0.3, 0.3, 1.0);
  corner[3][0] = corner[3][1] = 0.32;
  transform_maps(c, corner);
  EXPECT_THAT(kinds(judged(c)), testing::Not(testing::Contains("texture_space")));
}

TEST(PlantedFaults, a_spots_map_twice_as_wide_as_its_cone_wastes_texels) {
  Json c = sound("three_spot");
  transform_maps(c, scaled(0.5, 0.5, 1.0));
  EXPECT_THAT(sentence(judged(c), FindingKind::texels_unseen), testing::HasSubstr("75 %"));
}

TEST(PlantedFaults, neighbouring_cascades_that_are_exchanged_are_named_though_both_hold_the_points) {
  Json c = sound("three_csm");
  for (Json& frame : c["frames"])
    std::swap(frame["maps"][0]["clip_from_world"], frame["maps"][1]["clip_from_world"]);
  EXPECT_THAT(sentence(judged(c), FindingKind::selection_disagrees),
              testing::AllOf(testing::HasSubstr("map 0 is chosen"), testing::HasSubstr("map 1")));
}

TEST(PlantedFaults, maps_listed_coarse_first_are_named) {
  Json c = sound("babylon_stabilized");
  for (Json& frame : c["frames"]) {
    std::reverse(frame["maps"].begin(), frame["maps"].end());
    for (Json& map : frame["maps"]) map.erase("depths");
  }
  EXPECT_THAT(sentence(judged(c), FindingKind::selection_disagrees), testing::HasSubstr("finest"));
}

TEST(PlantedFaults, a_far_plane_that_cuts_is_named_where_another_map_holds_the_points) {
  Json c = sound("three_sunlight");
  glm::dmat4 nearer(1.0);
  nearer[2][2] = 1.1;  // the receivers of map 0 lie at 0.64 to 0.76 of -1..1
  nearer[3][2] = 0.3;
  transform_maps(c, nearer, 0);
  const Judgement judgement = judged(c);
  EXPECT_THAT(sentence(judgement, FindingKind::receivers_cut), testing::HasSubstr("behind its far plane"));
  EXPECT_THAT(kinds(judgement), testing::Not(testing::Contains("selection_disagrees")));
}

TEST(PlantedFaults, a_gap_narrower_than_the_points_is_named_by_its_depths) {
  Json c = sound("three_csm");
  for (Json& frame : c["frames"])
    frame["maps"][0]["depths"][1] = frame["maps"][0]["depths"][1].get<double>() - 0.25;
  EXPECT_THAT(sentence(judged(c), FindingKind::gap_between_maps), testing::HasSubstr("32.3 to 32.6"));
}

TEST(PlantedFaults, depths_without_a_map_are_no_gap_where_no_surface_reaches_through_them) {
  Json c = first_frame(sound("three_csm"));
  const Capture whole = read_capture(c.dump());
  const SeenSurfaces seen = seen_surfaces(whole.frames[0], whole.scenes[0]);
  // Between 26 and 37 there is nothing. Walls stand before the ground behind it, and the ground goes on
  // there.
  Json points = Json::array();
  for (std::size_t p = 0; p < seen.points.size(); ++p) {
    const glm::dvec3 &at = seen.points[p], &normal = seen.normals[p];
    if (seen.depths[p] < 26.0 || seen.depths[p] > 37.0)
      points.push_back({at.x, at.y, at.z, normal.x, normal.y, normal.z});
  }
  c["points"] = points;
  c["maps"][0]["depths"][1] = 30.0;
  EXPECT_EQ(sentence(judged(c), FindingKind::gap_between_maps), "");
}

TEST(PlantedFaults, a_camera_of_the_other_range_of_depths_is_named) {
  for (const char* name : {"three_csm", "babylon_stabilized"}) {
    Json c = sound(name);
    c["clip_space"]["ndc_depth"] = "zero_to_one";
    EXPECT_THAT(sentence(judged(c), FindingKind::depth_convention), testing::HasSubstr("near plane")) << name;
  }
}

TEST(PlantedFaults, a_camera_read_by_minus_one_to_one_is_named_as_well) {
  // All matrices are of 0..1, and the file says nothing of it.
  Json c = sound("three_csm");
  const glm::dmat4 halved = scaled(1.0, 1.0, 0.5, 0.5);
  transform_maps(c, halved);
  for (Json& frame : c["frames"])
    frame["camera"]["clip_from_view"] = numbers(halved * matrix(frame["camera"]["clip_from_view"]));
  EXPECT_THAT(sentence(judged(c), FindingKind::depth_convention),
              testing::HasSubstr("as minus_one_to_one, and at 0.5 as zero_to_one"));
}

TEST(PlantedFaults, a_camera_speaks_for_no_range_where_the_first_map_begins_elsewhere) {
  Json c = sound("three_csm");
  c["clip_space"]["ndc_depth"] = "zero_to_one";
  for (Json& frame : c["frames"]) frame["maps"][0]["depths"][0] = 1.0;
  EXPECT_THAT(sentence(judged(c), FindingKind::depth_convention), testing::HasSubstr("fit -1..1"));
}

TEST(PlantedFaults, both_planes_that_cut_are_named) {
  Json c = sound("three_sunlight");
  transform_maps(c, scaled(1.0, 1.0, 20.0, -14.0), 0);
  EXPECT_THAT(sentence(judged(c), FindingKind::receivers_cut),
              testing::AllOf(testing::HasSubstr("outside of its near and far planes"),
                             testing::HasSubstr("Move the near plane")));
}

TEST(PlantedFaults, a_plane_that_cuts_a_little_is_no_other_range_where_the_camera_says_nothing) {
  Json c = sound("three_spot");
  c["clip_space"]["ndc_depth"] = "zero_to_one";
  c["camera_clip_space"] = Json::object();
  transform_maps(c, scaled(1.0, 1.0, 28.0, -27.0) * scaled(1.0, 1.0, 0.5, 0.5));
  const auto found = kinds(judged(c));
  EXPECT_THAT(found, testing::Contains("receivers_cut"));
  EXPECT_THAT(found, testing::Not(testing::Contains("depth_convention")));
}

TEST(PlantedFaults, a_spots_map_that_is_narrower_than_its_cone_is_named_with_how_far_the_cone_reaches) {
  Json c = sound("three_spot");
  transform_maps(c, scaled(2.0, 2.0, 1.0));
  EXPECT_THAT(sentence(judged(c), FindingKind::receivers_outside),
              testing::ContainsRegex("the farthest is [12][.0-9]* times as far from the middle of map 0"));
}

TEST(PlantedFaults, a_plane_that_cuts_is_no_other_range_of_depths_where_the_camera_fits) {
  Json c = sound("bevy_cascades");
  glm::dmat4 nearer(1.0);
  nearer[2][2] = 1.6;
  nearer[3][2] = -0.6;
  transform_maps(c, nearer);
  const auto found = kinds(judged(c));
  EXPECT_THAT(found, testing::Contains("receivers_cut"));
  EXPECT_THAT(found, testing::Not(testing::Contains("depth_convention")));
}

TEST(PlantedFaults, few_texels_are_a_step_of_density_and_no_wrong_order) {
  Json c = sound("three_csm");
  for_each_map(c, [](Json& map, std::size_t i) {
    if (i == 0) map["width"] = map["height"] = 64;
  });
  const Judgement judgement = judged(c);
  EXPECT_THAT(sentence(judgement, FindingKind::density_step), testing::HasSubstr("as many texels"));
  EXPECT_THAT(kinds(judgement), testing::Not(testing::Contains("selection_disagrees")));
}

TEST(PlantedFaults, a_map_that_serves_few_points_is_held_still_as_others_are) {
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

TEST(Findings, of_a_large_bias_say_how_many_times_too_large_it_is) {
  Json c = sound("babylon_stabilized");
  for_each_map(c, [](Json& map, std::size_t) { map["bias"] = {{"world", 3.0}}; });
  double times = 0.0;
  const std::string text = sentence(judged(c), FindingKind::bias_large);
  ASSERT_NE(text.find("Lower the bias"), std::string::npos) << text;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("Lower the bias"), "Lower the bias: it is %lf", &times), 1);
  EXPECT_GT(times, 4.0);
}

TEST(Findings, have_a_place_and_a_bias_in_units_of_engines) {
  const Judgement judgement = judged(shipped("babylon_cascades"));
  ASSERT_EQ(judgement.findings.size(), 2u);
  for (const Finding& finding : judgement.findings) EXPECT_TRUE(finding.pixel) << finding.what;
  double world = 0.0, normal_texels = 0.0, along_texels = 0.0;
  ASSERT_EQ(std::sscanf(judgement.findings[0].change.c_str(),
                        "Add a normal offset of %lf world units (%lf texels), or %lf texels along", &world,
                        &normal_texels, &along_texels),
            3)
      << judgement.findings[0].change;
  // On a slope the way along the light is the longer one.
  EXPECT_GT(world, 0.0);
  EXPECT_LT(normal_texels, 0.95 * along_texels);
  Json c = shipped("babylon_cascades");
  for_each_map(c, [](Json& map, std::size_t) { map.erase("bias"); });
  EXPECT_THAT(sentence(judged(c), FindingKind::bias_small),
              testing::HasSubstr("the capture gives it no bias"));
}

}  // namespace
}  // namespace gnomon::judge::test
