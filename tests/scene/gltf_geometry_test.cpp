// Triangles of every kind a glTF file can state them in.
#include <glm/geometric.hpp>

#include "gltf_text.hpp"

namespace gnomon::test {
namespace {

glm::vec3 corner(const Scene& scene, std::size_t i) {
  return scene.positions[scene.indices[i]];
}

glm::vec3 wound_normal(const Scene& scene, std::size_t triangle) {
  const glm::vec3 a = corner(scene, triangle * 3), b = corner(scene, triangle * 3 + 1),
                  c = corner(scene, triangle * 3 + 2);
  return glm::cross(b - a, c - a);
}

// A unit square in z = 0: corners 0 (0,0), 1 (1,0), 2 (1,1), 3 (0,1).
const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

Scene square_as(int mode, const std::vector<std::uint16_t>& order) {
  TestGltf gltf;
  const int position = gltf.positions(kSquare);
  const int indices = gltf.accessor(gltf.view(order), kUnsignedShort, "SCALAR", order.size());
  gltf.show({{"attributes", {{"POSITION", position}}}, {"indices", indices}, {"mode", mode}});
  return gltf.load();
}

TEST(GltfGeometry, a_mode_without_a_whole_triangle_is_skipped_with_a_warning) {
  for (const int mode : {4, 5, 6}) {
    const Scene scene = square_as(mode, {0, 1});
    EXPECT_TRUE(scene.instances.empty());
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_NE(scene.warnings[0].find("meshes[0].primitives[0]"), std::string::npos);
    EXPECT_EQ(scene.warnings[1], "scene: has no triangles, and shows nothing");
  }
}

// What the triangles enclose, by the divergence theorem: positive where they face out.
double volume_of(const Scene& scene) {
  double volume = 0.0;
  for (std::size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return glm::dvec3(scene.positions[scene.indices[i + k]]); };
    volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
  }
  return volume;
}

// Whether no corner has a normal on the back of its triangle. The ends of bars have those of their sides.
bool normals_face_as_triangles_do(const Scene& scene) {
  constexpr float kRounding = 1e-6f;
  for (std::size_t i = 0; i < scene.indices.size(); ++i)
    if (!(glm::dot(scene.normals[scene.indices[i]], wound_normal(scene, i / 3)) > -kRounding)) return false;
  return true;
}

TEST(GltfMarks, points_are_octahedra_and_lines_are_bars_of_the_width_that_extras_give) {
  constexpr double kWidth = 0.25, kRounding = 1e-6;
  struct Marks {
    int mode;
    std::uint64_t triangles;
    double volume;
  };
  for (const auto& [mode, triangles, volume] :
       {Marks{0, 4 * 8, 4 * kWidth * kWidth * kWidth / 6.0}, Marks{1, 2 * 12, 2 * kWidth * kWidth},
        Marks{2, 4 * 12, 4 * kWidth * kWidth}, Marks{3, 3 * 12, 3 * kWidth * kWidth}}) {
    TestGltf gltf;
    gltf.show({{"attributes", {{"POSITION", gltf.positions(kSquare)}}}, {"mode", mode}});
    gltf.document["meshes"][0]["extras"]["markWidth"] = kWidth;
    const Scene scene = gltf.load();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.triangle_count(), triangles) << mode;
    EXPECT_NEAR(volume_of(scene), volume, kRounding) << mode;
    EXPECT_TRUE(normals_face_as_triangles_do(scene)) << mode;
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(scene.instances[0].casts && scene.instances[0].receives);
    // Lines end at x = 0, where a loop has one across.
    const double low = mode == 1 || mode == 3 ? 0.0 : -0.5 * kWidth;
    EXPECT_NEAR(scene.bounds_world.min.x, low, kRounding) << mode;
    EXPECT_NEAR(scene.bounds_world.max.y, 1.0 + 0.5 * kWidth, kRounding) << mode;
    EXPECT_NEAR(scene.bounds_world.max.z, 0.5 * kWidth, kRounding) << mode;
  }
}

