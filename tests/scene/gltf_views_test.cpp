// Are lights and cameras of a file where its nodes put them?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gltf_text.hpp"

namespace gnomon::test {
namespace {

/// A node that holds the light or camera of this number: 3 along x, turned by a right angle about y, so that
/// it looks along -x.
json node(const char* what, int index) {
  const double r = std::sqrt(0.5);
  json out = {
      {"name", "holder"}, {"translation", {3, 0, 0}}, {"rotation", {0, r, 0, r}}, {"scale", {2, 2, 2}}};
  if (what == std::string("light")) {
    out["extensions"]["KHR_lights_punctual"]["light"] = index;
  } else {
    out["camera"] = index;
  }
  return out;
}

TestGltf lit() {
  TestGltf gltf = one_triangle();
  gltf.document["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf.document["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"name", "sun"}},
      {{"type", "spot"}, {"range", 20}, {"spot", {{"innerConeAngle", 0.3}, {"outerConeAngle", 0.5}}}},
      {{"type", "point"}}};
  for (int i = 0; i < 3; ++i) gltf.show_node(node("light", i));
  return gltf;
}

TEST(GltfLights, stand_where_their_nodes_are_and_shine_along_their_minus_z) {
  const Scene scene = lit().load();
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].name, "sun");
  EXPECT_EQ(scene.lights[1].name, "holder") << "a light without a name has its node's";
  const auto& sun = std::get<DirectionalLight>(scene.lights[0].light);
  EXPECT_NEAR(glm::length(sun.direction - glm::dvec3(-1, 0, 0)), 0.0, 1e-12);
  const auto& spot = std::get<SpotLight>(scene.lights[1].light);
  EXPECT_EQ(spot.position, glm::dvec3(3, 0, 0));
  EXPECT_NEAR(glm::length(spot.direction - glm::dvec3(-1, 0, 0)), 0.0, 1e-12);
  EXPECT_EQ(spot.outer_radians, 0.5);
  EXPECT_EQ(spot.range, 20.0);
  // Without a range it lights all of the scene.
  const auto& point = std::get<PointLight>(scene.lights[2].light);
  EXPECT_GT(point.range, glm::length(glm::dvec3(3, 1, 0)));
}

TEST(GltfLights, that_are_broken_or_hidden_are_not_there) {
  TestGltf gltf = lit();
  json& lights = gltf.document["extensions"]["KHR_lights_punctual"]["lights"];
  lights[0]["type"] = "area";
  lights[1]["spot"]["outerConeAngle"] = -1;
  lights[2]["range"] = "far";
  Scene scene = gltf.load();
  EXPECT_TRUE(scene.lights.empty());
  ASSERT_EQ(scene.warnings.size(), 3u);
  EXPECT_NE(scene.warnings[0].find("KHR_lights_punctual.lights[0]"), std::string::npos) << scene.warnings[0];
  gltf = lit();
  gltf.document["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
  gltf.document["nodes"][2]["extensions"]["KHR_lights_punctual"]["light"] = 99;
  EXPECT_EQ(gltf.load().lights.size(), 1u);
  gltf.document["extensions"]["KHR_lights_punctual"] = 7;
  EXPECT_TRUE(gltf.load().lights.empty());
}

TEST(GltfLights, have_the_colour_and_intensity_of_the_file) {
  TestGltf gltf = lit();
  json& lights = gltf.document["extensions"]["KHR_lights_punctual"]["lights"];
  lights[1]["color"] = {0.25, 0, 1};
  lights[1]["intensity"] = 120;
  lights[2]["intensity"] = 0;
  const Scene scene = gltf.load();
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1.0f));
  EXPECT_EQ(scene.lights[0].intensity, 1.0);
  EXPECT_EQ(scene.lights[1].color, glm::vec3(0.25f, 0.0f, 1.0f));
  EXPECT_EQ(scene.lights[1].intensity, 120.0);
  EXPECT_EQ(scene.lights[2].intensity, 0.0);
}

/// The lines that a file is warned of in.
std::vector<std::string> warnings_of(const TestGltf& gltf) {
  return gltf.load().warnings;
}

TEST(GltfLights, that_nodes_name_wrongly_are_warned_of_by_their_place) {
  using Lines = std::vector<std::string>;
  TestGltf gltf = lit();
  json& named = gltf.document["nodes"][1]["extensions"]["KHR_lights_punctual"];
  const std::string where = "nodes[1].KHR_lights_punctual";
  named["light"] = 99;
  EXPECT_EQ(warnings_of(gltf), Lines{where + ".light: names lights[99], there are 3, skipped"});
  for (const json& number : {json("sun"), json(-1), json(0.5), json()}) {
    named["light"] = number;
    EXPECT_EQ(warnings_of(gltf), Lines{where + ".light: is no number of one of the lights, skipped"});
  }
  named = 7;
  EXPECT_EQ(warnings_of(gltf), Lines{where + ": is no object, and does not count"});
  gltf = lit();
  gltf.document["extensions"]["KHR_lights_punctual"] = 7;
  EXPECT_EQ(warnings_of(gltf)[0], "KHR_lights_punctual: is no object, and does not count");
  gltf.document["extensions"]["KHR_lights_punctual"] = {{"lights", 7}};
  EXPECT_EQ(warnings_of(gltf)[0], "KHR_lights_punctual.lights: is no list, skipped");
}

