// Scenes compressed with Draco and meshopt: the same triangles as plain ones, and damaged data refused.
#ifdef GNOMON_HAS_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef GNOMON_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include "gltf_text.hpp"

namespace gnomon::test {
namespace {

constexpr int kSide = 8;  // quads along a side of the bumpy sheet below

/// Vertices of a sheet of quads, bumpy enough that a wrong decoding shows.
std::vector<float> sheet_positions() {
  std::vector<float> out;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x)
      out.insert(out.end(), {static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y % 5)});
  }
  return out;
}

std::vector<std::uint32_t> sheet_indices() {
  std::vector<std::uint32_t> out;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 1, d = c + 1;
      out.insert(out.end(), {a, b, d, a, d, c});
    }
  }
  return out;
}

double area_of(const Scene& scene) {
  double area = 0.0;
  for (std::size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    const glm::vec3 a = scene.positions[scene.indices[i]];
    area += 0.5 * static_cast<double>(glm::length(glm::cross(scene.positions[scene.indices[i + 1]] - a,
                                                             scene.positions[scene.indices[i + 2]] - a)));
  }
  return area;
}

Scene plain_sheet() {
  TestGltf gltf;
  const std::vector<std::uint32_t> indices = sheet_indices();
  gltf.show({{"attributes", {{"POSITION", gltf.positions(sheet_positions())}}},
             {"indices", gltf.accessor(gltf.view(indices), kUnsignedInt, "SCALAR", indices.size())}});
  return gltf.load();
}

/// The same triangles, wherever their vertices stand in the list.
void expect_sheet(const TestGltf& gltf, double tolerance) {
  const Scene plain = plain_sheet(), scene = gltf.load();
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  EXPECT_EQ(scene.triangle_count(), plain.triangle_count());
  EXPECT_NEAR(area_of(scene), area_of(plain), tolerance * area_of(plain));
  const Box box = scene.primitives.at(0).bounds, expected = plain.primitives.at(0).bounds;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min[axis], expected.min[axis], tolerance);
    EXPECT_NEAR(box.max[axis], expected.max[axis], tolerance);
  }
}

/// Refuses with one line that names `where`, or loads: never anything else.
void expect_refused_or_whole(const TestGltf& gltf, std::size_t& refused) {
  const std::string why = refusal_of(gltf);
  if (!why.empty()) ++refused;
}

#ifndef GNOMON_HAS_DRACO

TEST(GltfDraco, compressed_data_without_a_fallback_is_skipped_when_not_required) {
  TestGltf gltf = one_triangle();
  gltf.show(
      {{"attributes",
        {{"POSITION", gltf.add("accessors", {{"componentType", kFloat}, {"type", "VEC3"}, {"count", 3}})}}},
       {"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", 0}}}}}});
  gltf.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  const Scene scene = gltf.load();
  EXPECT_EQ(scene.triangle_count(), 1u);
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_NE(scene.warnings[1].find("Draco"), std::string::npos);
}

#else

struct DracoSheet {
  TestGltf gltf;
  int view = 0;

  explicit DracoSheet(bool sequential = false) {
    const std::vector<float> positions = sheet_positions();
    const std::vector<std::uint32_t> indices = sheet_indices();
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(indices.size() / 3));
    const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::uint32_t f = 0; f < indices.size() / 3; ++f) {
      builder.SetAttributeValuesForFace(id, draco::FaceIndex(f), &positions[indices[3 * f] * 3],
                                        &positions[indices[3 * f + 1] * 3],
                                        &positions[indices[3 * f + 2] * 3]);
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                         : draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer out;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &out).ok());
    view = gltf.view(std::vector<char>(out.data(), out.data() + out.size()));
    const std::size_t vertices = mesh->num_points();
    const json extension = {{"bufferView", view},
                            {"attributes", {{"POSITION", mesh->attribute(0)->unique_id()}}}};
    const int position =
        gltf.add("accessors", {{"componentType", kFloat}, {"type", "VEC3"}, {"count", vertices}});
    const int corners = gltf.add(
        "accessors", {{"componentType", kUnsignedInt}, {"type", "SCALAR"}, {"count", indices.size()}});
    gltf.show({{"attributes", {{"POSITION", position}}},
               {"indices", corners},
               {"extensions", {{"KHR_draco_mesh_compression", extension}}}});
    gltf.document["extensionsRequired"] = gltf.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  }
  json& primitive() { return gltf.document["meshes"][0]["primitives"][0]; }
  json& extension() { return primitive()["extensions"]["KHR_draco_mesh_compression"]; }
};

