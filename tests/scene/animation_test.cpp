// Do animations move what they should, by the keys of the file, and do broken ones do no harm?
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "gltf_text.hpp"
#include "gnomon/scene/pose.hpp"
#include "shared_files.hpp"

namespace gnomon::test {
namespace {

const std::vector<float> kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const char* shape_of(std::size_t width) {
  return width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
}

struct Keys {
  std::vector<float> times, values;
  std::size_t width = 3;  ///< components of the accessor
  std::string interpolation = "LINEAR";
};

/// Adds a channel to an animation, which is made where it is the next one. Returns the sampler.
void drive(TestGltf& gltf, std::size_t animation, int node, const char* path, const Keys& keys) {
  json& animations = gltf.document["animations"];
  if (animations.is_null()) animations = json::array();
  while (animations.size() <= animation)
    animations.push_back({{"channels", json::array()}, {"samplers", json::array()}});
  const int input = gltf.accessor(gltf.view(keys.times), kFloat, "SCALAR", keys.times.size());
  const int output =
      gltf.accessor(gltf.view(keys.values), kFloat, shape_of(keys.width), keys.values.size() / keys.width);
  json& to = gltf.document["animations"][animation];
  to["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", keys.interpolation}});
  to["channels"].push_back(
      {{"sampler", to["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

const Keys kWalk{{0, 2}, {0, 0, 0, 4, 0, 2}, 3, "LINEAR"};

/// A triangle that walks with a child, and one that stays.
TestGltf walking() {
  TestGltf gltf = one_triangle();
  const int child = gltf.add("nodes", {{"mesh", 0}, {"translation", {0, 5, 0}}});
  gltf.document["nodes"][0]["children"] = {child};
  gltf.show_node({{"mesh", 0}, {"translation", {0, 0, -9}}});
  drive(gltf, 0, 0, "translation", kWalk);
  return gltf;
}

Pose posed(const Scene& scene, double time_s, int animation = 0) {
  Pose out;
  EXPECT_TRUE(pose(scene, animation, time_s, out));
  return out;
}

glm::dvec3 place(const Pose& pose, std::size_t index = 0) {
  return {pose.instances.at(index).world_from_object[3]};
}

TEST(Animation, a_scene_without_one_has_no_motion) {
  const Scene scene = one_triangle().load();
  EXPECT_TRUE(scene.motion.nodes.empty());
  EXPECT_EQ(scene.motion.bytes(), 0u);
  EXPECT_TRUE(posed(scene, 1.0, kRestPose).instances.empty());
  Pose out;
  EXPECT_FALSE(pose(scene, 0, 0.0, out));
}

TEST(Animation, a_node_and_its_children_move_and_others_stay) {
  const Scene scene = walking().load();
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.instances.size(), 3u);
  ASSERT_EQ(scene.motion.animations.size(), 1u);
  EXPECT_EQ(scene.motion.animations[0].duration_s, 2.0);
  const Pose half = posed(scene, 1.0);
  ASSERT_EQ(half.instances.size(), 2u) << "the third stays";
  EXPECT_EQ(place(half, 0), glm::dvec3(2, 0, 1));
  EXPECT_EQ(place(half, 1), glm::dvec3(2, 5, 1));
  EXPECT_EQ(half.instances[1].bounds_world.min, glm::dvec3(2, 5, 1));
  EXPECT_EQ(half.instances[1].bounds_world.max, glm::dvec3(3, 6, 1));
  EXPECT_TRUE(half.vertices.empty());
  EXPECT_EQ(place(posed(scene, -1.0)), glm::dvec3(0, 0, 0)) << "before the first key";
  EXPECT_EQ(place(posed(scene, 99.0)), glm::dvec3(4, 0, 2)) << "after the last";
}

TEST(Animation, applied_to_a_scene_it_moves_bounds_and_instances) {
  Scene scene = walking().load();
  const Box before = scene.bounds_world;
  apply_pose(posed(scene, 2.0), scene);
  EXPECT_EQ(glm::dvec3(scene.instances[1].world_from_object[3]), glm::dvec3(4, 5, 2));
  EXPECT_EQ(scene.instances[2].bounds_world.min.z, -9.0);
  EXPECT_EQ(scene.bounds_world.max, glm::dvec3(5, 6, 2));
  apply_pose(posed(scene, 0.0, kRestPose), scene);
  EXPECT_EQ(scene.bounds_world, before) << "and back to rest";
}

TEST(Animation, keys_are_read_by_their_interpolation) {
  TestGltf gltf = one_triangle();
  drive(gltf, 0, 0, "translation", {{1, 2, 3}, {1, 0, 0, 5, 0, 0, 2, 0, 0}, 3, "STEP"});
  // In-tangent, value, out-tangent: from 0 at speed 2 to 3 at speed 0.
  drive(gltf, 1, 0, "translation",
        {{0, 2}, {9, 9, 9, 0, 0, 0, 2, 0, 0, 0, 0, 0, 3, 0, 0, 9, 9, 9}, 3, "CUBICSPLINE"});
  drive(gltf, 2, 0, "scale", {{0, 1}, {1, 1, 1, 3, 1, -1}, 3, "LINEAR"});
  // From 0 at rest to 0 at speed 3.
  drive(gltf, 3, 0, "translation",
        {{0, 2}, {9, 9, 9, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 9, 9, 9}, 3, "CUBICSPLINE"});
  const Scene scene = gltf.load();
  EXPECT_EQ(place(posed(scene, 1.99)).x, 1.0);
  EXPECT_EQ(place(posed(scene, 2.0)).x, 5.0);
  EXPECT_EQ(place(posed(scene, 3.5)).x, 2.0);
  // Hermite at a half: p0/2 + p1/2 + length (m0 - m1)/8.
  EXPECT_DOUBLE_EQ(place(posed(scene, 1.0, 1)).x, 1.5 + 2.0 * 2.0 / 8.0);
  EXPECT_EQ(place(posed(scene, 2.0, 1)).x, 3.0);
  EXPECT_DOUBLE_EQ(place(posed(scene, 1.0, 3)).x, -2.0 * 3.0 / 8.0);
  const Pose scaled = posed(scene, 1.0, 2);
  EXPECT_EQ(scaled.instances[0].world_from_object[0][0], 3.0);
  EXPECT_TRUE(scaled.instances[0].mirrored);
  EXPECT_FALSE(posed(scene, 0.25, 2).instances[0].mirrored);
}

TEST(Animation, rotations_turn_evenly_the_short_way_round) {
  const auto turned = [](double degrees, double sign) {
    const double half = degrees * 3.14159265358979323846 / 360.0;
    return std::vector<float>{0, static_cast<float>(sign * std::sin(half)), 0,
                              static_cast<float>(sign * std::cos(half))};
  };
  std::vector<float> values = turned(0, 1);
  const std::vector<float> end = turned(80, -1);  // the same turn, by a quaternion of the other sign
  values.insert(values.end(), end.begin(), end.end());
  TestGltf gltf = one_triangle();
  drive(gltf, 0, 0, "rotation", {{0, 4}, values, 4, "LINEAR"});
  const Scene scene = gltf.load();
  const glm::dmat4 m = posed(scene, 1.0).instances[0].world_from_object;
  const double angle = std::atan2(-m[0][2], m[0][0]) * 180.0 / 3.14159265358979323846;
  EXPECT_NEAR(angle, 20.0, 1e-5);
}

TEST(Animation, rotations_of_no_length_are_no_turn_and_warned_of) {
  TestGltf gltf = one_triangle();
  drive(gltf, 0, 0, "rotation", {{0, 1}, {0, 0, 0, 0, 0, 1, 0, 0}, 4, "LINEAR"});
  // A spline that runs through zero between two opposite keys.
  drive(
      gltf, 1, 0, "rotation",
      {{0, 1}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0}, 4, "CUBICSPLINE"});
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("no length"), std::string::npos);
  EXPECT_EQ(posed(scene, 0.0).instances[0].world_from_object, glm::dmat4(1.0));
  EXPECT_EQ(posed(scene, 0.5, 1).instances[0].world_from_object, glm::dmat4(1.0));
}

/// A triangle whose corners follow two joints, of which the second walks.
TestGltf skinned(bool normals) {
  TestGltf gltf;
  const int j = gltf.accessor(gltf.view(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}),
                              kUnsignedByte, "VEC4", 3);
  const int w =
      gltf.accessor(gltf.view(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, .5f, .5f, 0, 0}), kFloat, "VEC4", 3);
  std::vector<float> both = kIdentity;
  both.insert(both.end(), kIdentity.begin(), kIdentity.end());
  const int ibm = gltf.accessor(gltf.view(both), kFloat, "MAT4", 2);
  json attributes = {{"POSITION", gltf.positions(kTriangle)}, {"JOINTS_0", j}, {"WEIGHTS_0", w}};
  if (normals) attributes["NORMAL"] = gltf.positions({0, 0, 1, 0, 0, 1, 0, 0, 1});
  gltf.show({{"attributes", attributes}}, {{"skin", 0}, {"translation", {1000, 0, 0}}});
  gltf.show_node({{"translation", {10, 0, 0}}});
  gltf.show_node({{"translation", {0, 20, 0}}});
  gltf.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", ibm}});
  drive(gltf, 0, 2, "translation", {{0, 1}, {0, 20, 0, 0, 24, -8}, 3, "LINEAR"});
  return gltf;
}

