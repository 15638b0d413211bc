// Are instances, hidden nodes, weights at rest and invisible vertex colours what the same scene written out
// is?
#include <gtest/gtest.h>

#include <algorithm>

#include "animated_gltf.hpp"
#include "gltf_text.hpp"
#include "gnomon/scene/edit.hpp"
#include "gnomon/scene/pose.hpp"

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
  scene = gltf.load();
  EXPECT_EQ(scene.instances.size(), 2u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(
      scene.warnings[0].find("nodes[0]: attributes of its instances are of several counts: the first 2"),
      std::string::npos)
      << scene.warnings[0];
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
  EXPECT_EQ(gltf.load().warnings.size(), 2u) << "its primitive, and the scene without triangles";
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

// Shadow proxies.

/// A statue of two triangles at (5, 0, 0), a simple mesh of one triangle far off, and an animation that moves
/// the statue.
TestGltf statue() {
  TestGltf gltf;
  const int corners = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const int indices =
      gltf.accessor(gltf.view(std::vector<std::uint16_t>{0, 1, 2, 2, 1, 3}), kUnsignedShort, "SCALAR", 6);
  gltf.show({{"attributes", {{"POSITION", corners}}}, {"indices", indices}},
            {{"name", "statue"}, {"translation", {5, 0, 0}}, {"extras", {{"shadowProxy", "simple"}}}});
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kTriangle)}}}},
            {{"name", "simple"}, {"translation", {0, 900, 0}}});
  add_keys(gltf, 0, "translation", {0, 1}, {5, 0, 0, 7, 0, 0});
  return gltf;
}

TEST(ShadowProxy, casts_where_its_original_stands_and_is_neither_seen_nor_shadowed) {
  const Scene scene = statue().load();
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  ASSERT_EQ(scene.instances.size(), 2u) << "the proxy's own node shows nothing";
  const Instance &original = scene.instances[0], &proxy = scene.instances[1];
  EXPECT_FALSE(original.casts);
  EXPECT_TRUE(original.receives && original.shown && original.has_proxy);
  EXPECT_TRUE(proxy.casts);
  EXPECT_FALSE(proxy.receives || proxy.shown || proxy.has_proxy);
  EXPECT_EQ(proxy.world_from_object, original.world_from_object);
  EXPECT_EQ(proxy.bounds_world, (Box{{5, 0, 0}, {6, 1, 0}}));
  EXPECT_EQ(scene.bounds_world, original.bounds_world);
  EXPECT_EQ(scene.primitives[proxy.primitive].index_count, 3u);
  EXPECT_EQ(scene.nodes.at(original.node).name, "statue");
  const CastTriangles triangles = cast_triangles(scene);
  EXPECT_EQ(triangles.by_proxies, 1u);
  EXPECT_EQ(triangles.without, 2u);
}

TEST(ShadowProxy, follows_the_animation_of_its_original) {
  Scene scene = statue().load();
  Pose at_end;
  ASSERT_TRUE(pose(scene, 0, 1.0, at_end));
  apply_pose(at_end, scene);
  ASSERT_EQ(at_end.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].bounds_world, (Box{{7, 0, 0}, {8, 1, 0}}));
  EXPECT_EQ(scene.bounds_world, scene.instances[0].bounds_world);
}

TEST(ShadowProxy, of_a_mesh_is_that_of_its_nodes_and_stands_in_each_of_their_places) {
  TestGltf gltf = statue();
  gltf.document["meshes"][0]["extras"] = gltf.document["nodes"][0]["extras"];
  gltf.document["nodes"][0].erase("extras");
  gltf.document.erase("animations");
  gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      gltf.positions({0, 0, 0, 0, 0, 3});
  const Scene scene = gltf.load();
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  ASSERT_EQ(scene.instances.size(), 4u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_FALSE(scene.instances[i].casts);
    EXPECT_EQ(scene.instances[i + 2].world_from_object, scene.instances[i].world_from_object);
    EXPECT_TRUE(scene.instances[i + 2].casts);
  }
  LoadLimits few;
  few.nodes = 3;
  EXPECT_NE(refusal_of(gltf, few).find("shadow proxies: take the scene above 3 instances"), std::string::npos)
      << refusal_of(gltf, few);
  few = {};
  few.triangles = 5;
  EXPECT_NE(refusal_of(gltf, few).find("shadow proxies: take the scene above 5 triangles"), std::string::npos)
      << refusal_of(gltf, few);
}