TEST(GltfDraco, decodes_the_triangles_of_both_encodings) {
  expect_sheet(DracoSheet(false).gltf, 1e-3);
  expect_sheet(DracoSheet(true).gltf, 1e-3);
}

TEST(GltfDraco, decodes_data_that_two_primitives_share_once) {
  DracoSheet sheet;
  LoadLimits limits;
  limits.total_bytes = sheet.gltf.bytes.size() + 1536 + 972 + 100;  // file, 384 indices, 81 vertices
  const json again = sheet.primitive();
  sheet.gltf.show(again);
  EXPECT_EQ(sheet.gltf.load(limits).triangle_count(), 4u * kSide * kSide);
}

TEST(GltfDraco, refuses_what_is_above_a_limit_before_decoding) {
  DracoSheet sheet;
  LoadLimits few;
  few.vertices = 80;
  EXPECT_NE(refusal_of(sheet.gltf, few).find("above the limits of 80"), std::string::npos);
  few = {};
  few.triangles = 127;
  EXPECT_NE(refusal_of(sheet.gltf, few).find("above the limits"), std::string::npos);
  few = {};
  few.total_bytes = sheet.gltf.bytes.size() + 1000;
  EXPECT_NE(refusal_of(sheet.gltf, few).find("decoded data above"), std::string::npos);
  // Edgebreaker's counts stand behind the header: vertices, then faces, as LEB128 numbers.
  const std::size_t begin = sheet.gltf.document["bufferViews"][0]["byteOffset"];
  sheet.gltf.bytes[begin + 12] = '\x7f';
  EXPECT_NE(refusal_of(sheet.gltf).find("its Draco data have"), std::string::npos) << refusal_of(sheet.gltf);
}

TEST(GltfDraco, refuses_promises_that_the_data_do_not_keep) {
  const auto refusal = [](void (*spoil)(DracoSheet&)) {
    DracoSheet sheet;
    spoil(sheet);
    return refusal_of(sheet.gltf);
  };
  for (const auto& [spoil, why] : std::vector<std::pair<void (*)(DracoSheet&), const char*>>{
           {[](DracoSheet& s) { s.gltf.document["accessors"][1]["count"] = 381; },
            "the accessors 381 indices"},
           {[](DracoSheet& s) { s.gltf.document["accessors"][0]["count"] = 82; }, "the accessors 82"},
           {[](DracoSheet& s) { s.gltf.document["accessors"][0]["type"] = "VEC2"; }, "do not make a VEC2"},
           {[](DracoSheet& s) { s.extension()["attributes"]["POSITION"] = 9; }, "no attribute 9"},
           {[](DracoSheet& s) { s.extension()["attributes"] = json::object(); }, "no POSITION"},
           {[](DracoSheet& s) { s.extension()["bufferView"] = 7; }, "names bufferViews[7]"},
           {[](DracoSheet& s) { s.extension().erase("attributes"); }, "has no attributes"},
           {[](DracoSheet& s) { s.primitive()["mode"] = 5; }, "is not a list of triangles"},
           {[](DracoSheet& s) { s.primitive().erase("indices"); }, "has no indices"},
           {[](DracoSheet& s) { s.gltf.document["bufferViews"][0]["byteLength"] = 11; }, "not Draco's"},
           {[](DracoSheet& s) { s.gltf.bytes[6] = 1; }, "bitstream 2.1"},
           {[](DracoSheet& s) { s.gltf.bytes[10] = '\x80'; }, "metadata"}}) {
    EXPECT_NE(refusal(spoil).find(why), std::string::npos) << why << ": " << refusal(spoil);
    EXPECT_NE(refusal(spoil).find("meshes[0].primitives[0]"), std::string::npos) << refusal(spoil);
  }
}