TEST(Animation, skinned_vertices_follow_their_joints) {
  for (const bool normals : {false, true}) {
    const Scene scene = skinned(normals).load();
    ASSERT_EQ(scene.motion.meshes.size(), 1u);
    const Pose rest = posed(scene, 0.0), end = posed(scene, 1.0);
    EXPECT_EQ(rest.positions, scene.positions) << "the same bits at rest";
    EXPECT_EQ(rest.normals, scene.normals);
    ASSERT_EQ(end.vertices.size(), 1u);
    EXPECT_EQ(end.positions[0], glm::vec3(10, 0, 0));
    EXPECT_EQ(end.positions[1], glm::vec3(1, 24, -8));
    EXPECT_EQ(end.positions[2], glm::vec3(5, 13, -4));
    EXPECT_EQ(end.instances[0].bounds_world.min, glm::dvec3(1, 0, -8));
    EXPECT_EQ(end.instances[0].bounds_world.max, glm::dvec3(10, 24, 0));
    // Joints that move without turning carry normals as they are; flat ones are of the bent triangle.
    EXPECT_EQ(end.normals[0] == glm::vec3(0, 0, 1), normals);
    EXPECT_NEAR(glm::length(end.normals[0]), 1.0f, 1e-6f);
    Scene applied = scene;
    apply_pose(end, applied);
    EXPECT_EQ(applied.positions[1], glm::vec3(1, 24, -8));
    EXPECT_EQ(applied.primitives[0].bounds, end.instances[0].bounds_world);
  }
}

