// From meshes, materials and placements to the bytes of a GLB file.
#include "glb_writer.hpp"

#include <cstring>
#include <sstream>

#include "gnomon/scene/image.hpp"

namespace gnomon::detail {

namespace {

constexpr std::size_t kAlignment = 4;         // bytes; GLB and every component type are content with it
constexpr std::size_t kShortIndices = 65535;  // vertices a 16-bit index reaches, restart value left out

std::vector<double> to_list(const glm::dmat4& m) {
  std::vector<double> out;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) out.push_back(m[c][r]);
  }
  return out;
}

}  // namespace

GlbWriter::GlbWriter(const std::string& scene_name) {
  model_.asset.version = "2.0";
  model_.asset.generator = "gnomon";
  model_.scenes.emplace_back();
  model_.scenes.back().name = scene_name;
  model_.defaultScene = 0;
  model_.buffers.emplace_back();
}

int GlbWriter::material(const std::string& name, const glm::dvec3& color) {
  tinygltf::Material out;
  out.name = name;
  out.pbrMetallicRoughness.baseColorFactor = {color.x, color.y, color.z, 1.0};
  out.pbrMetallicRoughness.metallicFactor = 0.0;
  model_.materials.push_back(out);
  return static_cast<int>(model_.materials.size() - 1);
}

int GlbWriter::glass_material(const std::string& name, const glm::dvec3& color, double transmission) {
  const int index = material(name, color);
  tinygltf::Material& out = model_.materials.back();
  constexpr const char* kExtension = "KHR_materials_transmission";
  out.extensions[kExtension] =
      tinygltf::Value(tinygltf::Value::Object{{"transmissionFactor", tinygltf::Value(transmission)}});
  out.doubleSided = true;
  if (model_.extensionsUsed.empty()) model_.extensionsUsed.emplace_back(kExtension);
  return index;
}

int GlbWriter::blend_material(const std::string& name, const glm::dvec3& color, double alpha) {
  const int index = material(name, color);
  tinygltf::Material& out = model_.materials.back();
  out.pbrMetallicRoughness.baseColorFactor[3] = alpha;
  out.alphaMode = "BLEND";
  out.doubleSided = true;
  return index;
}

int GlbWriter::mask_material(const std::string& name, const glm::dvec3& color, const Image& picture) {
  const std::vector<std::uint8_t> png = encode_png(picture);
  tinygltf::Image image;
  image.name = picture.name;
  image.mimeType = "image/png";
  image.bufferView = view(png.data(), png.size(), 0);
  model_.images.push_back(image);
  tinygltf::Sampler sampler;
  sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model_.samplers.push_back(sampler);
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model_.images.size() - 1);
  texture.sampler = static_cast<int>(model_.samplers.size() - 1);
  model_.textures.push_back(texture);

  const int index = material(name, color);
  tinygltf::Material& out = model_.materials.back();
  out.pbrMetallicRoughness.baseColorTexture.index = static_cast<int>(model_.textures.size() - 1);
  out.alphaMode = "MASK";
  out.alphaCutoff = 0.5;
  out.doubleSided = true;
  return index;
}

int GlbWriter::mesh(const std::string& name, const std::vector<Part>& parts) {
  tinygltf::Mesh out;
  out.name = name;
  for (const auto& [part, material] : parts) {
    const std::size_t count = part->positions.size();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    const auto attribute = [&](const char* key, const auto& values, int type) {
      const int v = view(values.data(), values.size() * sizeof(values[0]), TINYGLTF_TARGET_ARRAY_BUFFER);
      primitive.attributes[key] = accessor(v, TINYGLTF_COMPONENT_TYPE_FLOAT, type, count);
    };
    attribute("POSITION", part->positions, TINYGLTF_TYPE_VEC3);
    tinygltf::Accessor& position = model_.accessors.back();
    Box box;
    for (const glm::vec3& p : part->positions) box.extend(glm::dvec3(p));
    position.minValues = {box.min.x, box.min.y, box.min.z};
    position.maxValues = {box.max.x, box.max.y, box.max.z};
    attribute("NORMAL", part->normals, TINYGLTF_TYPE_VEC3);
    attribute("TEXCOORD_0", part->texcoords, TINYGLTF_TYPE_VEC2);

    const std::size_t indices = part->indices.size();
    if (count <= kShortIndices) {
      const std::vector<std::uint16_t> narrow(part->indices.begin(), part->indices.end());
      const int v = view(narrow.data(), indices * sizeof(narrow[0]), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
      primitive.indices = accessor(v, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, indices);
    } else {
      const int v = view(part->indices.data(), indices * sizeof(part->indices[0]),
                         TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
      primitive.indices = accessor(v, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, indices);
    }
    out.primitives.push_back(primitive);
  }
  model_.meshes.push_back(out);
  return static_cast<int>(model_.meshes.size() - 1);
}

void GlbWriter::node(int mesh, const glm::dmat4& world_from_object) {
  tinygltf::Node out;
  out.mesh = mesh;
  if (world_from_object != glm::dmat4(1.0)) out.matrix = to_list(world_from_object);
  model_.nodes.push_back(out);
  model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size() - 1));
}

std::string GlbWriter::glb() const {
  std::ostringstream out;
  tinygltf::TinyGLTF writer;
  writer.SetImageWriter(nullptr, nullptr);
  writer.WriteGltfSceneToStream(&model_, out, false, true);
  return out.str();
}

int GlbWriter::view(const void* data, std::size_t bytes, int target) {
  std::vector<unsigned char>& buffer = model_.buffers[0].data;
  tinygltf::BufferView out;
  out.buffer = 0;
  out.byteOffset = buffer.size();
  out.byteLength = bytes;
  out.target = target;
  buffer.resize(buffer.size() + (bytes + kAlignment - 1) / kAlignment * kAlignment);
  std::memcpy(buffer.data() + out.byteOffset, data, bytes);
  model_.bufferViews.push_back(out);
  return static_cast<int>(model_.bufferViews.size() - 1);
}

int GlbWriter::accessor(int view, int component_type, int type, std::size_t count) {
  tinygltf::Accessor out;
  out.bufferView = view;
  out.componentType = component_type;
  out.type = type;
  out.count = count;
  model_.accessors.push_back(out);
  return static_cast<int>(model_.accessors.size() - 1);
}

void add_ground(GlbWriter& writer, double side, int tiles, int material) {
  const double tile = side / tiles;
  MeshBuilder plate;
  plate.quad({0.0, 0.0, tile}, {tile, 0.0, tile}, {tile, 0.0, 0.0}, {0.0, 0.0, 0.0});
  const int mesh = writer.mesh("ground", plate, material);
  for (int x = 0; x < tiles; ++x) {
    for (int z = 0; z < tiles; ++z)
      writer.node(mesh, placed({x * tile - side / 2.0, 0.0, z * tile - side / 2.0}));
  }
}

}  // namespace gnomon::detail
