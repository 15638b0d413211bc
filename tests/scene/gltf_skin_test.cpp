// Skinned meshes stand in their bind pose; a broken skin is no reason to lose the mesh.
#include "gltf_text.hpp"

namespace gnomon::test {
namespace {

const std::vector<float> kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// The triangle bound to joints 1 (moved by x = 10) and 2 (moved by y = 20), shown by node 0, itself moved
// away: a skinned mesh ignores its own node.
TestGltf skinned(const std::vector<std::uint8_t>& joints, const std::vector<float>& weights,
                 const std::vector<float>& inverse_bind) {
  TestGltf gltf;
  const int position = gltf.positions(kTriangle);
  const int j = gltf.accessor(gltf.view(joints), kUnsignedByte, "VEC4", joints.size() / 4);
  const int w = gltf.accessor(gltf.view(weights), kFloat, "VEC4", weights.size() / 4);
  const int ibm = gltf.accessor(gltf.view(inverse_bind), kFloat, "MAT4", inverse_bind.size() / 16);
  gltf.show({{"attributes", {{"POSITION", position}, {"JOINTS_0", j}, {"WEIGHTS_0", w}}}},
            {{"skin", 0}, {"translation", {1000, 0, 0}}});
  gltf.show_node({{"translation", {10, 0, 0}}});
  gltf.show_node({{"translation", {0, 20, 0}}});
  gltf.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", ibm}});
  return gltf;
}

std::vector<float> twice(const std::vector<float>& m) {
  std::vector<float> out = m;
  out.insert(out.end(), m.begin(), m.end());
  return out;
}

TEST(GltfSkin, vertices_go_where_their_joints_carry_them) {
  const Scene scene = skinned({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, .5f, .5f, 0, 0},
                              twice(kIdentity))
                          .load();
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].world_from_object, glm::dmat4(1.0));
  EXPECT_EQ(scene.positions[0], glm::vec3(10, 0, 0));
  EXPECT_EQ(scene.positions[1], glm::vec3(1, 20, 0));
  EXPECT_EQ(scene.positions[2], glm::vec3(5, 11, 0));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfSkin, inverse_bind_matrices_come_before_the_joints) {
  std::vector<float> back = twice(kIdentity);
  back[12] = -10;  // joint 0 stands at x = 10 when bound
  const Scene scene =
      skinned({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, back).load();
  EXPECT_EQ(scene.positions[0], glm::vec3(0, 0, 0));
  EXPECT_EQ(scene.positions[1], glm::vec3(1, 0, 0));
}

TEST(GltfSkin, weights_that_do_not_sum_to_one_are_brought_there) {
  const Scene scene =
      skinned({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, {2, 0, 0, 0, .5f, 0, 0, 0, 0, 0, 0, 0}, twice(kIdentity))
          .load();
  EXPECT_EQ(scene.positions[0], glm::vec3(10, 0, 0));
  EXPECT_EQ(scene.positions[1], glm::vec3(11, 0, 0));
  EXPECT_EQ(scene.positions[2], glm::vec3(10, 1, 0)) << "no weight at all: its first joint";
}

TEST(GltfSkin, joints_that_mirror_turn_the_triangles_round) {
  std::vector<float> mirror = twice(kIdentity);
  mirror[0] = mirror[16] = -1;
  const Scene scene =
      skinned({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, mirror).load();
  ASSERT_EQ(scene.triangle_count(), 1u);
  // Mirrored in x the front is still +Z, because the corners are taken in the other order.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(scene.normals[scene.indices[i]], glm::vec3(0, 0, 1));
}

TEST(GltfSkin, a_broken_skin_is_a_warning_and_the_nodes_own_transform) {
  const std::vector<float> ones{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  const std::vector<float> bad_weight{-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  const std::vector<std::uint8_t> first(12, 0), beyond{7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  TestGltf no_weights = skinned(first, ones, twice(kIdentity));
  no_weights.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
  for (const TestGltf& gltf :
       {skinned(beyond, ones, twice(kIdentity)), skinned(first, bad_weight, twice(kIdentity)),
        skinned(first, ones, kIdentity), no_weights}) {
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.bounds_world.min.x, 1000.0);
    EXPECT_EQ(scene.positions.size(), scene.normals.size());
    EXPECT_EQ(scene.positions.size(), 3u) << "the attempt left vertices behind";
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("skins[0]"), std::string::npos);
  }
}

TEST(GltfSkin, skinned_nodes_count_against_the_limit_even_when_nothing_comes_of_them) {
  TestGltf gltf =
      skinned({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, twice(kIdentity));
  json& primitives = gltf.document["meshes"][0]["primitives"];
  primitives[0]["mode"] = 0;
  for (int i = 0; i < 9; ++i) primitives.push_back(primitives[0]);
  LoadLimits limits;
  limits.nodes = 10;
  EXPECT_EQ(refusal_of(gltf, limits), "");
  limits.nodes = 9;
  EXPECT_NE(refusal_of(gltf, limits).find("skinned primitives"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