TEST(Animation, each_mesh_follows_the_joints_of_its_own_skin) {
  TestGltf gltf = skinned(false);
  gltf.show_node({{"mesh", 0}, {"skin", 1}});
  const int first = gltf.show_node({{"translation", {0, 0, 30}}}),
            second = gltf.show_node({{"translation", {0, 0, 50}}});
  gltf.add("skins", {{"joints", {first, second}}});
  drive(gltf, 0, first, "translation", {{0, 1}, {0, 0, 30, 0, 0, 40}, 3, "LINEAR"});
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.motion.meshes.size(), 2u);
  const Pose end = posed(scene, 1.0);
  EXPECT_EQ(end.positions[end.vertices[0].first], glm::vec3(10, 0, 0));
  EXPECT_EQ(end.positions[end.vertices[1].first], glm::vec3(0, 0, 40));
  EXPECT_EQ(end.positions[end.vertices[1].first + 1], glm::vec3(1, 0, 50));
}

/// A triangle with one morph target, alone or under a skin.
TestGltf morphing(bool skin) {
  TestGltf gltf;
  json primitive = {{"attributes", {{"POSITION", gltf.positions(kTriangle)}}},
                    {"targets", {{{"POSITION", gltf.positions({0, 0, 0, 0, 0, 2, 0, 0, 0})}}}}};
  if (skin) {
    const std::vector<std::uint8_t> joints(12, 0);
    primitive["attributes"]["JOINTS_0"] = gltf.accessor(gltf.view(joints), kUnsignedByte, "VEC4", 3);
    primitive["attributes"]["WEIGHTS_0"] =
        gltf.accessor(gltf.view(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), kFloat, "VEC4", 3);
  }
  gltf.show(primitive, skin ? json{{"skin", 0}} : json{{"translation", {0, 7, 0}}});
  if (skin) gltf.add("skins", {{"joints", {gltf.show_node({{"translation", {0, 7, 0}}})}}});
  drive(gltf, 0, 0, "weights", {{0, 1}, {0, 1}, 1, "LINEAR"});
  return gltf;
}

