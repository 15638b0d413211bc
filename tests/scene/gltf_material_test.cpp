// Base colour, alpha and pictures of glTF materials.
#include "gltf_text.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/translucent.hpp"
#include "image_formats.hpp"

namespace gnomon::test {
namespace {

std::vector<std::uint8_t> small_png() {
  Image image;
  image.name = "small";
  image.width = 2;
  image.height = 1;
  image.rgba = {255, 0, 0, 255, 10, 20, 30, 0};
  return encode_png(image);
}

TestGltf with_material(const json& material) {
  TestGltf gltf;
  const int position = gltf.positions(kTriangle);
  const int texcoord = gltf.accessor(gltf.view(std::vector<float>{0, 0, 1, 0, 0, 1}), kFloat, "VEC2", 3);
  gltf.add("materials", material);
  gltf.show({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", texcoord}}}, {"material", 0}});
  return gltf;
}

TestGltf with_picture(const std::vector<std::uint8_t>& bytes, json texture_info = {{"index", 0}}) {
  TestGltf gltf = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", texture_info}}}});
  gltf.add("images", {{"bufferView", gltf.view(bytes)}, {"mimeType", "image/png"}, {"name", "small"}});
  gltf.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
  gltf.add("textures", {{"source", 0}, {"sampler", 0}});
  return gltf;
}

TEST(GltfMaterial, a_primitive_without_one_gets_the_default_behind_the_files_own) {
  TestGltf gltf = with_material({{"name", "own"}});
  gltf.show({{"attributes", {{"POSITION", 0}}}});
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.primitives[0].material, 0);
  EXPECT_EQ(scene.primitives[1].material, 1);
  EXPECT_EQ(scene.materials[1].base_color, glm::vec4(1.0f));
}

TEST(GltfMaterial, colour_alpha_and_sides_are_read) {
  const Scene scene = with_material({{"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 0.75, 0.5}}}},
                                     {"alphaMode", "MASK"},
                                     {"alphaCutoff", 0.3},
                                     {"doubleSided", true}})
                          .load();
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.base_color, glm::vec4(0.25f, 0.5f, 0.75f, 0.5f));
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  EXPECT_FLOAT_EQ(material.alpha_cutoff, 0.3f);
  EXPECT_TRUE(material.double_sided);
}

TEST(GltfMaterial, transmission_is_read_and_a_broken_one_is_none_with_a_line) {
  const auto with_extension = [](const json& extension) {
    return with_material({{"extensions", {{"KHR_materials_transmission", extension}}}}).load();
  };
  EXPECT_EQ(with_material({{"name", "solid"}}).load().materials[0].transmission, 0.0f);
  EXPECT_EQ(with_extension(json::object()).materials[0].transmission, 0.0f);
  EXPECT_FLOAT_EQ(with_extension({{"transmissionFactor", 0.75}}).materials[0].transmission, 0.75f);
  for (const json& broken : {json("much"), json(-0.5), json(1.5), json(nullptr)}) {
    const Scene scene = with_extension({{"transmissionFactor", broken}});
    EXPECT_EQ(scene.materials[0].transmission, 0.0f) << broken;
    ASSERT_EQ(scene.warnings.size(), 1u) << broken;
    EXPECT_NE(scene.warnings[0].find("transmissionFactor"), std::string::npos) << scene.warnings[0];
  }
  for (const json& broken : {json("x"), json(nullptr), json::array({1})}) {
    const Scene scene = with_extension(broken);
    EXPECT_EQ(scene.materials[0].transmission, 0.0f) << broken;
    EXPECT_EQ(scene.warnings.size(), 1u) << broken;
  }
  const Scene textured =
      with_extension({{"transmissionFactor", 0.5}, {"transmissionTexture", {{"index", 0}}}});
  EXPECT_FLOAT_EQ(textured.materials[0].transmission, 0.5f);
  EXPECT_EQ(textured.warnings.size(), 1u);
}

TEST(GltfMaterial, panes_are_parted_from_the_rest) {
  TestGltf gltf = with_material({{"name", "glass"}, {"alphaMode", "BLEND"}});
  gltf.show({{"attributes", {{"POSITION", 0}}}});
  const Scene scene = gltf.load();
  const TranslucentParts parts = split_translucent(scene);
  ASSERT_EQ(scene.instances.size(), 2u);
  ASSERT_EQ(parts.opaque.instances.size(), 1u);
  ASSERT_EQ(parts.panes.instances.size(), 1u);
  EXPECT_EQ(parts.panes.instances[0].primitive, scene.instances[0].primitive);
  EXPECT_FALSE(parts.panes.bounds_world.empty());
  ASSERT_EQ(parts.pane_instances.size(), 1u);
  ASSERT_EQ(parts.opaque_instances.size(), 1u);
  EXPECT_NE(parts.pane_instances[0], parts.opaque_instances[0]);
}

TEST(GltfMaterial, each_part_has_the_bounds_of_its_own_instances) {
  TestGltf gltf = with_material({{"name", "glass"}, {"alphaMode", "BLEND"}});
  gltf.show({{"attributes", {{"POSITION", 0}}}}, {{"translation", {0, 0, -50}}});
  const TranslucentParts parts = split_translucent(gltf.load());
  EXPECT_EQ(parts.panes.bounds_world.min.z, 0.0);
  EXPECT_EQ(parts.opaque.bounds_world.max.z, -50.0);
}

TEST(GltfMaterial, each_part_gets_its_share_of_a_pose) {
  Pose pose;
  for (const std::uint32_t instance : {1u, 3u, 4u}) {
    PosedInstance posed;
    posed.instance = instance;
    posed.world_from_object[3].x = instance;
    pose.instances.push_back(posed);
  }
  pose.vertices = {{1, 0, 40, 2, {}}, {4, 2, 60, 1, {}}};
  pose.positions = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  pose.normals = {{0, 1, 0}, {0, 2, 0}, {0, 3, 0}};
  const std::vector<std::uint32_t> instances{0, 3, 4, 7};
  const Pose part = pose_of_part(pose, instances);
  ASSERT_EQ(part.instances.size(), 2u);
  EXPECT_EQ(part.instances[0].instance, 1u);
  EXPECT_EQ(part.instances[0].world_from_object[3].x, 3.0);
  EXPECT_EQ(part.instances[1].instance, 2u);
  ASSERT_EQ(part.vertices.size(), 1u);
  EXPECT_EQ(part.vertices[0].instance, 2u);
  EXPECT_EQ(part.vertices[0].first, 0u);
  EXPECT_EQ(part.vertices[0].first_vertex, 60u);
  EXPECT_EQ(part.positions, (std::vector<glm::vec3>{{3, 0, 0}}));
  EXPECT_EQ(part.normals, (std::vector<glm::vec3>{{0, 3, 0}}));
  EXPECT_TRUE(pose_of_part(pose, {}).instances.empty());
}

TEST(GltfMaterial, what_passes_is_what_alpha_leaves_and_the_coloured_share_of_the_rest) {
  Material material;
  material.transmission = 0.5f;
  EXPECT_EQ(transmittance(material, {1.0f, 0.5f, 0.0f, 0.2f}), glm::vec3(0.5f, 0.25f, 0.0f));
  material.alpha_mode = AlphaMode::blend;
  EXPECT_EQ(transmittance(material, {1.0f, 0.5f, 0.0f, 0.5f}), glm::vec3(0.75f, 0.625f, 0.5f));
  material.alpha_mode = AlphaMode::mask;
  EXPECT_EQ(transmittance(material, {1.0f, 0.5f, 0.0f, 0.25f}), glm::vec3(1.0f));
  EXPECT_EQ(transmittance(material, {1.0f, 0.5f, 0.0f, 0.75f}), glm::vec3(0.5f, 0.25f, 0.0f));
}

TEST(GltfMaterial, an_embedded_picture_arrives_with_its_wrapping_and_unmultiplied_colour) {
  const Scene scene = with_picture(small_png()).load();
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 10, 20, 30, 0}));
  EXPECT_EQ(scene.materials[0].base_color_image, 0);
  EXPECT_EQ(scene.materials[0].wrap_u, TextureWrap::clamp_to_edge);
  EXPECT_EQ(scene.materials[0].wrap_v, TextureWrap::mirrored_repeat);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterial, a_picture_that_does_not_decode_is_a_warning_and_white) {
  std::vector<std::uint8_t> cut = small_png();
  cut.resize(cut.size() / 2);
  for (const auto& bytes : {cut, std::vector<std::uint8_t>{'n', 'o', 'n', 'e'}}) {
    const Scene scene = with_picture(bytes).load();
    EXPECT_EQ(scene.materials[0].base_color_image, -1);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("images[0]"), std::string::npos);
  }
}