TEST(ShadowProxy, that_cannot_be_one_is_named_by_its_place_and_the_original_casts) {
  struct Case {
    const char* what;
    void (*change)(TestGltf& gltf);
    const char* says;
  };
  const Case cases[] = {
      {"no text", [](TestGltf& g) { g.document["nodes"][0]["extras"]["shadowProxy"] = 1; },
       "nodes[0].extras.shadowProxy: is no name of a node"},
      {"missing", [](TestGltf& g) { g.document["nodes"][0]["extras"]["shadowProxy"] = "simpel"; },
       "nodes[0].extras.shadowProxy: no node is called 'simpel'"},
      {"ambiguous",
       [](TestGltf& g) {
         g.add("nodes", {{"name", "simple"}});
       },
       "nodes[0].extras.shadowProxy: nodes[1] and nodes[2] are both called 'simple'"},
      {"itself", [](TestGltf& g) { g.document["nodes"][0]["extras"]["shadowProxy"] = "statue"; },
       "nodes[0].extras.shadowProxy: nodes[0] has a shadow proxy itself"},
      {"cycle", [](TestGltf& g) { g.document["nodes"][1]["extras"]["shadowProxy"] = "statue"; },
       "nodes[0].extras.shadowProxy: nodes[1] has a shadow proxy itself"},
      {"without a mesh", [](TestGltf& g) { g.document["nodes"][1].erase("mesh"); },
       "nodes[0].extras.shadowProxy: nodes[1] has no mesh"},
      {"skinned proxy", [](TestGltf& g) { g.document["nodes"][1]["skin"] = 0; },
       "nodes[0].extras.shadowProxy: nodes[1] has a skin"},
      {"skinned original", [](TestGltf& g) { g.document["nodes"][0]["skin"] = 0; },
       "nodes[0]: has a skin, its shadow proxy does not count"},
      {"of nothing",
       [](TestGltf& g) { g.document["meshes"][1]["primitives"][0]["attributes"] = json::object(); },
       "nodes[0]: nodes[1] has no triangles, its shadow proxy does not count"},
      {"of what does not cast", [](TestGltf& g) { g.document["nodes"][0]["extras"]["castShadow"] = false; },
       "nodes[0]: casts no shadow, its shadow proxy does not count"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    TestGltf gltf = statue();
    gltf.document["skins"] = {{{"joints", {1}}}};
    one.change(gltf);
    const Scene scene = gltf.load();
    const auto says = [&](const std::string& line) { return line.starts_with(one.says); };
    EXPECT_EQ(std::count_if(scene.warnings.begin(), scene.warnings.end(), says), 1)
        << testing::PrintToString(scene.warnings);
    EXPECT_EQ(scene.instances.at(0).casts, std::string(one.what) != "of what does not cast");
    EXPECT_FALSE(scene.instances.at(0).has_proxy);
  }
}

TEST(ShadowProxy, of_another_file_is_that_of_the_same_node_else_of_the_same_mesh) {
  const auto original = [] {
    TestGltf gltf = statue();
    gltf.document["nodes"][0].erase("extras");
    gltf.document["meshes"][0]["name"] = "marble";
    gltf.show_node({{"name", "twin"}, {"mesh", 0}, {"translation", {0, 0, 4}}});
    return gltf;
  };
  TestGltf other = one_triangle();
  other.document["nodes"][0]["name"] = "statue";
  other.show_node({{"name", "nowhere"}, {"mesh", 0}});
  const Scene proxies = other.load();
  Scene scene = original().load();
  cast_by_proxies(proxies, "low.glb", {}, scene);
  ASSERT_EQ(scene.instances.size(), 4u);
  EXPECT_TRUE(scene.instances[0].has_proxy);
  EXPECT_FALSE(scene.instances[2].has_proxy) << "another node";
  EXPECT_EQ(scene.instances[3].bounds_world, (Box{{5, 0, 0}, {6, 1, 0}}));
  EXPECT_EQ(scene.warnings, std::vector<std::string>{"low.glb: no node of the scene is called nowhere"});
  // By the mesh both nodes have one.
  other.document["nodes"][0]["name"] = "elsewhere";
  other.document["meshes"][0]["name"] = "marble";
  scene = original().load();
  cast_by_proxies(other.load(), "low.glb", {}, scene);
  ASSERT_EQ(scene.instances.size(), 5u);
  EXPECT_TRUE(scene.instances[0].has_proxy && scene.instances[2].has_proxy);
  EXPECT_EQ(scene.instances[4].bounds_world, (Box{{0, 0, 4}, {1, 1, 4}}));
  Pose at_end;
  ASSERT_TRUE(pose(scene, 0, 1.0, at_end));
  apply_pose(at_end, scene);
  EXPECT_EQ(scene.instances[3].bounds_world, (Box{{7, 0, 0}, {8, 1, 0}}));
}

TEST(ShadowProxy, of_another_file_that_fits_nothing_is_refused_in_one_line) {
  const auto refusal = [](TestGltf other, const LoadLimits& limits = {}) {
    Scene scene = statue().load();
    scene.instances[0].has_proxy = false;
    scene.instances[0].casts = true;
    try {
      cast_by_proxies(other.load(), "low.glb", limits, scene);
    } catch (const SceneError& e) {
      return std::string(e.what());
    }
    return testing::PrintToString(scene.warnings);
  };
  TestGltf other = one_triangle();
  EXPECT_EQ(refusal(other), "low.glb: no mesh is a shadow proxy of a node of the scene");
  other.document["nodes"][0]["name"] = "statue";
  LoadLimits few;
  few.triangles = 3;
  EXPECT_EQ(refusal(other, few), "low.glb: shadow proxies: take the scene above 3 triangles");
  TestGltf twice = other;
  twice.show({{"attributes", {{"POSITION", twice.positions(kTriangle)}}}}, {{"name", "statue"}});
  EXPECT_EQ(refusal(twice), "low.glb: no mesh is a shadow proxy of a node of the scene");
  // A proxy of a proxy is none, and neither is what has a skin.
  TestGltf chain = statue();
  EXPECT_EQ(refusal(chain), "low.glb: no mesh is a shadow proxy of a node of the scene");
  Scene scene = statue().load();
  scene.warnings.clear();
  TestGltf both = one_triangle();
  both.document["nodes"][0]["name"] = "statue";
  EXPECT_THROW(cast_by_proxies(both.load(), "low.glb", {}, scene), SceneError);
  EXPECT_EQ(scene.warnings,
            std::vector<std::string>{"nodes[0]: has a shadow proxy of its own, the shadow proxy "
                                     "of low.glb does not count"});
}

}  // namespace
}  // namespace gnomon::test