TEST(Animation, morph_targets_move_vertices_by_their_weights) {
  for (const bool skin : {false, true}) {
    const Scene scene = morphing(skin).load();
    EXPECT_TRUE(scene.warnings.empty());
    const Pose half = posed(scene, 0.5);
    ASSERT_EQ(half.vertices.size(), 1u);
    const float up = skin ? 7.0f : 0.0f;
    EXPECT_EQ(half.positions[0], glm::vec3(0, up, 0));
    EXPECT_EQ(half.positions[1], glm::vec3(1, up, 1));
    EXPECT_EQ(half.instances[0].bounds_world.max, glm::dvec3(1, 8, 1));
    EXPECT_EQ(posed(scene, 0.0).positions, scene.positions);
  }
}

TEST(Animation, weights_at_rest_count_in_poses_of_other_animations) {
  TestGltf gltf = morphing(false);
  gltf.document["nodes"][0]["weights"] = {0.25};
  drive(gltf, 1, 0, "translation", kWalk);
  // Those of the mesh stand where the node has none.
  gltf.document["meshes"][0]["weights"] = {0.75};
  const Scene scene = gltf.load();
  EXPECT_EQ(posed(scene, 0.0, 1).positions[1].z, 0.5f);
  EXPECT_EQ(posed(scene, 1.0, 0).positions[1].z, 2.0f);
  gltf.document["nodes"][0].erase("weights");
  EXPECT_EQ(posed(gltf.load(), 0.0, 1).positions[1].z, 1.5f);
}

TEST(Animation, two_nodes_of_one_mesh_morph_apart) {
  TestGltf gltf = morphing(false);
  const int other = gltf.show_node({{"mesh", 0}, {"translation", {50, 0, 0}}});
  drive(gltf, 0, other, "weights", {{0, 1}, {1, 0}, 1, "LINEAR"});
  gltf.show_node({{"mesh", 0}});
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.instances.size(), 3u);
  ASSERT_EQ(scene.motion.meshes.size(), 2u) << "the third stays as it is";
  const Pose begin = posed(scene, 0.0);
  EXPECT_EQ(begin.positions[1].z, 0.0f);
  EXPECT_EQ(begin.positions[4].z, 2.0f);
}

