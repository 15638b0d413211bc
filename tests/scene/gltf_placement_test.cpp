// Are instances, hidden nodes, weights at rest and invisible vertex colours what the same scene written out
// is?
#include <gtest/gtest.h>

#include "gltf_text.hpp"

namespace gnomon::test {
namespace {

/// Three places of a triangle: moved, turned by a right angle about y, and scaled.
TestGltf instanced() {
  TestGltf gltf;
  const int moves = gltf.positions({0, 0, 0, 5, 0, 0, 0, 7, 0});
  const float r = 0.70710678f;
  const int turns =
      gltf.accessor(gltf.view(std::vector<float>{0, 0, 0, 1, 0, r, 0, r, 0, 0, 0, 1}), kFloat, "VEC4", 3);
  const int scales = gltf.positions({1, 1, 1, 1, 1, 1, 2, 3, 4});
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kTriangle)}}}},
            {{"translation", {0, 0, 9}},
             {"extensions",
              {{"EXT_mesh_gpu_instancing",
                {{"attributes", {{"TRANSLATION", moves}, {"ROTATION", turns}, {"SCALE", scales}}}}}}}});
  gltf.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  gltf.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return gltf;
}

json& attributes_of(TestGltf& gltf) {
  return gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

TEST(GltfPlacement, instances_are_what_nodes_written_out_are) {
  const Scene scene = instanced().load();
  EXPECT_TRUE(scene.warnings.empty());
  TestGltf nodes;
  nodes.show({{"attributes", {{"POSITION", nodes.positions(kTriangle)}}}});
  nodes.document["scenes"][0]["nodes"] = json::array();
  const float r = 0.70710678f;
  const int parent = nodes.show_node({{"translation", {0, 0, 9}}});
  nodes.document["nodes"][static_cast<std::size_t>(parent)]["children"] = {
      nodes.add("nodes", {{"mesh", 0}}),
      nodes.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}, {"rotation", {0, r, 0, r}}}),
      nodes.add("nodes", {{"mesh", 0}, {"translation", {0, 7, 0}}, {"scale", {2, 3, 4}}})};
  const Scene written = nodes.load();
  ASSERT_EQ(scene.instances.size(), 3u);
  ASSERT_EQ(written.instances.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scene.instances[i].bounds_world, written.instances[i].bounds_world) << i;
    EXPECT_EQ(scene.instances[i].primitive, scene.instances[0].primitive) << "one mesh for all";
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(scene.instances[i].world_from_object[c][k], written.instances[i].world_from_object[c][k],
                    1e-7);
  }
}

TEST(GltfPlacement, ten_thousand_instances_share_one_mesh) {
  TestGltf gltf;
  std::vector<float> moves;
  for (int i = 0; i < 10000; ++i) moves.insert(moves.end(), {static_cast<float>(i), 0.0f, 0.0f});
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kTriangle)}}}},
            {{"extensions",
              {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", gltf.positions(moves)}}}}}}}});
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.instances.size(), 10000u);
  EXPECT_EQ(scene.primitives.size(), 1u);
  EXPECT_EQ(scene.bounds_world.max.x, 10000.0);
  LoadLimits few;
  few.triangles = 9999;
  EXPECT_NE(refusal_of(gltf, few).find("triangles"), std::string::npos);
  few = {};
  few.nodes = 100;
  EXPECT_NE(refusal_of(gltf, few), "");
}

TEST(GltfPlacement, broken_instances_are_warned_of_and_shown_once) {
  TestGltf gltf = instanced();
  attributes_of(gltf)["TRANSLATION"] = 99;
  Scene scene = gltf.load();
  EXPECT_EQ(scene.instances.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("nodes[0]"), std::string::npos) << scene.warnings[0];

  gltf = instanced();
  attributes_of(gltf)["ROTATION"] = attributes_of(gltf)["SCALE"];  // three numbers in place of four
  scene = gltf.load();
  EXPECT_EQ(scene.instances.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);

  gltf = instanced();
  gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = 7;
  EXPECT_EQ(gltf.load().instances.size(), 1u);

  // The shortest list counts.
  gltf = instanced();
  gltf.document["accessors"][static_cast<std::size_t>(attributes_of(gltf)["SCALE"].get<int>())]["count"] = 2;
  EXPECT_EQ(gltf.load().instances.size(), 2u);
}

TEST(GltfPlacement, of_what_is_not_finite_is_refused) {
  TestGltf gltf;
  const float infinity = std::numeric_limits<float>::infinity();
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kTriangle)}}}},
            {{"extensions",
              {{"EXT_mesh_gpu_instancing",
                {{"attributes", {{"TRANSLATION", gltf.positions({infinity, 0, 0})}}}}}}}});
  EXPECT_NE(refusal_of(gltf).find("not finite"), std::string::npos);
}