TEST(GltfMarks, have_the_texture_coordinates_of_their_corners_and_lines_without_length_are_none) {
  TestGltf gltf;
  const int position = gltf.positions({0, 0, 0, 0, 0, 0, 4, 0, 0});
  const int texcoord = gltf.accessor(gltf.view(std::vector<float>{1, 2, 1, 2, 3, 4}), kFloat, "VEC2", 3);
  gltf.show({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", texcoord}}}, {"mode", 3}});
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.triangle_count(), 12u) << "of the second of two lines";
  for (std::size_t v = 0; v < scene.positions.size(); ++v)
    EXPECT_EQ(scene.texcoords[v], scene.positions[v].x > 2.0f ? glm::vec2(3, 4) : glm::vec2(1, 2)) << v;
}

TEST(GltfMarks, without_a_width_have_one_by_their_extent_and_a_warning) {
  for (const int mode : {0, 1, 2, 3}) {
    const Scene scene = square_as(mode, {0, 1, 2, 3});
    ASSERT_EQ(scene.instances.size(), 1u);
    const double width = scene.bounds_world.max.z - scene.bounds_world.min.z;
    EXPECT_GT(width, 0.001) << mode;
    EXPECT_LT(width, 0.05) << mode;
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("\"markWidth\" in the extras"), std::string::npos) << scene.warnings[0];
  }
}

TEST(GltfMarks, that_have_no_extent_or_are_bent_are_skipped_and_a_broken_width_is_none) {
  for (const auto& order : {std::vector<std::uint16_t>{2}, {1, 1}}) {
    const Scene scene = square_as(order.size() == 1 ? 0 : 1, order);
    EXPECT_TRUE(scene.instances.empty());
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_NE(scene.warnings[0].find("meshes[0].primitives[0]"), std::string::npos);
  }
  TestGltf gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kSquare)}}}, {"mode", 0}});
  for (const json& width : {json("wide"), json(0), json(-1), json(1e300), json::array()}) {
    gltf.document["meshes"][0]["extras"]["markWidth"] = width;
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.triangle_count(), 32u);
    ASSERT_EQ(scene.warnings.size(), 2u) << width;
    EXPECT_EQ(scene.warnings[0].find("meshes[0].extras.markWidth: "), 0u) << scene.warnings[0];
  }
}

TEST(GltfMarks, of_a_cloud_too_large_are_refused_before_they_are_made) {
  TestGltf gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kSquare)}}}, {"mode", 0}});
  LoadLimits limits;
  limits.triangles = 31;
  EXPECT_THROW((void)gltf.load(limits), SceneError);
  limits.triangles = 32;
  EXPECT_EQ(gltf.load(limits).triangle_count(), 32u);
  limits.vertices = 24;
  EXPECT_EQ(gltf.load(limits).triangle_count(), 32u);
  limits.vertices = 23;
  EXPECT_THROW((void)gltf.load(limits), SceneError);
}