TEST(GltfMaterial, a_picture_above_the_budget_is_a_warning_and_white) {
  LoadLimits limits;
  limits.pixels = 1;
  const Scene scene = with_picture(small_png()).load(limits);
  EXPECT_TRUE(scene.images.empty());
  EXPECT_EQ(scene.warnings.size(), 1u);
}

/// Adds a material with a picture of its own.
void add_picture(TestGltf& gltf, int view) {
  const int image = gltf.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
  const int texture = gltf.add("textures", {{"source", image}});
  gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
}

TEST(GltfMaterial, pictures_share_one_budget) {
  TestGltf gltf = with_picture(small_png());
  add_picture(gltf, gltf.view(small_png()));
  LoadLimits limits;
  limits.pixels = 4;
  EXPECT_EQ(gltf.load(limits).images.size(), 2u);
  limits.pixels = 3;
  const Scene scene = gltf.load(limits);
  EXPECT_EQ(scene.images.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("images[1]"), std::string::npos) << scene.warnings[0];
}

TEST(GltfMaterial, pictures_are_not_tried_after_many_that_failed) {
  for (const int broken : {63, 64}) {
    TestGltf gltf = with_material({{"name", "plain"}});
    const int none = gltf.view(std::vector<std::uint8_t>{'n', 'o', 'n', 'e'});
    for (int i = 0; i < broken; ++i) add_picture(gltf, none);
    add_picture(gltf, gltf.view(small_png()));
    EXPECT_EQ(gltf.load().images.size(), broken == 63 ? 1u : 0u) << broken;
  }
}

