// Does a finding's sentence tell a planted fault from those that look like it?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace gnomon::judge::test