TEST(GltfDraco, any_single_damaged_byte_is_refused_or_harmless) {
  std::size_t refused = 0;
  const DracoSheet whole;
  for (std::size_t at = 0; at < whole.gltf.bytes.size(); ++at) {
    for (const char value : {'\0', '\xff', '\x01'}) {
      TestGltf damaged = whole.gltf;
      damaged.bytes[at] = value;
      expect_refused_or_whole(damaged, refused);
    }
  }
  EXPECT_GT(refused, 20u);
  for (std::size_t size = 1; size < whole.gltf.bytes.size(); size += 3) {
    TestGltf cut = whole.gltf;
    cut.document["bufferViews"][0]["byteLength"] = size;
    EXPECT_NE(refusal_of(cut), "") << size;
  }
}

#endif
#ifdef GNOMON_HAS_MESHOPTIMIZER

struct MeshoptSheet {
  TestGltf gltf;

  MeshoptSheet() {
    const std::vector<float> positions = sheet_positions();
    const std::vector<std::uint32_t> indices = sheet_indices();
    const std::size_t vertices = positions.size() / 3;
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(vertices, 12));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions.data(), vertices, 12));
    const int points = compressed(packed, "ATTRIBUTES", 12, vertices);
    std::vector<unsigned char> triangles(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    triangles.resize(
        meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), indices.size()));
    const int corners = compressed(triangles, "TRIANGLES", 4, indices.size());
    gltf.show({{"attributes", {{"POSITION", gltf.accessor(points, kFloat, "VEC3", vertices)}}},
               {"indices", gltf.accessor(corners, kUnsignedInt, "SCALAR", indices.size())}});
    gltf.document["extensionsRequired"] = gltf.document["extensionsUsed"] = {"EXT_meshopt_compression"};
  }
  /// A view whose plain bytes would lie in a second buffer that is not there.
  int compressed(const std::vector<unsigned char>& packed, const char* mode, std::size_t stride,
                 std::size_t count) {
    const int view = gltf.view(packed);
    json& v = gltf.document["bufferViews"][static_cast<std::size_t>(view)];
    const json extension = {{"buffer", 0},
                            {"byteOffset", v["byteOffset"]},
                            {"byteLength", packed.size()},
                            {"byteStride", stride},
                            {"count", count},
                            {"mode", mode}};
    v = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", stride * count}};
    v["extensions"]["EXT_meshopt_compression"] = extension;
    return view;
  }
  json& extension(std::size_t view) {
    return gltf.document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
  }
  [[nodiscard]] Scene load(const LoadLimits& limits = {}) const {
    json with_buffers = gltf.document;
    with_buffers["buffers"] = {
        {{"byteLength", gltf.bytes.size()}},
        {{"byteLength", 100000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    const std::string text = glb(with_buffers.dump(), gltf.bytes);
    return detail::load_gltf_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "test",
                                   "test", {}, limits);
  }
  [[nodiscard]] std::string refusal(const LoadLimits& limits = {}) const {
    try {
      (void)load(limits);
      return "";
    } catch (const SceneError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      return e.what();
    }
  }
};

TEST(GltfMeshopt, decodes_vertices_and_triangles_to_the_same_bits) {
  const Scene plain = plain_sheet(), scene = MeshoptSheet().load();
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  EXPECT_EQ(area_of(scene), area_of(plain));
  EXPECT_EQ(scene.triangle_count(), plain.triangle_count());
}

TEST(GltfMeshopt, decodes_a_sequence_of_indices) {
  MeshoptSheet sheet;
  const std::vector<std::uint32_t> indices = sheet_indices();
  std::vector<unsigned char> packed(meshopt_encodeIndexSequenceBound(indices.size(), 81));
  packed.resize(meshopt_encodeIndexSequence(packed.data(), packed.size(), indices.data(), indices.size()));
  const int view = sheet.compressed(packed, "INDICES", 4, indices.size());
  sheet.gltf.document["accessors"][1]["bufferView"] = view;
  EXPECT_EQ(area_of(sheet.load()), area_of(plain_sheet()));
}

TEST(GltfMeshopt, applies_the_exponential_filter) {
  MeshoptSheet sheet;
  const std::vector<float> positions = sheet_positions();
  std::vector<float> filtered(positions.size());
  meshopt_encodeFilterExp(filtered.data(), positions.size() / 3, 12, 15, positions.data());
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(positions.size() / 3, 12));
  packed.resize(
      meshopt_encodeVertexBuffer(packed.data(), packed.size(), filtered.data(), positions.size() / 3, 12));
  const int view = sheet.compressed(packed, "ATTRIBUTES", 12, positions.size() / 3);
  sheet.extension(static_cast<std::size_t>(view))["filter"] = "EXPONENTIAL";
  sheet.gltf.document["accessors"][0]["bufferView"] = view;
  EXPECT_NEAR(area_of(sheet.load()), area_of(plain_sheet()), 1e-2);
}