TEST(GltfLights, whose_colour_or_intensity_is_broken_are_missing_with_a_line) {
  const std::vector<std::tuple<const char*, json, std::string>> cases{
      {"intensity", -1, "intensity is out of range"},     {"intensity", 1e31, "intensity is out of range"},
      {"intensity", json(), "intensity is no number"},    {"color", {1, 1}, "color is not three numbers"},
      {"color", "red", "color is not three numbers"},     {"color", {1, json(), 1}, "color[1] is no number"},
      {"color", {1, 1, -0.5}, "color[2] is out of range"}};
  for (const auto& [key, value, line] : cases) {
    TestGltf gltf = lit();
    gltf.document["extensions"]["KHR_lights_punctual"]["lights"][1][key] = value;
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.lights.size(), 2u) << line;
    EXPECT_EQ(scene.warnings,
              std::vector<std::string>{"KHR_lights_punctual.lights[1]: " + line + ", skipped"});
  }
}

TEST(GltfCameras, that_nodes_name_wrongly_are_warned_of_by_their_place) {
  TestGltf gltf = one_triangle();
  gltf.show_node(node("camera", 0));
  EXPECT_EQ(warnings_of(gltf).at(0), "nodes[1].camera: names cameras[0], there are 0, skipped");
  gltf.document["cameras"] = "none";
  EXPECT_EQ(warnings_of(gltf).at(0), "cameras: is no list, skipped");
}

TEST(GltfCameras, look_where_their_nodes_do) {
  TestGltf gltf = one_triangle();
  gltf.document["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"zfar", 50}}}},
      {{"type", "perspective"}, {"name", "endless"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 6}, {"ymag", 4}, {"znear", 0}, {"zfar", 9}}}}};
  for (int i = 0; i < 3; ++i) gltf.show_node(node("camera", i));
  const Scene scene = gltf.load();
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.cameras.size(), 3u);
  for (const SceneCamera& camera : scene.cameras) {
    EXPECT_EQ(camera.position, glm::dvec3(3, 0, 0));
    EXPECT_NEAR(glm::length(camera.forward - glm::dvec3(-1, 0, 0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(camera.up - glm::dvec3(0, 1, 0)), 0.0, 1e-12);
  }
  EXPECT_EQ(scene.cameras[0].far_depth, 50.0);
  EXPECT_TRUE(std::isinf(scene.cameras[1].far_depth));
  EXPECT_EQ(scene.cameras[1].name, "endless");
  EXPECT_TRUE(scene.cameras[2].orthographic);
  EXPECT_EQ(scene.cameras[2].height_world, 8.0);
  EXPECT_EQ(scene.cameras[2].aspect, 1.5);
  EXPECT_EQ(scene.cameras[0].aspect, 0.0);
}

TEST(GltfCameras, whose_aspect_is_broken_are_missing_with_a_line) {
  const std::vector<std::tuple<const char*, json, std::string>> cases{
      {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"aspectRatio", 0}}, "aspectRatio is out of range"},
      {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"aspectRatio", -2}}, "aspectRatio is out of range"},
      {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"aspectRatio", "4:3"}}, "aspectRatio is no number"},
      {"orthographic", {{"xmag", 0}, {"ymag", 4}, {"znear", 0}, {"zfar", 9}}, "xmag is zero"},
      {"orthographic", {{"xmag", json()}, {"ymag", 4}, {"znear", 0}, {"zfar", 9}}, "xmag is no number"}};
  for (const auto& [kind, lens, line] : cases) {
    TestGltf gltf = one_triangle();
    gltf.document["cameras"] = {{{kind, lens}}};
    gltf.show_node(node("camera", 0));
    EXPECT_EQ(warnings_of(gltf), std::vector<std::string>{"cameras[0]: " + line + ", skipped"});
  }
  TestGltf gltf = one_triangle();
  gltf.document["cameras"] = {{{"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"aspectRatio", 1.5}}}}};
  gltf.show_node(node("camera", 0));
  EXPECT_EQ(gltf.load().cameras.at(0).aspect, 1.5);
}

TEST(GltfCameras, that_are_broken_are_warned_of_and_missing) {
  TestGltf gltf = one_triangle();
  gltf.document["cameras"] = {{{"type", "perspective"}},
                              {{"perspective", {{"yfov", 0.7}}}},
                              {{"perspective", {{"yfov", 7}, {"znear", 0.1}}}},
                              {{"perspective", {{"yfov", 0.7}, {"znear", 5}, {"zfar", 1}}}},
                              {{"orthographic", {{"znear", 0.1}}}},
                              "none"};
  for (int i = 0; i < 6; ++i) gltf.show_node(node("camera", i));
  const Scene scene = gltf.load();
  EXPECT_TRUE(scene.cameras.empty());
  EXPECT_EQ(scene.warnings.size(), 6u);
}

}  // namespace
}  // namespace gnomon::test
