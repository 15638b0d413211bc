// What a hostile or mistaken glTF file is told: one line with the element that is wrong.
#include <functional>

#include "gltf_text.hpp"

namespace gnomon::test {
namespace {

std::string refusal_of_bytes(const std::string& bytes) {
  try {
    (void)detail::load_gltf_bytes({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "test",
                                  "test", {}, {});
    return "";
  } catch (const SceneError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
}

void expect_refused(const std::string& message, const std::string& element) {
  EXPECT_NE(message.find(element), std::string::npos) << "said: '" << message << "'";
  EXPECT_TRUE(message.starts_with("test: ")) << message;
}

// A triangle edited into something wrong, and the element the message must name.
struct Case {
  const char* name;
  std::function<void(TestGltf&)> edit;
  const char* element;
};

class Refusal : public ::testing::TestWithParam<Case> {};

TEST(RefusalBase, the_triangle_that_the_cases_edit_loads) {
  EXPECT_EQ(refusal_of(one_triangle()), "");
}

TEST_P(Refusal, names_the_element) {
  TestGltf gltf = one_triangle();
  GetParam().edit(gltf);
  expect_refused(refusal_of(gltf), GetParam().element);
}

json& accessor(TestGltf& g) {
  return g.document["accessors"][0];
}
json& view(TestGltf& g) {
  return g.document["bufferViews"][0];
}

INSTANTIATE_TEST_SUITE_P(
    Structure, Refusal,
    ::testing::Values(
        Case{"no_asset", [](TestGltf& g) { g.document.erase("asset"); }, "asset"},
        Case{"version_1", [](TestGltf& g) { g.document["asset"]["version"] = "1.0"; }, "asset.version"},
        Case{"version_number", [](TestGltf& g) { g.document["asset"]["version"] = 2; }, "asset.version"},
        Case{"min_version", [](TestGltf& g) { g.document["asset"]["minVersion"] = "2.1"; },
             "asset.minVersion"},
        Case{"nodes_object",
             [](TestGltf& g) {
               g.document["nodes"] = {{"a", 1}};
             },
             "nodes: must be a list"},
        Case{"node_number", [](TestGltf& g) { g.document["nodes"][0] = 3; }, "nodes[0]"},
        Case{"mesh_missing", [](TestGltf& g) { g.document["nodes"][0]["mesh"] = 1; }, "nodes[0].mesh"},
        Case{"mesh_negative", [](TestGltf& g) { g.document["nodes"][0]["mesh"] = -1; }, "nodes[0].mesh"},
        Case{"mesh_fraction", [](TestGltf& g) { g.document["nodes"][0]["mesh"] = 0.5; }, "nodes[0].mesh"},
        Case{"mesh_string", [](TestGltf& g) { g.document["nodes"][0]["mesh"] = "0"; }, "nodes[0].mesh"},
        Case{"skin_missing", [](TestGltf& g) { g.document["nodes"][0]["skin"] = 0; }, "nodes[0].skin"},
        Case{"short_matrix",
             [](TestGltf& g) {
               g.document["nodes"][0]["matrix"] = {1, 0, 0};
             },
             "nodes[0].matrix"},
        Case{"huge_scale",
             [](TestGltf& g) {
               g.document["nodes"][0]["scale"] = {1e308, 1e308, 1e308};
               g.add("nodes", {{"scale", {1e308, 1, 1}}, {"children", {0}}});
             },
             "nodes[0]: its transform is not finite"},
        Case{"self_child", [](TestGltf& g) { g.document["nodes"][0]["children"] = {0}; },
             "nodes[0]: is its own ancestor"},
        Case{"two_parents",
             [](TestGltf& g) {
               g.add("nodes", {{"children", {0}}});
               g.add("nodes", {{"children", {0}}});
             },
             "nodes[0]: is a child of both"},
        Case{"scene_index", [](TestGltf& g) { g.document["scene"] = 5; }, "scene: names scenes[5]"},
        Case{"scene_node", [](TestGltf& g) { g.document["scenes"][0]["nodes"] = {9}; },
             "scenes[0].nodes[0]: names nodes[9]"},
        Case{"mode", [](TestGltf& g) { g.document["meshes"][0]["primitives"][0]["mode"] = 7; },
             "primitives[0].mode"},
        Case{"attribute_index",
             [](TestGltf& g) { g.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 8; },
             "attributes.POSITION"},
        Case{"material_index", [](TestGltf& g) { g.document["meshes"][0]["primitives"][0]["material"] = 0; },
             "primitives[0].material"},
        Case{"image_view",
             [](TestGltf& g) {
               g.add("images", {{"bufferView", 77}});
             },
             "images[0].bufferView"},
        Case{"unknown_extension", [](TestGltf& g) { g.document["extensionsRequired"] = {"ACME_voxels"}; },
             "ACME_voxels"},
        Case{"basisu_required",
             [](TestGltf& g) { g.document["extensionsRequired"] = {"KHR_texture_basisu"}; },
             "'KHR_texture_basisu' is not supported: convert its KTX2 pictures to PNG, JPEG or WebP"}),
    [](const auto& param) { return param.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Data, Refusal,
    ::testing::Values(
        Case{"view_too_long", [](TestGltf& g) { view(g)["byteLength"] = 37; }, "bufferViews[0]"},
        Case{"view_offset_wraps", [](TestGltf& g) { view(g)["byteOffset"] = (1ull << 53); },
             "bufferViews[0]"},
        Case{"view_without_buffer", [](TestGltf& g) { view(g)["buffer"] = 1; }, "bufferViews[0].buffer"},
        Case{"stride_overlaps", [](TestGltf& g) { view(g)["byteStride"] = 4; }, "accessors[0]"},
        Case{"stride_too_long", [](TestGltf& g) { view(g)["byteStride"] = 16; }, "accessors[0]"},
        Case{"stride_huge", [](TestGltf& g) { view(g)["byteStride"] = 0x7fffffff; }, "bufferViews[0]"},
        Case{"stride_odd", [](TestGltf& g) { view(g)["byteStride"] = 13; }, "bufferViews[0]"},
        Case{"count_one_more", [](TestGltf& g) { accessor(g)["count"] = 4; }, "accessors[0]"},
        Case{"count_2_62", [](TestGltf& g) { accessor(g)["count"] = 1ull << 62; }, "accessors[0].count"},
        Case{"count_2_53", [](TestGltf& g) { accessor(g)["count"] = 1ull << 53; }, "accessors[0]"},
        Case{"count_without_view",
             [](TestGltf& g) {
               accessor(g)["count"] = 1ull << 40;
               accessor(g).erase("bufferView");
             },
             "accessors[0]"},
        Case{"offset_beyond", [](TestGltf& g) { accessor(g)["byteOffset"] = 4; }, "accessors[0]"},
        Case{"wrong_shape", [](TestGltf& g) { accessor(g)["type"] = "VEC2"; }, "accessors[0]"},
        Case{"no_component", [](TestGltf& g) { accessor(g)["componentType"] = 0; },
             "accessors[0].componentType: 0 is none of 5120"},
        Case{"unknown_shape", [](TestGltf& g) { accessor(g)["type"] = "VEC9"; },
             "accessors[0].type: 'VEC9' is none of SCALAR"},
        Case{"unknown_component", [](TestGltf& g) { accessor(g)["componentType"] = 5124; }, "accessors[0]"},
        Case{"sparse_too_many",
             [](TestGltf& g) {
               accessor(g)["sparse"] = {{"count", 4},
                                        {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", 0}}}};
             },
             "accessors[0].sparse"},
        Case{"sparse_index_beyond",
             [](TestGltf& g) {
               const int where = g.view(std::vector<std::uint16_t>{3});
               accessor(g)["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 0}}}};
             },
             "accessors[0].sparse.indices"},
        Case{"sparse_values_short",
             [](TestGltf& g) {
               const int where = g.view(std::vector<std::uint16_t>{0, 1});
               accessor(g)["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", where}}}};
             },
             "accessors[0].sparse.values"},
        Case{"index_beyond",
             [](TestGltf& g) {
               const int v = g.view(std::vector<std::uint16_t>{0, 1, 3});
               g.document["meshes"][0]["primitives"][0]["indices"] = g.accessor(v, 5123, "SCALAR", 3);
             },
             "meshes[0].primitives[0]: index 3"},
        Case{"float_indices",
             [](TestGltf& g) {
               const int v = g.view(std::vector<float>{0, 1, 2});
               g.document["meshes"][0]["primitives"][0]["indices"] = g.accessor(v, 5126, "SCALAR", 3);
             },
             "accessors[1]"},
        Case{"infinite_position",
             [](TestGltf& g) {
               g.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
                   g.positions({0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 0, 1, 0});
             },
             "position 1 is not finite"}),
    [](const auto& param) { return param.param.name; });

TEST(GltfRefusal, limits_on_triangles_vertices_and_nodes_count_every_instance) {
  TestGltf gltf = one_triangle();
  for (int i = 0; i < 9; ++i) gltf.show_node({{"mesh", 0}});
  LoadLimits limits;
  limits.triangles = 10;
  limits.vertices = 3;  // as many flat ones as were read are stored in their place
  limits.nodes = 10;
  EXPECT_EQ(refusal_of(gltf, limits), "");
  LoadLimits fewer = limits;
  fewer.triangles = 9;
  expect_refused(refusal_of(gltf, fewer), "scene: 10 triangles, up to 0 MiB, are above the limit of 9");
  fewer = limits;
  fewer.vertices = 2;
  expect_refused(refusal_of(gltf, fewer), "accessors[0]");
  fewer = limits;
  fewer.nodes = 9;
  expect_refused(refusal_of(gltf, fewer), "nodes");
}

TEST(GltfRefusal, strips_and_fans_count_as_the_triangles_they_stand_for) {
  for (const int mode : {5, 6}) {
    TestGltf gltf;
    const int corners = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    gltf.show({{"attributes", {{"POSITION", corners}}}, {"mode", mode}});
    LoadLimits limits;
    limits.triangles = 2;
    EXPECT_EQ(refusal_of(gltf, limits), "") << "mode " << mode;
    limits.triangles = 1;
    expect_refused(refusal_of(gltf, limits), "scene: 2 triangles");
  }
}

TEST(GltfRefusal, the_stated_memory_counts_a_mesh_once_but_for_each_node_that_bends_it) {
  constexpr std::size_t kTriangles = 10'000;  // 108 bytes each: a little above 1 MiB
  TestGltf gltf;
  const int corners = gltf.positions(std::vector<float>(kTriangles * 9));
  gltf.show({{"attributes", {{"POSITION", corners}}}});
  for (int i = 0; i < 3; ++i) gltf.show_node({{"mesh", 0}});
  gltf.add("skins", {{"joints", {0}}});
  LoadLimits limits;
  limits.triangles = 1;
  expect_refused(refusal_of(gltf, limits), "40000 triangles, up to 1 MiB");
  for (json& node : gltf.document["nodes"]) node["skin"] = 0;
  expect_refused(refusal_of(gltf, limits), "40000 triangles, up to 4 MiB");
}

TEST(GltfRefusal, text_that_is_not_json_or_not_an_object_is_refused) {
  expect_refused(refusal_of_bytes(""), "JSON");
  expect_refused(refusal_of_bytes("   \n"), "JSON");
  expect_refused(refusal_of_bytes("{\"asset\":"), "JSON");
  expect_refused(refusal_of_bytes("[1,2]"), "JSON: must be an object");
  expect_refused(refusal_of_bytes("{\"asset\":{\"version\":\"2.0\"},\"x\":1e999}"), "JSON");
  expect_refused(refusal_of_bytes("{\"asset\":{\"version\":\"\xff\"}}"), "JSON");
}

TEST(GltfRefusal, json_nested_too_deep_is_refused_before_it_is_parsed) {
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  expect_refused(refusal_of_bytes("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep + "}"), "nested");
  // Brackets in strings nest nothing.
  EXPECT_EQ(refusal_of_bytes("{\"asset\":{\"version\":\"2.0\",\"copyright\":\"\\\"" + std::string(1000, '[') +
                             "\"}}"),
            "");
}

TEST(GltfRefusal, a_binary_file_is_refused_at_every_length_it_can_be_cut_to) {
  const std::string whole = one_triangle().file();
  EXPECT_EQ(refusal_of_bytes(whole), "");
  for (std::size_t size = 4; size < whole.size(); ++size) {
    EXPECT_NE(refusal_of_bytes(whole.substr(0, size)), "") << size;
  }
}

TEST(GltfRefusal, lying_lengths_in_the_binary_header_are_refused) {
  const std::string whole = one_triangle().file();
  for (const std::size_t at : {8u, 12u}) {  // of the file, of the JSON chunk
    for (const std::uint32_t lie : {0u, 3u, 0x7fffffffu, 0xfffffffcu, 0xffffffffu}) {
      std::string bytes = whole, number;
      append_number(number, lie);
      bytes.replace(at, 4, number);
      EXPECT_NE(refusal_of_bytes(bytes), "") << at << " " << lie;
    }
  }
}

TEST(GltfRefusal, an_empty_binary_chunk_is_no_data_and_no_crash) {
  std::string text = "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":4}]}";
  std::string file = glb(text, "1234");
  file.resize(file.size() - 12);
  append_number(file, 0);
  file += std::string("BIN\0", 4);
  std::string length;
  append_number(length, static_cast<std::uint32_t>(file.size()));
  file.replace(8, 4, length);
  expect_refused(refusal_of_bytes(file), "buffers[0]");
}

TEST(GltfRefusal, any_one_byte_changed_loads_or_is_refused) {
  const std::string whole = one_triangle().file();
  std::size_t refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char value : {'\0', '\xff', '9', '"', '['}) {
      std::string bytes = whole;
      bytes[at] = value;
      refused += refusal_of_bytes(bytes).empty() ? 0u : 1u;
    }
  }
  EXPECT_GT(refused, whole.size());
}

TEST(GltfRefusal, names_from_the_file_cannot_break_the_line) {
  TestGltf gltf = one_triangle();
  gltf.document["extensionsRequired"] = {"A\nB\x1b[31m"};
  expect_refused(refusal_of(gltf), "A B");
}

}  // namespace
}  // namespace gnomon::test