// A broken channel is skipped, and the scene and the other channel are as they were.
TEST(Animation, broken_channels_are_warned_of_and_skipped) {
  struct Case {
    const char* what;
    Keys keys;
    const char* path = "scale";
  };
  const std::vector<Case> cases{{"before that of the key before", {{0, 2, 1}, {1, 1, 1, 1, 1, 1, 1, 1, 1}}},
                                {"is not finite", {{0, kNan}, {1, 1, 1, 1, 1, 1}}},
                                {"below 0", {{-1, 2}, {1, 1, 1, 1, 1, 1}}},
                                {"value that is not finite", {{0, 1}, {1, 1, 1, kNan, 1, 1}}},
                                {"values for", {{0, 1}, {1, 1, 1}}},
                                {"values for", {{0, 1}, {1, 1, 1, 1, 1, 1}, 3, "CUBICSPLINE"}},
                                {"wrong type", {{0, 1}, {1, 1, 1, 1, 1, 1, 1, 1}, 4}},
                                {"interpolation 'BEZIER'", {{0, 1}, {1, 1, 1, 1, 1, 1}, 3, "BEZIER"}},
                                {"path 'pointer'", {{0, 1}, {1, 1, 1, 1, 1, 1}}, "pointer"},
                                {"no morph targets", {{0, 1}, {1, 1}, 1}, "weights"},
                                {"another channel", {{0, 1}, {1, 1, 1, 1, 1, 1}}, "translation"}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    TestGltf gltf = walking();
    drive(gltf, 0, 0, one.path, one.keys);
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find(one.what), std::string::npos) << scene.warnings[0];
    EXPECT_NE(scene.warnings[0].find("animations[0].channels[1]"), std::string::npos);
    EXPECT_EQ(scene.motion.animations[0].channels.size(), 1u);
    EXPECT_EQ(place(posed(scene, 1.0)), glm::dvec3(2, 0, 1));
  }
}

TEST(Animation, broken_documents_lose_their_animation_alone) {
  const auto broken = [](auto&& change) {
    TestGltf gltf = walking();
    change(gltf.document["animations"]);
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.instances.size(), 3u);
    EXPECT_FALSE(scene.warnings.empty());
    EXPECT_TRUE(scene.motion.animations.empty() || scene.motion.animations[0].channels.empty());
    EXPECT_TRUE(scene.motion.instances.empty());
  };
  broken([](json& a) { a = 7; });
  broken([](json& a) { a[0] = 7; });
  broken([](json& a) { a[0].erase("samplers"); });
  broken([](json& a) { a[0]["channels"] = json::array(); });
  broken([](json& a) { a[0]["samplers"][0]["input"] = 99; });
  broken([](json& a) { a[0]["channels"][0]["sampler"] = 99; });
  broken([](json& a) { a[0]["channels"][0]["target"]["node"] = 99; });
  broken([](json& a) { a[0]["channels"][0]["target"].erase("node"); });
}

TEST(Animation, a_node_with_a_matrix_is_not_animated) {
  TestGltf gltf = walking();
  gltf.document["nodes"][0]["matrix"] = kIdentity;
  const Scene scene = gltf.load();
  ASSERT_GE(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("matrix"), std::string::npos);
  EXPECT_TRUE(scene.motion.instances.empty());
}

TEST(Animation, keys_above_the_limit_are_refused_before_they_are_read) {
  LoadLimits limits;
  limits.animation_numbers = 8;
  EXPECT_EQ(refusal_of(walking(), limits), "");
  limits.animation_numbers = 7;
  EXPECT_NE(refusal_of(walking(), limits).find("above 7 numbers"), std::string::npos);
  TestGltf hostile = walking();
  const int accessor = hostile.add(
      "accessors", {{"componentType", kFloat}, {"type", "SCALAR"}, {"count", 1ull << 40}});  // all zeros
  hostile.document["animations"][0]["samplers"][0]["input"] = accessor;
  EXPECT_NE(refusal_of(hostile).find("numbers"), std::string::npos);
  limits.animation_numbers = 20;
  EXPECT_NE(refusal_of(skinned(true), limits).find("numbers"), std::string::npos);
}

TEST(Animation, poses_that_are_not_finite_stay_at_rest) {
  TestGltf gltf = walking();
  const float huge = std::numeric_limits<float>::max();
  gltf.document["nodes"][0]["children"] = json::array();
  // A spline with tangents that overflow nothing in double, times a chain of scales that does.
  int parent = 0;
  for (int i = 0; i < 9; ++i) {
    const int child = gltf.add("nodes", {{"mesh", 0}});
    gltf.document["nodes"][static_cast<std::size_t>(parent)]["children"] = {child};
    drive(gltf, 0, child, "scale", {{0, 1}, {1, 1, 1, huge, huge, huge}, 3, "LINEAR"});
    parent = child;
  }
  const Scene scene = gltf.load();
  EXPECT_EQ(posed(scene, 0.0).at_rest, 0u);
  const Pose end = posed(scene, 1.0);
  EXPECT_GT(end.at_rest, 0u);
  for (const PosedInstance& instance : end.instances)
    EXPECT_TRUE(std::isfinite(instance.bounds_world.max.x) &&
                std::isfinite(instance.world_from_object[3][0]));
  Pose again = end;
  ASSERT_TRUE(pose(scene, 0, 0.0, again));
  EXPECT_EQ(again.at_rest, 0u) << "of this pose alone";
}