TEST(GltfMaterial, a_texture_transform_moves_the_texture_coordinates) {
  const json transform = {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}};
  const Scene scene =
      with_picture(small_png(), {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}})
          .load();
  EXPECT_EQ(scene.texcoords[scene.indices[0]], glm::vec2(0.5f, 0.25f));
  EXPECT_EQ(scene.texcoords[scene.indices[1]], glm::vec2(2.5f, 0.25f));
  EXPECT_EQ(scene.texcoords[scene.indices[2]], glm::vec2(0.5f, 4.25f));
}

TEST(GltfMaterial, a_broken_texture_transform_is_named_by_its_field_and_the_rest_counts) {
  const std::string where = "materials[0].pbrMetallicRoughness.baseColorTexture.KHR_texture_transform";
  const json good = {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}, {"rotation", 0.0}, {"texCoord", 0}};
  const auto load = [](const json& transform) {
    return with_picture(small_png(), {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}})
        .load();
  };
  EXPECT_TRUE(load(good).warnings.empty());
  for (const auto& [key, value] : {std::pair{"offset", json("x")},
                                   {"offset", json{1}},
                                   {"scale", json{1, "x"}},
                                   {"rotation", json::array()},
                                   {"texCoord", json(-1)}}) {
    json broken = good;
    broken[key] = value;
    const Scene scene = load(broken);
    ASSERT_EQ(scene.warnings.size(), 1u) << key;
    EXPECT_EQ(scene.warnings[0].find(where + "." + key + ": is not "), 0u) << scene.warnings[0];
    const bool moved = std::string(key) != "offset";
    EXPECT_EQ(scene.texcoords[scene.indices[0]], moved ? glm::vec2(0.5f, 0.25f) : glm::vec2(0.0f)) << key;
  }
  EXPECT_EQ(load(7).warnings.at(0), where + ": is no object, and does not count");
}

