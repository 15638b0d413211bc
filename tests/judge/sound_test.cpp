// Is nothing found where nothing is wrong? Captures of real engines in other units, places, axes and
// conventions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "captures.hpp"

namespace gnomon::judge::test {
namespace {

const std::vector<std::string> kNames{"three_csm", "three_sunlight", "three_spot", "babylon_stabilized",
                                      "ogre_pssm"};

/// Replaces the world of a capture by `moved` of it: an even scale, and a turn that keeps boxes along the
/// axes.
void move_world(Json& c, const glm::dmat4& moved, double scale) {
  const glm::dmat4 back = glm::inverse(moved);
  const auto point = [&](const Json& p) {
    return glm::dvec3(moved * glm::dvec4(p[0].get<double>(), p[1].get<double>(), p[2].get<double>(), 1.0));
  };
  const auto of_frame = [&](Json& frame) {
    // View space keeps its unit: a scale of the view's axes would be another camera.
    glm::dmat4 view = matrix(frame["camera"]["view_from_world"]) * back;
    frame["camera"]["view_from_world"] = numbers(glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * view);
    glm::dmat4 clip = matrix(frame["camera"]["clip_from_view"]);
    clip[3][2] *= scale;
    frame["camera"]["clip_from_view"] = numbers(clip);
    for (Json& light : frame["lights"]) {
      if (light.contains("direction")) {
        const glm::dvec3 d{light["direction"][0].get<double>(), light["direction"][1].get<double>(),
                           light["direction"][2].get<double>()};
        const glm::dvec3 turned = glm::dmat3(moved) * d;
        light["direction"] = {turned.x, turned.y, turned.z};
      }
      if (!light.contains("position")) continue;
      const glm::dvec3 p = point(light["position"]);
      light["position"] = {p.x, p.y, p.z};
      light["range"] = light["range"].get<double>() * scale;
    }
    for (Json& map : frame["maps"]) {
      map["clip_from_world"] = numbers(matrix(map["clip_from_world"]) * back);
      if (map.contains("depths")) {
        for (Json& depth : map["depths"]) depth = depth.get<double>() * scale;
      }
    }
  };
  if (c.contains("maps")) of_frame(c);
  if (c.contains("frames"))
    for (Json& frame : c["frames"]) of_frame(frame);
  for (const char* list : {"receivers", "casters"}) {
    for (Json& box : c[list]) {
      const glm::dvec3 a = point(box["min"]), b = point(box["max"]);
      const glm::dvec3 low = glm::min(a, b), high = glm::max(a, b);
      box = {{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}};
    }
  }
}

TEST(SoundCaptures, have_no_findings_as_they_are) {
  for (const std::string& name : kNames) EXPECT_THAT(kinds(judged(sound(name))), testing::IsEmpty()) << name;
}

TEST(SoundCaptures, have_none_in_other_units) {
  for (const std::string& name : kNames) {
    for (const double scale : {0.01, 100.0}) {
      Json c = sound(name);
      move_world(c, glm::scale(glm::dmat4(1.0), glm::dvec3(scale)), scale);
      EXPECT_THAT(kinds(judged(c)), testing::IsEmpty()) << name << " " << scale;
    }
  }
}

TEST(SoundCaptures, have_none_in_another_place) {
  for (const std::string& name : kNames) {
    Json c = sound(name);
    move_world(c, glm::translate(glm::dmat4(1.0), {300.0, -40.0, 170.0}), 1.0);
    EXPECT_THAT(kinds(judged(c)), testing::IsEmpty()) << name;
  }
}

TEST(SoundCaptures, have_none_where_z_is_up) {
  glm::dmat4 turned(0.0);
  turned[0] = {1, 0, 0, 0};
  turned[1] = {0, 0, 1, 0};
  turned[2] = {0, -1, 0, 0};
  turned[3] = {0, 0, 0, 1};
  for (const std::string& name : kNames) {
    Json c = sound(name);
    move_world(c, turned, 1.0);
    EXPECT_THAT(kinds(judged(c)), testing::IsEmpty()) << name;
  }
}

TEST(SoundCaptures, have_none_in_other_conventions_that_are_stated) {
  for (const std::string& name : kNames) {
    Json c = sound(name);
    const Json camera_space = c.value("clip_space", Json::object());
    const bool left = camera_space.value("handedness", "right") == "left";
    // Vulkan's, with reversed depth, written row by row.
    glm::dmat4 to(1.0);
    to[1][1] = -1.0;
    to[2][2] = -0.5;
    to[3][2] = 0.5;
    for_each_map(c, [&](Json& map, std::size_t) {
      map["clip_from_world"] = numbers(glm::transpose(to * matrix(map["clip_from_world"])));
    });
    const auto transpose_camera = [](Json& frame) {
      for (const char* key : {"view_from_world", "clip_from_view"})
        frame["camera"][key] = numbers(glm::transpose(matrix(frame["camera"][key])));
    };
    if (c.contains("maps")) transpose_camera(c);
    if (c.contains("frames"))
      for (Json& frame : c["frames"]) transpose_camera(frame);
    c["matrices"] = "row_major";
    c["clip_space"] = {{"ndc_depth", "zero_to_one"},
                       {"reversed_z", true},
                       {"y_down", true},
                       {"handedness", left ? "left" : "right"}};
    c["camera_clip_space"] = camera_space;
    EXPECT_THAT(kinds(judged(c)), testing::IsEmpty()) << name;
  }
}

Json box_of(const Box& b) {
  return {{"min", {b.min.x, b.min.y, b.min.z}}, {"max", {b.max.x, b.max.y, b.max.z}}};
}

TEST(SoundCaptures, may_have_lights_below_a_ceiling) {
  // A floor, a lamp above it, and a ceiling above the lamp, which shadows nothing.
  PlanOptions options;
  const std::vector<Box> floor{{{-20, -0.1, -20}, {20, 0, 20}}};
  const std::vector<Box> casters{{{-1, 0, -1}, {1, 1, 1}}, {{-20, 3, -20}, {20, 3.5, 20}}};
  const Camera camera = perspective_camera({0, 2, 8}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 60, 600, 400);
  const SpotLight spot{{0, 2.9, 0}, {0, -1, 0}, 0.9, 10.0};
  const ShadowPlan plan = make_plan(camera, spot, {casters, floor}, options);
  ASSERT_EQ(plan.map_count, 1);
  Json c{{"format", "gnomon-capture/1"},
         {"camera", camera_of(camera)},
         {"lights",
          {{{"type", "spot"},
            {"position", {0, 2.9, 0}},
            {"direction", {0, -1, 0}},
            {"outer_deg", 51.56},
            {"range", 10}}}},
         {"bias", {{"texels", 0.5}, {"follows_plane", true}}},
         {"maps",
          {{{"clip_from_world", numbers(plan.map[0].clip_from_world)}, {"width", 1024}, {"height", 1024}}}},
         {"receivers", {box_of(floor[0])}},
         {"casters", {box_of(casters[0]), box_of(casters[1])}}};
  EXPECT_THAT(kinds(judged(c)), testing::IsEmpty());
}

TEST(SoundCaptures, slopes_of_a_bias_count_against_steps_of_depth) {
  Json c = sound("ogre_pssm");
  for_each_map(c, [](Json& map, std::size_t) { map["bias"] = {{"slope_factor", 1.5}}; });
  EXPECT_THAT(kinds(judged(c)), testing::Not(testing::Contains("depth_precision")));
}

TEST(SoundCaptures, a_sun_with_depths_and_a_spot_without_choose_each_by_its_own) {
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

TEST(SoundCaptures, a_few_points_do_not_say_that_a_map_is_unseen) {
  Json c = sound("ogre_pssm");
  Json points = Json::array();
  for (int i = 0; i < 600; ++i) points.push_back({-20.0 + i % 40, 0.0, 20.0 + i / 40 % 15, 0.0, 1.0, 0.0});
  c["points"] = points;
  EXPECT_THAT(kinds(judged(c)), testing::Not(testing::Contains("map_unseen")));
}

TEST(SoundCaptures, may_have_a_stable_map_round_a_slender_view) {
  // A telescope over the ground: of a square that the slice fits in from every direction, a strip is seen.
  PlanOptions options;
  options.fit = Fit::stable;
  const std::vector<Box> ground{{{-200, -0.1, -200}, {200, 0, 200}}};
  const Camera camera =
      perspective_camera({0, 2, 0}, {0, -0.05, -1}, {0, 1, 0}, 0.025, 1.5, 1.0, 60.0, 600, 400);
  const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.3, -1.0, 0.1}}, {ground, ground}, options);
  ASSERT_EQ(plan.map_count, 1);
  Json c = plan_capture(plan, camera, {0.3, -1.0, 0.1});
  c["bias"] = {{"texels", 0.5}, {"follows_plane", true}};
  c["receivers"] = Json::array({box_of(ground[0])});
  EXPECT_THAT(kinds(judged(c)), testing::IsEmpty());
}

