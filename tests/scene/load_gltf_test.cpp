// Nodes, scenes and instances of glTF files.
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "gltf_text.hpp"

namespace gnomon::test {
namespace {

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr double kTolerance = 1e-6;  // the test's numbers are floats of size 1
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], kTolerance);
}

TEST(LoadGltf, a_document_without_anything_is_an_empty_scene) {
  const Scene scene = TestGltf().load();
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(scene.bounds_world.empty());
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(LoadGltf, a_mesh_that_no_shown_node_uses_is_not_in_the_scene) {
  TestGltf gltf = one_triangle();
  gltf.document["scenes"][0]["nodes"] = json::array();
  EXPECT_EQ(gltf.load().triangle_count(), 0u);
}

TEST(LoadGltf, without_scenes_every_root_node_is_shown_with_a_warning) {
  TestGltf gltf = one_triangle();
  gltf.document.erase("scenes");
  gltf.document.erase("scene");
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.triangle_count(), 1u);
  EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(LoadGltf, the_default_scene_is_the_one_shown) {
  TestGltf gltf = one_triangle();
  gltf.show({{"attributes", {{"POSITION", gltf.positions({0, 0, 7, 1, 0, 7, 0, 1, 7})}}}});
  gltf.document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  gltf.document["scene"] = 1;
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.triangle_count(), 1u);
  EXPECT_EQ(scene.bounds_world.min.z, 7.0);
}

TEST(LoadGltf, a_node_listed_twice_is_shown_once) {
  TestGltf gltf = one_triangle();
  gltf.document["scenes"][0]["nodes"] = {0, 0};
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(LoadGltf, translation_rotation_and_scale_apply_in_the_order_of_the_specification) {
  TestGltf gltf = one_triangle();
  // 90 degrees about +Z: (1,0,0) scaled to (2,0,0) turns to (0,2,0) and moves to (10,2,0).
  gltf.document["nodes"][0].update({{"translation", {10, 0, 0}},
                                    {"rotation", {0, 0, 0.70710678118654752, 0.70710678118654752}},
                                    {"scale", {2, 1, 1}}});
  const Scene scene = gltf.load();
  expect_near(glm::dvec3(scene.instances[0].world_from_object * glm::dvec4(1, 0, 0, 1)), {10, 2, 0});
}

TEST(LoadGltf, a_child_stands_in_the_frame_of_its_parent) {
  TestGltf gltf = one_triangle();
  gltf.document["nodes"][0]["translation"] = {1, 0, 0};
  const int parent =
      gltf.add("nodes", {{"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 5, 1}}, {"children", {0}}});
  gltf.document["scenes"][0]["nodes"] = {parent};
  const Scene scene = gltf.load();
  expect_near(glm::dvec3(scene.instances[0].world_from_object * glm::dvec4(0, 0, 0, 1)), {0, 2, 5});
}

TEST(LoadGltf, one_mesh_in_many_places_is_stored_once) {
  TestGltf gltf = one_triangle();
  for (int i = 1; i < 5; ++i) gltf.show_node({{"mesh", 0}, {"translation", {i, 0, 0}}});
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.instances.size(), 5u);
  EXPECT_EQ(scene.primitives.size(), 1u);
  EXPECT_EQ(scene.triangle_count(), 5u);
  expect_near(scene.bounds_world.max, {5, 1, 0});
}

TEST(LoadGltf, an_odd_number_of_negative_scales_is_a_mirror_and_an_even_one_is_not) {
  const std::vector<json> scales{{1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}, {-1, -1, -1}};
  for (std::size_t i = 0; i < scales.size(); ++i) {
    TestGltf gltf = one_triangle();
    gltf.document["nodes"][0]["scale"] = scales[i];
    EXPECT_EQ(gltf.load().instances[0].mirrored, i % 2 == 1) << scales[i];
  }
}

TEST(LoadGltf, a_flattened_node_is_not_a_mirror_and_has_flat_bounds) {
  TestGltf gltf = one_triangle();
  gltf.document["nodes"][0]["scale"] = {1, 0, 1};
  const Scene scene = gltf.load();
  EXPECT_FALSE(scene.instances[0].mirrored);
  EXPECT_EQ(scene.bounds_world.max.y, 0.0);
}

TEST(LoadGltf, world_bounds_are_those_of_the_vertices_and_not_of_the_turned_box) {
  TestGltf gltf = one_triangle();
  // By 45 degrees about +Z the triangle's box would reach up to sqrt(2), its vertices reach sqrt(1/2).
  gltf.document["nodes"][0]["rotation"] = {0, 0, 0.38268343236508977, 0.92387953251128676};
  expect_near(gltf.load().bounds_world.max, {0.70710678, 0.70710678, 0});
}

TEST(LoadGltf, a_chain_of_nodes_may_be_of_any_length) {
  TestGltf gltf = one_triangle();
  constexpr int kDepth = 10'000;
  int top = 0;
  for (int i = 0; i < kDepth; ++i)
    top = gltf.add("nodes", {{"children", {top}}, {"translation", {0.5, 0, 0}}});
  gltf.document["scenes"][0]["nodes"] = {top};
  expect_near(gltf.load().bounds_world.max, {1 + kDepth / 2, 1, 0});
}

TEST(LoadGltf, a_text_file_with_a_data_uri_is_the_same_scene_as_a_binary_one) {
  // kTriangle as base64: 0,0,0, 1,0,0, 0,1,0
  const std::string text =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const WrittenFolder folder;
  const Scene scene = load_gltf(folder.write("named.gltf", text));
  EXPECT_EQ(scene.name, "named");
  EXPECT_EQ(scene.positions, one_triangle().load().positions);
}

TEST(LoadGltf, a_scene_is_named_builtin_or_by_its_path) {
  EXPECT_EQ(load_scene("builtin:fence").name, "builtin:fence");
  const WrittenFolder folder;
  EXPECT_EQ(load_scene(folder.write("a.glb", one_triangle().file()).string()).triangle_count(), 1u);
  EXPECT_THROW((void)load_scene("builtin:nothing"), SceneError);
}

}  // namespace
}  // namespace gnomon::test