TEST(Animation, times_and_names) {
  TestGltf gltf = walking();
  gltf.document["animations"][0]["name"] = "walk";
  drive(gltf, 1, 0, "translation", {{0}, {7, 0, 0}, 3, "LINEAR"});
  gltf.document["animations"][1]["name"] = "0";
  const Scene scene = gltf.load();
  const Animation& walk = scene.motion.animations[0];
  EXPECT_EQ(looped_time(walk, 5.5), 1.5);
  EXPECT_EQ(looped_time(walk, -0.5), 1.5);
  EXPECT_EQ(looped_time(walk, 2.0), 0.0);
  EXPECT_EQ(looped_time(walk, -1e-300), 0.0);
  EXPECT_EQ(looped_time(walk, INFINITY), 0.0);
  EXPECT_EQ(looped_time(scene.motion.animations[1], 3.0), 0.0) << "one key: no duration";
  EXPECT_EQ(place(posed(scene, 0.0, 1)).x, 7.0);
  EXPECT_EQ(find_animation(scene.motion, "walk"), 0);
  EXPECT_EQ(find_animation(scene.motion, "1"), 1);
  EXPECT_EQ(find_animation(scene.motion, "0"), 1) << "a name comes before a number";
  for (const char* none : {"", "2", "-1", "1x", "run"}) EXPECT_EQ(find_animation(scene.motion, none), -1);
  Pose out;
  EXPECT_FALSE(pose(scene, 0, std::nan(""), out));
  EXPECT_FALSE(pose(scene, 2, 0.0, out));
  ASSERT_EQ(out.instances.size(), 2u);
  EXPECT_EQ(place(out), glm::dvec3(0, 0, 0)) << "at rest";
}

TEST(Animation, real_figures_rest_as_they_were_loaded_and_move) {
  for (const char* name : {"fox/Fox.glb", "robot_expressive/RobotExpressive.glb"}) {
    const auto file = shared_folder() / "scenes" / name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared/scenes";
    SCOPED_TRACE(name);
    const Scene scene = load_gltf(file);
    ASSERT_GE(scene.motion.animations.size(), 3u);
    Scene again = scene;
    apply_pose(posed(scene, 0.0, kRestPose), again);
    EXPECT_EQ(again.positions, scene.positions);
    EXPECT_EQ(again.normals, scene.normals);
    EXPECT_EQ(again.bounds_world, scene.bounds_world);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      EXPECT_EQ(again.instances[i].world_from_object, scene.instances[i].world_from_object);
      EXPECT_EQ(again.instances[i].bounds_world, scene.instances[i].bounds_world);
    }
    const double size = glm::length(scene.bounds_world.max - scene.bounds_world.min);
    for (std::size_t a = 0; a < scene.motion.animations.size(); ++a) {
      const double duration = scene.motion.animations[a].duration_s;
      EXPECT_GT(duration, 0.0);
      const Pose begin = posed(scene, 0.0, static_cast<int>(a)),
                 middle = posed(scene, 0.37 * duration, static_cast<int>(a));
      EXPECT_EQ(middle.at_rest, 0u);
      EXPECT_NE(begin.positions, middle.positions) << scene.motion.animations[a].name;
      EXPECT_EQ(middle.positions, posed(scene, 0.37 * duration, static_cast<int>(a)).positions);
      apply_pose(middle, again);
      EXPECT_LT(glm::length(again.bounds_world.max - again.bounds_world.min), 3.0 * size);
    }
  }
}

}  // namespace
}  // namespace gnomon::test