TEST(GltfMaterial, an_alpha_mode_or_a_wrap_that_is_not_known_is_a_warning) {
  EXPECT_EQ(with_material({{"alphaMode", "CUTOUT"}}).load().warnings.at(0),
            "materials[0].alphaMode: 'CUTOUT' is none of OPAQUE, MASK and BLEND, shown opaque");
  TestGltf gltf = with_picture(small_png());
  gltf.document["samplers"] = {{{"wrapS", 5}, {"wrapT", 10497}}};
  gltf.document["textures"][0]["sampler"] = 0;
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "samplers[0].wrapS: 5 is no way to wrap, the picture repeats");
}

TEST(GltfExtensions, that_are_used_and_not_read_are_one_line_with_their_count) {
  TestGltf gltf = one_triangle();
  EXPECT_TRUE(gltf.load().warnings.empty());
  gltf.document["extensionsUsed"] = {"VENDOR_magic", "KHR_materials_variants", "KHR_materials_ior",
                                     "KHR_node_visibility", "KHR_animation_pointer"};
  gltf.document["nodes"][0]["extensions"] = {{"VENDOR_magic", {{"extensions", {{"VENDOR_magic", 1}}}}},
                                             {"KHR_node_visibility", json::object()}};
  gltf.document["materials"] = {{{"extensions", {{"KHR_materials_ior", {{"ior", 1.3}}}}}}};
  gltf.document["extensions"]["KHR_materials_variants"] = json::object();
  EXPECT_EQ(
      gltf.load().warnings,
      (std::vector<std::string>{
          "extensionsUsed: KHR_materials_variants is not supported, what it says does not count (1 place)",
          "extensionsUsed: VENDOR_magic is not supported, what it says does not count (2 places)"}));
}

TEST(GltfWarnings, of_a_file_without_triangles_say_so_beside_all_else) {
  TestGltf gltf = one_triangle();
  gltf.document["scenes"][0]["nodes"] = json::array();
  gltf.document["extensionsUsed"] = {"VENDOR_magic"};
  gltf.document["extensions"]["VENDOR_magic"] = json::object();
  const std::vector<std::string> warnings = gltf.load().warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[1], "scene: has no triangles, and shows nothing");
}

TEST(GltfWarnings, that_say_the_same_of_many_elements_are_counted_from_the_fourth_on) {
  TestGltf gltf = one_triangle();
  for (int i = 0; i < 300; ++i) gltf.show_node({{"camera", 7}});
  const Scene scene = gltf.load();
  ASSERT_EQ(scene.warnings.size(), 4u);
  EXPECT_EQ(scene.warnings[2].find("nodes[3].camera: "), 0u) << scene.warnings[2];
  EXPECT_EQ(scene.warnings[3], "and 297 more: names cameras[7], there are 0, skipped");
}

TEST(GltfMaterial, a_quarter_turn_of_a_texture_turns_as_the_specification_says) {
  // KHR_texture_transform: u' = cos u + sin v, v' = -sin u + cos v for rotation r.
  const json transform = {{"rotation", 1.5707963267948966}};
  const Scene scene =
      with_picture(small_png(), {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}})
          .load();
  EXPECT_NEAR(scene.texcoords[scene.indices[1]].y, -1.0f, 1e-6f);
  EXPECT_NEAR(scene.texcoords[scene.indices[2]].x, 1.0f, 1e-6f);
}

TEST(GltfMaterial, specular_glossiness_is_read_as_base_colour) {
  const Scene scene =
      with_material(
          {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {1, 0, 0, 1}}}}}}})
          .load();
  EXPECT_EQ(scene.materials[0].base_color, glm::vec4(1, 0, 0, 1));
}

TEST(GltfMaterial, a_texture_with_a_webp_source_takes_it_where_the_build_reads_it) {
  TestGltf gltf = with_picture(small_png());
  gltf.document["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
  gltf.document["extensionsUsed"] = {"EXT_texture_webp"};
  const Scene scene = gltf.load();
  // The picture is a PNG under that name, which the reader goes by.
  EXPECT_EQ(scene.materials[0].base_color_image, detail::reads_webp() ? 0 : -1);
  EXPECT_EQ(scene.warnings.size(), detail::reads_webp() ? 0u : 2u);
}

TEST(GltfMaterial, a_texture_without_any_source_is_a_warning_and_white) {
  TestGltf gltf = with_picture(small_png());
  gltf.document["textures"][0] = json::object();
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.materials[0].base_color_image, -1);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("textures[0]"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