TEST(GltfVisibility, hides_a_node_and_all_that_hangs_on_it) {
  TestGltf gltf = one_triangle();
  const int child = gltf.add("nodes", {{"mesh", 0}});
  const int hidden = gltf.show_node({{"mesh", 0}, {"children", {child}}});
  EXPECT_EQ(gltf.load().instances.size(), 3u);
  json& visibility =
      gltf.document["nodes"][static_cast<std::size_t>(hidden)]["extensions"]["KHR_node_visibility"];
  visibility["visible"] = false;
  gltf.document["extensionsRequired"] = {"KHR_node_visibility"};
  EXPECT_EQ(gltf.load().instances.size(), 1u);
  EXPECT_TRUE(gltf.load().warnings.empty());
  visibility["visible"] = true;
  EXPECT_EQ(gltf.load().instances.size(), 3u);
  visibility["visible"] = "no";
  EXPECT_EQ(gltf.load().instances.size(), 3u);
  EXPECT_EQ(gltf.load().warnings.size(), 1u);
}

/// A triangle whose second corner a target lifts by 2 along z.
TestGltf with_target() {
  TestGltf gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kTriangle)}}},
             {"targets", {{{"POSITION", gltf.positions({0, 0, 0, 0, 0, 2, 0, 0, 0})}}}}});
  return gltf;
}

TEST(GltfMorph, weights_at_rest_move_vertices_of_the_node_before_those_of_the_mesh) {
  TestGltf gltf = with_target();
  EXPECT_EQ(gltf.load().positions[1].z, 0.0f);
  gltf.document["meshes"][0]["weights"] = {0.5};
  EXPECT_EQ(gltf.load().positions[1].z, 1.0f);
  gltf.document["nodes"][0]["weights"] = {1.5};
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.positions[1].z, 3.0f);
  EXPECT_EQ(scene.bounds_world.max.z, 3.0);
  // The normal is that of the lifted triangle.
  EXPECT_NEAR(scene.normals[0].x, -3.0 / std::sqrt(10.0), 1e-6);
  EXPECT_TRUE(scene.motion.meshes.empty()) << "nothing drives it";
  // Another node of the mesh has its own weights.
  const int other = gltf.show_node({{"mesh", 0}, {"weights", {0.0}}});
  EXPECT_EQ(other, 1);
  const Scene two = gltf.load();
  ASSERT_EQ(two.instances.size(), 2u);
  EXPECT_EQ(two.instances[0].bounds_world.max.z, 3.0);
  EXPECT_EQ(two.instances[1].bounds_world.max.z, 0.0);
}

TEST(GltfMorph, broken_weights_and_targets_move_nothing) {
  TestGltf gltf = with_target();
  gltf.document["meshes"][0]["weights"] = "all";
  EXPECT_EQ(gltf.load().positions[1].z, 0.0f);
  EXPECT_EQ(gltf.load().warnings.size(), 1u);
  gltf.document["meshes"][0]["weights"] = {1.0, 1.0, 1.0};
  EXPECT_EQ(gltf.load().positions[1].z, 2.0f);
  gltf.document["meshes"][0]["weights"] = {3e38};
  EXPECT_NE(refusal_of(gltf), "");
}