TEST(GltfMeshopt, refuses_layouts_limits_and_damage_by_name) {
  const auto refusal = [](void (*spoil)(MeshoptSheet&)) {
    MeshoptSheet sheet;
    spoil(sheet);
    return sheet.refusal();
  };
  for (const auto& [spoil, why] : std::vector<std::pair<void (*)(MeshoptSheet&), const char*>>{
           {[](MeshoptSheet& s) { s.extension(0)["mode"] = "POINTS"; }, "is not ATTRIBUTES"},
           {[](MeshoptSheet& s) { s.extension(0)["byteStride"] = 10; }, "10 does not fit mode"},
           {[](MeshoptSheet& s) { s.extension(0)["byteStride"] = 260; }, "260 does not fit mode"},
           {[](MeshoptSheet& s) { s.extension(0)["byteStride"] = 0; }, "0 does not fit mode"},
           {[](MeshoptSheet& s) { s.extension(0)["filter"] = "OCTAHEDRAL"; }, "does not fit mode and stride"},
           {[](MeshoptSheet& s) { s.extension(0)["count"] = 80; }, "not count x byteStride"},
           {[](MeshoptSheet& s) { s.extension(0)["count"] = 2'000'000'000; }, "decoded data above"},
           {[](MeshoptSheet& s) { s.extension(0)["byteLength"] = 10'000'000; }, "lie beyond the buffer"},
           {[](MeshoptSheet& s) { s.extension(0)["byteLength"] = 20; }, "meshopt data are damaged"},
           {[](MeshoptSheet& s) { s.extension(0)["buffer"] = 1; }, "has no data"},
           {[](MeshoptSheet& s) { s.extension(0).erase("count"); }, "has no count"}}) {
    EXPECT_NE(refusal(spoil).find(why), std::string::npos) << why << ": " << refusal(spoil);
    EXPECT_NE(refusal(spoil).find("bufferViews[0]"), std::string::npos) << refusal(spoil);
  }
  MeshoptSheet sheet;
  sheet.extension(1)["count"] = 383;
  EXPECT_NE(sheet.refusal().find("no multiple of 3"), std::string::npos);
  LoadLimits few;
  few.total_bytes = sheet.gltf.bytes.size() + 900;
  EXPECT_NE(MeshoptSheet().refusal(few), "");
}

TEST(GltfMeshopt, any_single_damaged_byte_is_refused_or_harmless) {
  const MeshoptSheet whole;
  std::size_t refused = 0;
  for (std::size_t at = 0; at < whole.gltf.bytes.size(); ++at) {
    for (const char value : {'\0', '\xff', '\x55'}) {
      MeshoptSheet damaged = whole;
      damaged.gltf.bytes[at] = value;
      refused += damaged.refusal().empty() ? 0u : 1u;
    }
  }
  EXPECT_GT(refused, 20u);
}

#endif

TEST(GltfCompression, is_refused_by_name_where_this_build_cannot_decode_it) {
  for (const auto& [name, decoded] : std::vector<std::pair<const char*, bool>>{
#ifdef GNOMON_HAS_DRACO
           {"KHR_draco_mesh_compression", true},
#else
           {"KHR_draco_mesh_compression", false},
#endif
#ifdef GNOMON_HAS_MESHOPTIMIZER
           {"EXT_meshopt_compression", true},
#else
           {"EXT_meshopt_compression", false},
#endif
           {"KHR_texture_basisu", false}}) {
    TestGltf gltf = one_triangle();
    gltf.document["extensionsRequired"] = {name};
    EXPECT_EQ(refusal_of(gltf).find(name) == std::string::npos, decoded) << name;
  }
}

}  // namespace
}  // namespace gnomon::test