TEST(GltfGeometry, a_list_that_ends_in_a_part_triangle_keeps_the_whole_ones) {
  const Scene scene = square_as(4, {0, 1, 2, 0});
  EXPECT_EQ(scene.triangle_count(), 1u);
  EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(GltfGeometry, list_strip_and_fan_of_a_square_are_the_same_square_wound_the_same_way) {
  for (const Scene& scene :
       {square_as(4, {0, 1, 2, 0, 2, 3}), square_as(5, {0, 1, 3, 2}), square_as(6, {0, 1, 2, 3})}) {
    ASSERT_EQ(scene.triangle_count(), 2u);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(wound_normal(scene, t), glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.bounds_world.max, glm::dvec3(1, 1, 0));
  }
}

TEST(GltfGeometry, strips_lose_the_triangles_that_only_stitch_them) {
  EXPECT_EQ(square_as(5, {0, 1, 3, 2, 2, 0, 0, 1, 3}).triangle_count(), 3u);
}

TEST(GltfGeometry, vertices_without_indices_are_taken_in_order) {
  const Scene scene = one_triangle().load();
  ASSERT_EQ(scene.triangle_count(), 1u);
  EXPECT_EQ(corner(scene, 1), glm::vec3(1, 0, 0));
  EXPECT_EQ(wound_normal(scene, 0), glm::vec3(0, 0, 1));
}

TEST(GltfGeometry, indices_of_every_width_mean_the_same) {
  const auto with = [](auto number, int type) {
    using T = decltype(number);
    TestGltf gltf;
    const int position = gltf.positions(kSquare);
    const int indices = gltf.accessor(gltf.view(std::vector<T>{3, 0, 1}), type, "SCALAR", 3);
    gltf.show({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
    return gltf.load();
  };
  for (const Scene& scene : {with(std::uint8_t{0}, kUnsignedByte), with(std::uint16_t{0}, kUnsignedShort),
                             with(std::uint32_t{0}, kUnsignedInt)}) {
    ASSERT_EQ(scene.indices.size(), 3u);
    EXPECT_EQ(corner(scene, 0), glm::vec3(0, 1, 0));
    EXPECT_EQ(corner(scene, 2), glm::vec3(1, 0, 0));
  }
}

TEST(GltfGeometry, interleaved_vertices_are_read_by_their_stride_and_offset) {
  TestGltf gltf;
  // position, normal, texcoord: 32 bytes per vertex
  const int view = gltf.view(std::vector<float>{0, 0, 0, 0, 0, 1, .25f, .5f,  //
                                                2, 0, 0, 0, 0, 1, .5f,  .5f,  //
                                                0, 2, 0, 0, 0, 1, .75f, 1.f},
                             32);
  const int position = gltf.accessor(view, kFloat, "VEC3", 3);
  const int normal = gltf.accessor(view, kFloat, "VEC3", 3, {{"byteOffset", 12}});
  const int texcoord = gltf.accessor(view, kFloat, "VEC2", 3, {{"byteOffset", 24}});
  gltf.show({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", texcoord}}}});
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.positions.size(), 3u);
  EXPECT_EQ(scene.positions[1], glm::vec3(2, 0, 0));
  EXPECT_EQ(scene.normals[2], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.texcoords[2], glm::vec2(.75f, 1.f));
}

TEST(GltfGeometry, sparse_values_override_those_they_name) {
  TestGltf gltf;
  const int indices = gltf.view(std::vector<std::uint16_t>{2});
  const int values = gltf.view(std::vector<float>{0, 5, 0});
  const int position = gltf.positions(kTriangle);
  gltf.document["accessors"][static_cast<std::size_t>(position)]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
      {"values", {{"bufferView", values}}}};
  gltf.show({{"attributes", {{"POSITION", position}}}});
  const Scene scene = gltf.load();
  EXPECT_EQ(corner(scene, 1), glm::vec3(1, 0, 0));
  EXPECT_EQ(corner(scene, 2), glm::vec3(0, 5, 0));
}

TEST(GltfGeometry, sparse_indices_without_a_buffer_view_start_from_zero) {
  TestGltf gltf;
  const int position = gltf.positions(kTriangle);
  const int where = gltf.view(std::vector<std::uint8_t>{1, 2});
  const int what = gltf.view(std::vector<std::uint16_t>{1, 2});
  const int indices =
      gltf.add("accessors", {{"componentType", kUnsignedShort},
                             {"type", "SCALAR"},
                             {"count", 3},
                             {"sparse",
                              {{"count", 2},
                               {"indices", {{"bufferView", where}, {"componentType", kUnsignedByte}}},
                               {"values", {{"bufferView", what}}}}}});
  gltf.show({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  EXPECT_EQ(wound_normal(gltf.load(), 0), glm::vec3(0, 0, 1));
}

TEST(GltfGeometry, normalized_integers_are_expanded_and_plain_ones_are_not) {
  TestGltf gltf;
  // KHR_mesh_quantization: positions as plain signed shorts, texture coordinates as normalized bytes padded
  // to four.
  const int position = gltf.accessor(
      gltf.view(std::vector<std::int16_t>{0, 0, 0, 0, 300, 0, 0, 0, 0, -200, 0, 0}, 8), kShort, "VEC3", 3);
  const int texcoord =
      gltf.accessor(gltf.view(std::vector<std::uint8_t>{0, 255, 0, 0, 51, 0, 0, 0, 255, 102, 0, 0}, 4),
                    kUnsignedByte, "VEC2", 3, {{"normalized", true}});
  gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  gltf.show({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", texcoord}}}});
  const Scene scene = gltf.load();
  EXPECT_EQ(corner(scene, 1), glm::vec3(300, 0, 0));
  EXPECT_EQ(corner(scene, 2), glm::vec3(0, -200, 0));
  EXPECT_EQ(scene.texcoords[scene.indices[0]], glm::vec2(0, 1));
  EXPECT_FLOAT_EQ(scene.texcoords[scene.indices[1]].x, 0.2f);
  EXPECT_FLOAT_EQ(scene.texcoords[scene.indices[2]].y, 0.4f);
}

TEST(GltfGeometry, signed_normalized_normals_never_pass_minus_one) {
  TestGltf gltf;
  const int position = gltf.positions(kTriangle);
  const int normal =
      gltf.accessor(gltf.view(std::vector<std::int8_t>{0, 0, -128, 0, 0, 0, -127, 0, 0, 0, -64, 0}, 4), kByte,
                    "VEC3", 3, {{"normalized", true}});
  gltf.show({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
  for (const glm::vec3& n : gltf.load().normals) EXPECT_EQ(n, glm::vec3(0, 0, -1));
}

// Normals are made unit length afterwards; positions stand as they are read.
TEST(GltfGeometry, signed_normalized_positions_never_pass_minus_one) {
  TestGltf gltf;
  const std::vector<std::int8_t> bytes{-128, 0, 0, 0, 127, 0, 0, 0, 0, -127, 0, 0};
  const int position = gltf.accessor(gltf.view(bytes, 4), kByte, "VEC3", 3, {{"normalized", true}});
  gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  gltf.show({{"attributes", {{"POSITION", position}}}});
  const Scene scene = gltf.load();
  EXPECT_EQ(corner(scene, 0), glm::vec3(-1, 0, 0));
  EXPECT_EQ(corner(scene, 1), glm::vec3(1, 0, 0));
  EXPECT_EQ(corner(scene, 2), glm::vec3(0, -1, 0));
}

TEST(GltfGeometry, missing_normals_are_those_of_the_faces_with_vertices_unshared) {
  TestGltf gltf;
  const int position = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  const int indices =
      gltf.accessor(gltf.view(std::vector<std::uint16_t>{0, 1, 2, 0, 3, 1}), kUnsignedShort, "SCALAR", 6);
  gltf.show({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.positions.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(scene.normals[scene.indices[i]], glm::vec3(0, 0, 1));
  for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(scene.normals[scene.indices[i]], glm::vec3(0, 1, 0));
}

TEST(GltfGeometry, broken_normals_are_made_from_triangles_and_others_brought_to_unit_length) {
  TestGltf gltf;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const int position = gltf.positions(kTriangle);
  const int normal = gltf.positions({0, 0, 0, nan, 0, 0, 0, 3, 4});
  gltf.show({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.normals[1], glm::vec3(0, 0, 1));
  EXPECT_FLOAT_EQ(scene.normals[2].y, 0.6f);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("2 normals"), std::string::npos);
}

TEST(GltfGeometry, an_attribute_of_another_length_is_ignored_with_a_warning) {
  TestGltf gltf;
  const int position = gltf.positions(kTriangle);
  const int normal = gltf.positions({0, 0, 1});
  gltf.show({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.normals[0], glm::vec3(0, 0, 1));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("NORMAL"), std::string::npos);
}

TEST(GltfGeometry, primitives_of_the_same_vertices_share_them) {
  TestGltf gltf;
  const int position = gltf.positions(kSquare);
  const int normal = gltf.positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  json primitives = json::array();
  for (const auto& order : {std::vector<std::uint16_t>{0, 1, 2}, std::vector<std::uint16_t>{0, 2, 3}}) {
    const int indices = gltf.accessor(gltf.view(order), kUnsignedShort, "SCALAR", 3);
    primitives.push_back(
        {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", indices}});
  }
  gltf.show_node({{"mesh", gltf.add("meshes", {{"primitives", primitives}})}});
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.positions.size(), 4u);
  ASSERT_EQ(scene.primitives.size(), 2u);
  // Bounds hold the vertices used, not those stored: the first triangle's lower right half misses (0,1).
  EXPECT_EQ(scene.primitives[0].bounds.max, glm::dvec3(1, 1, 0));
  EXPECT_EQ(wound_normal(scene, 1), glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace gnomon::test