/// Two triangles, the first of alpha 0, the second of alpha 1.
TestGltf coloured(const char* mode) {
  TestGltf gltf;
  const int positions = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0});
  std::vector<float> colors;
  for (int i = 0; i < 6; ++i) colors.insert(colors.end(), {1.0f, 1.0f, 1.0f, i < 3 ? 0.0f : 1.0f});
  const int color = gltf.accessor(gltf.view(colors), kFloat, "VEC4", 6);
  gltf.show({{"attributes", {{"POSITION", positions}, {"COLOR_0", color}}}, {"material", 0}});
  gltf.add("materials", {{"alphaMode", mode}});
  return gltf;
}

TEST(GltfVertexColours, make_triangles_invisible_under_a_mask_or_in_glass) {
  for (const char* mode : {"MASK", "BLEND"}) {
    const Scene scene = coloured(mode).load();
    ASSERT_EQ(scene.primitives.size(), 1u);
    EXPECT_EQ(scene.primitives[0].index_count, 3u) << mode;
    EXPECT_EQ(scene.bounds_world.min.x, 5.0) << mode;
  }
  EXPECT_EQ(coloured("OPAQUE").load().primitives[0].index_count, 6u);
  // The factor's alpha counts, too: nothing is left.
  TestGltf gltf = coloured("MASK");
  gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.4};
  EXPECT_TRUE(gltf.load().primitives.empty());
  EXPECT_EQ(gltf.load().warnings.size(), 1u);
}

TEST(GltfVertexColours, a_mask_that_ends_within_a_triangle_leaves_it_whole) {
  TestGltf gltf;
  const int color =
      gltf.accessor(gltf.view(std::vector<float>{1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1}), kFloat, "VEC4", 3);
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kTriangle)}, {"COLOR_0", color}}}, {"material", 0}});
  gltf.add("materials", {{"alphaMode", "MASK"}});
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.primitives[0].index_count, 3u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("vertex colours"), std::string::npos);
}

/// A mesh shown twice, and what `extras` of the mesh and of its second node say.
TestGltf shown_twice(const json& of_mesh, const json& of_node) {
  TestGltf gltf = one_triangle();
  json second = {{"mesh", 0}};
  if (!of_node.is_null()) second["extras"] = of_node;
  gltf.show_node(second);
  if (!of_mesh.is_null()) gltf.document["meshes"][0]["extras"] = of_mesh;
  return gltf;
}

TEST(GltfPlacement, casting_and_receiving_are_of_the_node_else_of_its_mesh) {
  const json off = {{"castShadow", false}, {"receiveShadow", 0}}, on = {{"castShadow", true}};
  struct Case {
    json mesh, node;
    bool casts[2], receives[2];
  };
  for (const Case& one :
       {Case{nullptr, nullptr, {true, true}, {true, true}},
        Case{off, nullptr, {false, false}, {false, false}}, Case{nullptr, off, {true, false}, {true, false}},
        Case{off, on, {false, true}, {false, false}},
        Case{{{"other", 1}}, {{"receiveShadow", 1.0}}, {true, true}, {true, true}}}) {
    const Scene scene = shown_twice(one.mesh, one.node).load();
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    ASSERT_EQ(scene.instances.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(scene.instances[i].casts, one.casts[i]) << one.mesh << one.node << i;
      EXPECT_EQ(scene.instances[i].receives, one.receives[i]) << one.mesh << one.node << i;
    }
  }
}

TEST(GltfPlacement, extras_of_another_kind_are_a_warning_and_do_not_count) {
  for (const json& wrong : {json("no"), json(2), json(nullptr), json::array()}) {
    const Scene scene = shown_twice(nullptr, {{"castShadow", wrong}}).load();
    EXPECT_TRUE(scene.instances[1].casts);
    ASSERT_EQ(scene.warnings.size(), 1u) << wrong;
    EXPECT_NE(scene.warnings[0].find("nodes[1].extras.castShadow"), std::string::npos) << scene.warnings[0];
  }
  // Extras may be anything.
  EXPECT_TRUE(shown_twice(3, "text").load().warnings.empty());
}

}  // namespace
}  // namespace gnomon::test