TEST(SoundCaptures, need_no_map_where_no_caster_reaches) {
  // A tower far off: no cascade before its shadow is planned.
  const std::vector<Box> tower{{{6, 0, -70}, {14, 20, -60}}},
      all{{{-60, -1, -200}, {60, 0, 20}}, tower.front()};
  const Camera camera = perspective_camera({0, 5, 0}, {0, 0, -1}, {0, 1, 0}, 1.05, 1.5, 0.5, 250.0, 960, 640);
  const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.3, -1.0, 0.2}}, {tower, all}, {});
  ASSERT_GT(plan.map_count, 0);
  ASSERT_GT(plan.map[0].depth_begin, 20.0);
  Json c = plan_capture(plan, camera, {0.3, -1.0, 0.2});
  c["bias"] = {{"texels", 0.5}, {"follows_plane", true}};
  c["casters"] = Json::array({box_of(tower[0])});
  c["receivers"] = Json::array({box_of(all[0]), box_of(all[1])});
  const Judgement judgement = judged(c);
  EXPECT_THAT(kinds(judgement), testing::IsEmpty());
  ASSERT_EQ(judgement.lights.size(), 1u);
  // gnomon's plans beside it hold all that is measured, with no more texels.
  for (const auto& beside : {judgement.lights[0].tight, judgement.lights[0].stable}) {
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->error.outside, 0u);
    EXPECT_LE(beside->texels, judgement.lights[0].texels);
  }
  // Depths that the tower's shadow falls on need one.
  for (Json& map : c["maps"]) map["depths"][0] = 0.999 * map["depths"][1].get<double>();
  EXPECT_THAT(kinds(judged(c)), testing::Contains("gap_between_maps"));
}

TEST(SoundCaptures, have_plans_beside_them_with_less_error) {
  for (const std::string& name : kNames) {
    if (name == "three_spot") continue;  // a spot near by: both have texels to spare
    const Judgement judgement = judged(shipped(name));
    ASSERT_EQ(judgement.lights.size(), 1u);
    const LightFigures& light = judgement.lights[0];
    ASSERT_TRUE(light.tight);
    EXPECT_LE(light.tight->texels, light.texels);
    EXPECT_LT(light.tight->error.mean, light.error.mean) << name;
  }
}

}  // namespace
}  // namespace gnomon::judge::test
