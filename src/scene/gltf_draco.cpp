// Decodes KHR_draco_mesh_compression: whole primitives, packed by Draco.
// Based on: Khronos Group, KHR_draco_mesh_compression (2018); Draco bitstream 2.2 (2017), sections "Header"
// and "Connectivity Decoder".
#include <draco/compression/decode.h>

#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <optional>

#include "gltf_check.hpp"
#include "gltf_compression.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

using nlohmann::json;

namespace {

using Span = std::span<const std::uint8_t>;

constexpr std::uint64_t kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
/// Corners per byte of packed data that no encoder exceeds on real meshes: entropy coding of a regular flat
/// grid comes to a few hundred.
constexpr std::uint64_t kMaxPerByte = 4096;

struct Counts {
  std::uint64_t faces, points;
};

/// A LEB128 number; nothing where it is cut off or does not fit.
std::optional<std::uint64_t> varint(Span bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 35 && at < bytes.size(); shift += 7) {
    const std::uint8_t byte = bytes[at++];
    value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if ((byte & 0x80) == 0) return value;
  }
  return std::nullopt;
}

/// The counts that Draco allocates memory for, read before it does.
Counts counts_of(Span packed, const std::string& where) {
  constexpr std::size_t kHeader = 11;  // "DRACO", version of two bytes, kind, method, flags of two bytes
  constexpr std::uint8_t kMajor = 2, kMinor = 2, kTriangles = 1, kEdgebreaker = 1;
  if (packed.size() <= kHeader || std::memcmp(packed.data(), "DRACO", 5) != 0)
    throw Refusal(where, "its data are not Draco's");
  if (packed[5] != kMajor || packed[6] != kMinor)
    throw Refusal(where,
                  "bitstream " + std::to_string(packed[5]) + "." + std::to_string(packed[6]) + ", not 2.2");
  if (packed[7] != kTriangles) throw Refusal(where, "holds points, not triangles");
  constexpr unsigned kMetadata = 0x80;
  if ((packed[10] & kMetadata) != 0) throw Refusal(where, "holds metadata, which glTF has no use for");
  std::size_t at = kHeader;
  const bool edgebreaker = packed[8] == kEdgebreaker;
  if (edgebreaker) ++at;  // kind of traversal
  const auto first = varint(packed, at), second = varint(packed, at);
  if (!first || !second) throw Refusal(where, "its Draco data are cut off");
  return edgebreaker ? Counts{*second, *first} : Counts{*first, *second};
}

std::uint64_t count_of(const json& document, std::size_t accessor) {
  return document["accessors"][accessor]["count"].get<std::uint64_t>();
}

int components_of(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

/// Accessors of decoded data, in the order of names; `indices` of the corners.
struct Decoded {
  std::map<std::string, std::size_t> accessors;
  std::size_t indices = 0;
};

std::size_t add_accessor(Compressed& file, Bytes bytes, std::uint64_t component, const std::string& type,
                         std::uint64_t count) {
  json& views = file.document["bufferViews"];
  const std::uint64_t length = bytes.size();
  views.push_back(
      {{"buffer", add_buffer(file, std::move(bytes))}, {"byteOffset", 0}, {"byteLength", length}});
  json& accessors = file.document["accessors"];
  accessors.push_back(
      {{"bufferView", views.size() - 1}, {"componentType", component}, {"type", type}, {"count", count}});
  return accessors.size() - 1;
}

template <class Number>
Bytes values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components,
                const std::string& where) {
  const std::size_t size = static_cast<std::size_t>(components) * sizeof(Number);
  Bytes out(mesh.num_points() * size);
  for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
    Number element[4]{};
    const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(p));
    if (at.value() >= attribute.size() ||
        !attribute.ConvertValue<Number>(at, static_cast<std::int8_t>(components), element))
      throw Refusal(where, "vertex " + std::to_string(p) + " has no value");
    std::memcpy(&out[p * size], element, size);
  }
  return out;
}

class Decoder {
 public:
  explicit Decoder(Compressed& file) : file_(file) {}

  void decode(json& primitive, const json& extension, const std::string& where) {
    if (primitive.value("mode", 4) != 4) throw Refusal(where, "is not a list of triangles");
    check_counts(primitive, where);
    const Decoded& decoded = once(primitive, extension, where);
    for (const auto& [name, accessor] : decoded.accessors) primitive["attributes"][name] = accessor;
    primitive["indices"] = decoded.indices;
  }

 private:
  /// Against the file's own promises, which the limits are held against.
  void check_counts(const json& primitive, const std::string& where) const {
    if (!primitive.contains("indices") || !primitive["attributes"].contains("POSITION"))
      throw Refusal(where, "has no indices or no POSITION");
    const std::uint64_t corners = count_of(file_.document, primitive["indices"].get<std::size_t>());
    const std::uint64_t points =
        count_of(file_.document, primitive["attributes"]["POSITION"].get<std::size_t>());
    if (points > file_.limits.vertices || corners / 3 > file_.limits.triangles)
      throw Refusal(where, std::to_string(points) + " vertices and " + std::to_string(corners / 3) +
                               " triangles are above the limits of " + std::to_string(file_.limits.vertices) +
                               " and " + std::to_string(file_.limits.triangles));
  }

