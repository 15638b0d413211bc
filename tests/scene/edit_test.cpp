// Scenes turned upright, without the shadow of a sky, with a ground under them, and cut by planes.
#include "gnomon/scene/edit.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <variant>

#include "default_view_scenes.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/pose.hpp"

namespace gnomon::test {
namespace {

Scene scene_of(const std::string& name) {
  for (const ViewScene& one : default_view_scenes())
    if (one.name == name) return one.gltf.load();
  ADD_FAILURE() << "no scene " << name;
  return {};
}

// Up.

// A lit and filmed arm: a box on a joint that an animation turns, and a sheet that a skin bends with it.
TestGltf arm(bool z_up) {
  TestGltf gltf;
  const PartMesh box = PartMesh().box({-1, 0, -2}, {1, 3, 2});
  const int corners = gltf.positions(box.positions);
  const int indices = gltf.accessor(gltf.view(box.indices), kUnsignedInt, "SCALAR", box.indices.size());
  gltf.show({{"attributes", {{"POSITION", corners}}}, {"indices", indices}}, {{"translation", {5, 1, 2}}});
  const int joint = gltf.show_node({{"translation", {2, 0, 7}}});
  const int bones = gltf.accessor(gltf.view(std::vector<std::uint8_t>(4 * 3, 0)), kUnsignedByte, "VEC4", 3);
  const int weights =
      gltf.accessor(gltf.view(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), kFloat, "VEC4", 3);
  gltf.document["skins"] = {{{"joints", {joint}}}};
  gltf.show({{"attributes",
              {{"POSITION", gltf.positions(kTriangle)}, {"JOINTS_0", bones}, {"WEIGHTS_0", weights}}}},
            {{"skin", 0}});
  const int times = gltf.accessor(gltf.view(std::vector<float>{0, 1}), kFloat, "SCALAR", 2);
  const int turns = gltf.accessor(gltf.view(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0}), kFloat, "VEC4", 2);
  for (const int node : {0, joint})
    gltf.document["animations"].push_back(
        {{"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "rotation"}}}}}},
         {"samplers", {{{"input", times}, {"output", turns}}}}});
  gltf.document["cameras"] = {{{"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  gltf.document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
  gltf.show_node({{"camera", 0},
                  {"translation", {1, 2, 3}},
                  {"rotation", {0.36, 0.48, 0, 0.8}},
                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  if (!z_up) return gltf;
  // By hand: all of it hangs on a node that is turned.
  const double half = std::sqrt(0.5);
  json& roots = gltf.document["scenes"][0]["nodes"];
  const json children = std::exchange(roots, json::array());
  gltf.show_node({{"children", children}, {"rotation", {-half, 0, 0, half}}});
  return gltf;
}

TestGltf at_rest(TestGltf gltf) {
  gltf.document.erase("animations");
  return gltf;
}

// Where each triangle is, at rest or posed.
std::vector<glm::dvec3> corners_of(Scene scene, int animation) {
  if (animation >= 0) {
    Pose at;
    EXPECT_TRUE(pose(scene, animation, 0.75, at));
    apply_pose(at, scene);
  }
  std::vector<glm::dvec3> corners;
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[instance.primitive];
    for (std::uint32_t k = 0; k < primitive.index_count; ++k) {
      const std::uint32_t v = scene.indices[primitive.first_index + k];
      corners.emplace_back(instance.world_from_object * glm::dvec4(glm::dvec3(scene.positions[v]), 1.0));
      corners.emplace_back(glm::dmat3(instance.world_from_object) * glm::dvec3(scene.normals[v]));
    }
    corners.push_back(instance.bounds_world.min);
    corners.push_back(instance.bounds_world.max);
  }
  return corners;
}

TEST(Up, of_z_is_what_a_node_does_that_turns_all_of_the_file) {
  constexpr double kSingle = 1e-5;  // of skinned vertices, in single precision
  const Scene by_hand = arm(true).load();
  Scene turned = arm(false).load();
  turn_up(UpAxis::y, turned);
  EXPECT_EQ(turned.bounds_world, arm(false).load().bounds_world);
  edit({.sections = {}, .up = UpAxis::z}, turned);
  for (const int animation : {-1, 0, 1}) {
    const std::vector<glm::dvec3> expected = corners_of(by_hand, animation),
                                  got = corners_of(turned, animation);
    ASSERT_EQ(expected.size(), got.size());
    for (std::size_t i = 0; i < got.size(); ++i)
      EXPECT_LT(glm::length(got[i] - expected[i]), kSingle) << i << " of animation " << animation;
  }
  Scene rests = at_rest(arm(false)).load();
  turn_up(UpAxis::z, rests);
  const std::vector<glm::dvec3> expected = corners_of(by_hand, -1), got = corners_of(rests, -1);
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_LT(glm::length(got[i] - expected[i]), kSingle) << i;
  EXPECT_LT(glm::length(turned.bounds_world.min - by_hand.bounds_world.min), kSingle);
  EXPECT_LT(glm::length(turned.bounds_world.max - by_hand.bounds_world.max), kSingle);
  for (const auto part : {&SceneCamera::position, &SceneCamera::forward, &SceneCamera::up})
    EXPECT_LT(glm::length(turned.cameras.at(0).*part - by_hand.cameras.at(0).*part), kSingle);
  const auto& spot = std::get<SpotLight>(turned.lights.at(0).light);
  const auto& other = std::get<SpotLight>(by_hand.lights.at(0).light);
  EXPECT_LT(glm::length(spot.position - other.position), kSingle);
  EXPECT_LT(glm::length(spot.direction - other.direction), kSingle);
}

// Sky.

TEST(Sky, that_casts_is_found_and_opened_and_nothing_else_is) {
  for (const auto& [name, skies] : {std::pair{"town_under_dome", 1},
                                    {"town_under_low_dome", 1},
                                    {"town_in_ball_that_faces_out", 1},
                                    {"town", 0},
                                    {"room", 0},
                                    {"town_on_plate", 0},
                                    {"town_with_mountains_and_clouds", 0},
                                    {"backdrop_of_a_photographer", 0}}) {
    SCOPED_TRACE(name);
    Scene scene = scene_of(name);
    EXPECT_EQ(has_sky_that_casts(scene), skies > 0);
    const Scene before = scene;
    edit({.sections = {}, .open_sky = true}, scene);
    EXPECT_FALSE(has_sky_that_casts(scene));
    int opened = 0;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      if (scene.instances[i].casts == before.instances[i].casts) continue;
      ++opened;
      EXPECT_GT(scene.instances[i].bounds_world.max.y, 100.0) << "the dome";
    }
    EXPECT_EQ(opened, skies);
  }
}

TEST(Sky, that_shares_its_mesh_with_what_it_surrounds_casts_as_before) {
  ViewScene town("town");
  PartMesh mesh;
  for (double x = -36.0; x <= 36.0; x += 12.0)
    for (double z = -36.0; z <= 36.0; z += 12.0) mesh.box({x - 4, 0, z - 4}, {x + 4, 10, z + 4});
  town.content(mesh.box({-400, -400, -400}, {400, 400, 400}, true));
  Scene scene = town.gltf.load();
  EXPECT_FALSE(has_sky_that_casts(scene));
  open_sky(scene);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(scene.instances[0].casts);
}

// Ground.

TEST(Ground, is_not_added_to_a_scene_without_triangles) {
  Scene scene;
  add_ground(scene);
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_FALSE(has_ground(scene));
}

TEST(Ground, is_missed_where_nothing_lies_under_a_scene_and_then_no_more) {
  for (const auto& [name, grounded] : {std::pair{"prop", false},
                                       {"town", false},
                                       {"car", false},
                                       {"millimetres", true},
                                       {"town_on_plate", true},
                                       {"town_on_tiles", true},
                                       {"village_on_land", true},
                                       {"terrain", true},
                                       {"room", true}}) {
    Scene scene = scene_of(name);
    EXPECT_EQ(has_ground(scene), grounded) << name;
    add_ground(scene);
    EXPECT_TRUE(has_ground(scene)) << name;
  }
}

TEST(Ground, lies_right_below_the_scene_and_neither_casts_nor_moves_the_view_or_the_light) {
  for (const char* name : {"prop", "town", "town_on_earth"}) {
    SCOPED_TRACE(name);
    const Scene before = scene_of(name);
    Scene scene = before;
    edit({.ground = true, .sections = {}}, scene);
    ASSERT_EQ(scene.instances.size(), before.instances.size() + 1);
    const Instance& ground = scene.instances.back();
    EXPECT_FALSE(ground.casts);
    EXPECT_TRUE(ground.receives);
    EXPECT_EQ(scene.bounds_world, before.bounds_world);
    const double below = before.bounds_world.min.y - ground.bounds_world.max.y;
    EXPECT_GT(below, 0.0);
    EXPECT_LT(below, 1e-3 * (before.bounds_world.max.x - before.bounds_world.min.x));
    const CameraPath with = default_path(scene), without = default_path(before);
    ASSERT_EQ(with.keys.size(), without.keys.size());
    for (std::size_t i = 0; i < with.keys.size(); ++i)
      EXPECT_LT(glm::length(with.keys[i].position - without.keys[i].position), 1e-6);
  }
}

// Sections.

using Triangle = std::array<glm::dvec3, 3>;
std::vector<Triangle> triangles_of(const Scene& scene) {
  std::vector<Triangle> triangles;
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[instance.primitive];
    for (std::uint32_t k = 0; k < primitive.index_count; ++k) {
      if (k % 3 == 0) triangles.emplace_back();
      const glm::dvec3 at(scene.positions[scene.indices[primitive.first_index + k]]);
      triangles.back()[k % 3] = glm::dvec3(instance.world_from_object * glm::dvec4(at, 1.0));
    }
  }
  return triangles;
}
double area_of(const Triangle& t) {
  return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}
double area_of(const Scene& scene) {
  double area = 0.0;
  for (const Triangle& triangle : triangles_of(scene)) area += area_of(triangle);
  return area;
}

/// Area of what of a triangle lies where dot(normal, p) <= distance, by hand: the whole less the cut corner.
double area_kept(Triangle t, const SectionPlane& plane) {
  const auto value = [&](const glm::dvec3& p) { return glm::dot(plane.normal, p) - plane.distance; };
  for (int turn = 0; turn < 3; ++turn) {
    const double a = value(t[0]), b = value(t[1]), c = value(t[2]);
    if (a <= 0.0 && b <= 0.0 && c <= 0.0) return area_of(t);
    if (a > 0.0 && b > 0.0 && c > 0.0) return 0.0;
    if (a > 0.0 && b <= 0.0 && c <= 0.0) return area_of(t) * (1.0 - a / (a - b) * (a / (a - c)));
    if (a <= 0.0 && b > 0.0 && c > 0.0) return area_of(t) * (a / (a - b)) * (a / (a - c));
    t = {t[1], t[2], t[0]};
  }
  return 0.0;
}

TEST(Section, a_plane_that_is_none_or_misses_changes_nothing) {
  const Scene before = scene_of("town");
  Scene scene = before;
  const double inf = std::numeric_limits<double>::infinity();
  cut_by(
      std::vector<SectionPlane>{
          {{0, 0, 0}, 1}, {{0, inf, 0}, 1}, {{0, 1, 0}, std::nan("")}, {{0, 1, 0}, 1e9}},
      scene);
  EXPECT_EQ(scene.indices, before.indices);
  EXPECT_EQ(scene.instances.size(), before.instances.size());
  cut_by(std::vector<SectionPlane>{{{0, 1, 0}, -1e9}}, scene);
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(scene.bounds_world.empty());
}

TEST(Section, of_one_triangle_is_what_one_cuts_by_hand) {
  Scene scene = one_triangle().load();
  cut_by(std::vector<SectionPlane>{{{2, 0, 0}, 0.5}}, scene);  // x <= 1/4
  const std::vector<Triangle> left = triangles_of(scene);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_NEAR(area_of(scene), 0.5 - 0.5 * 0.75 * 0.75, 1e-7);
  EXPECT_EQ(scene.bounds_world.max.x, 0.25);
  EXPECT_EQ(scene.bounds_world.max.y, 1.0);
  for (const glm::vec3& normal : scene.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.positions.size(), scene.normals.size());
  EXPECT_EQ(scene.positions.size(), scene.texcoords.size());
}

TEST(Section, keeps_exactly_the_area_on_its_side_and_both_sides_make_the_whole) {
  for (const char* name : {"town", "car", "tunnel", "town_on_earth"})
    for (const glm::dvec3& normal :
         {glm::dvec3(0, 1, 0), glm::dvec3(1, 0.3, -0.7), glm::dvec3(-0.2, -1, 0.1)}) {
      SCOPED_TRACE(name);
      const Scene whole = scene_of(name);
      const glm::dvec3 size = whole.bounds_world.max - whole.bounds_world.min;
      const double extent = std::max({size.x, size.y, size.z});
      SectionPlane plane{normal, glm::dot(normal, whole.bounds_world.min + 0.4 * size)};
      Scene kept = whole, other = whole;
      cut_by({&plane, 1}, kept);
      double by_hand = 0.0;
      for (const Triangle& triangle : triangles_of(whole)) by_hand += area_kept(triangle, plane);
      // A vertex is rounded to single precision in its own space.
      const double rounding = 1e-6 * area_of(whole);
      EXPECT_GT(by_hand, 10.0 * rounding);
      EXPECT_NEAR(area_of(kept), by_hand, rounding);
      for (const Triangle& triangle : triangles_of(kept))
        for (const glm::dvec3& corner : triangle)
          EXPECT_LE(glm::dot(normal, corner) - plane.distance, 1e-6 * extent * glm::length(normal));
      const SectionPlane turned{-plane.normal, -plane.distance};
      cut_by({&turned, 1}, other);
      EXPECT_NEAR(area_of(kept) + area_of(other), area_of(whole), 2.0 * rounding);
    }
}

TEST(Section, cuts_an_edge_that_triangles_share_once) {
  TestGltf gltf;
  const int corners = gltf.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  const int normals = gltf.positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int indices =
      gltf.accessor(gltf.view(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}), kUnsignedShort, "SCALAR", 6);
  gltf.show({{"attributes", {{"POSITION", corners}, {"NORMAL", normals}}}, {"indices", indices}});
  Scene scene = gltf.load();
  ASSERT_EQ(scene.positions.size(), 4u);
  cut_by(std::vector<SectionPlane>{{{1, 0, 0}, 0.5}}, scene);
  // Two sides of the square, and the diagonal.
  EXPECT_EQ(scene.positions.size(), 7u);
  EXPECT_NEAR(area_of(scene), 0.5, 1e-7);
}

TEST(Section, of_a_scene_that_plays_rests_with_a_warning) {
  Scene scene = scene_of("prop");
  scene.motion.animations.emplace_back();
  cut_by(std::vector<SectionPlane>{{{0, 1, 0}, 0.2}}, scene);
  EXPECT_TRUE(scene.motion.animations.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("at rest"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