  /// Primitives may share data, which is decoded once.
  const Decoded& once(const json& primitive, const json& extension, const std::string& where) {
    const auto [at, is_new] =
        known_.try_emplace(extension.dump() + primitive["attributes"].dump() + primitive["indices"].dump());
    if (is_new) at->second = decode_data(primitive, extension, where);
    return at->second;
  }

  Decoded decode_data(const json& primitive, const json& extension, const std::string& where) {
    const json& view = file_.document["bufferViews"][extension["bufferView"].get<std::size_t>()];
    const Span packed =
        part_of(file_, view["buffer"].get<std::size_t>(), view.value("byteOffset", std::uint64_t{0}),
                view["byteLength"].get<std::uint64_t>(), where);
    const std::uint64_t corners = count_of(file_.document, primitive["indices"].get<std::size_t>());
    const std::uint64_t points =
        count_of(file_.document, primitive["attributes"]["POSITION"].get<std::size_t>());
    const Counts promised = counts_of(packed, where);
    if (promised.faces != corners / 3 || corners % 3 != 0 || promised.points > points)
      throw Refusal(where, "its Draco data have " + std::to_string(promised.faces) + " triangles and " +
                               std::to_string(promised.points) + " vertices, the accessors " +
                               std::to_string(corners) + " indices and " + std::to_string(points) +
                               " vertices");
    if (corners + points > kMaxPerByte * packed.size())
      throw Refusal(where, std::to_string(packed.size()) + " bytes of Draco data cannot hold " +
                               std::to_string(corners / 3) + " triangles");
    spend_decoded(file_, corners, sizeof(std::uint32_t), where);
    const std::unique_ptr<draco::Mesh> mesh = mesh_of(packed, where);
    if (mesh->num_points() != points || mesh->num_faces() != promised.faces)
      throw Refusal(where, "its Draco data have " + std::to_string(mesh->num_points()) +
                               " vertices, the accessors " + std::to_string(points));
    Decoded out;
    for (const auto& [name, id] : extension["attributes"].items()) {
      const bool read = name == "POSITION" || name == "NORMAL" || name.starts_with("TEXCOORD_") ||
                        name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
      if (read && primitive["attributes"].contains(name))
        out.accessors[name] = attribute(*mesh, primitive, name, id.get<std::uint32_t>(), where);
    }
    if (!out.accessors.contains("POSITION")) throw Refusal(where, "its Draco data have no POSITION");
    Bytes indices(static_cast<std::size_t>(corners) * sizeof(std::uint32_t));
    for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = mesh->face(draco::FaceIndex(f))[k].value();
        std::memcpy(&indices[(f * 3u + k) * sizeof corner], &corner, sizeof corner);
      }
    }
    out.indices = add_accessor(file_, std::move(indices), kUnsignedInt, "SCALAR", corners);
    return out;
  }

  static std::unique_ptr<draco::Mesh> mesh_of(Span packed, const std::string& where) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
    draco::Decoder decoder;
    try {
      auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
      if (!mesh.ok())
        throw Refusal(where, "its Draco data are damaged: " + one_line(mesh.status().error_msg_string()));
      return std::move(mesh).value();
    } catch (const std::bad_alloc&) {
      throw Refusal(where, "its Draco data take more memory than there is");
    }
  }

  std::size_t attribute(const draco::Mesh& mesh, const json& primitive, const std::string& name,
                        std::uint32_t id, const std::string& where) {
    const std::string place = where + "." + one_line(name);
    const draco::PointAttribute* found = mesh.GetAttributeByUniqueId(id);
    if (found == nullptr) throw Refusal(place, "its Draco data have no attribute " + std::to_string(id));
    const json& accessor = file_.document["accessors"][primitive["attributes"][name].get<std::size_t>()];
    const auto type = accessor["type"].get<std::string>();
    const int components = components_of(type);
    if (components == 0 || components != found->num_components())
      throw Refusal(place,
                    std::to_string(found->num_components()) + " components do not make a " + one_line(type));
    const bool whole = name.starts_with("JOINTS_");
    const std::uint64_t component = whole ? kUnsignedShort : kFloat;
    spend_decoded(file_, mesh.num_points(), static_cast<std::uint64_t>(components) * (whole ? 2u : 4u),
                  place);
    Bytes values = whole ? values_of<std::uint16_t>(mesh, *found, components, place)
                         : values_of<float>(mesh, *found, components, place);
    return add_accessor(file_, std::move(values), component, type, mesh.num_points());
  }

  Compressed& file_;
  std::map<std::string, Decoded> known_;
};

}  // namespace

bool decodes_draco() noexcept {
  return true;
}

void decode_draco_primitives(Compressed& file) {
  const auto meshes = file.document.find("meshes");
  if (meshes == file.document.end()) return;
  Decoder decoder(file);
  for (std::size_t m = 0; m < meshes->size(); ++m) {
    json& primitives = (*meshes)[m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const std::string where = element("meshes", m) + "." + element("primitives", p);
      const json extension = checked_draco(file.source, file.source["meshes"][m]["primitives"][p], where);
      if (!extension.is_null()) decoder.decode(primitives[p], extension, where);
    }
  }
}

}  // namespace gnomon::detail
