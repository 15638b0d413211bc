// What do a primitive's accessors hold? Positions, normals, texture coordinates and corners, checked.
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 3.7 "Geometry".
#include <algorithm>
#include <cmath>
#include <numeric>

#include "bounds_of.hpp"
#include "gltf_accessor.hpp"
#include "gltf_mesh.hpp"
#include "refusal.hpp"
#include "triangles.hpp"

namespace gnomon::detail {

namespace {

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto it = primitive.attributes.find(name);
  return it == primitive.attributes.end() ? -1 : it->second;
}

template <class Vec>
std::vector<Vec> to_vectors(const std::vector<float>& values) {
  constexpr auto kSize = static_cast<std::size_t>(Vec::length());
  std::vector<Vec> out(values.size() / kSize);
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (int c = 0; c < Vec::length(); ++c) out[i][c] = values[i * kSize + static_cast<std::size_t>(c)];
  }
  return out;
}

void transform_texcoords(const TextureTransform& t, std::vector<glm::vec2>& texcoords) {
  const double c = std::cos(t.rotation), s = std::sin(t.rotation);
  for (glm::vec2& uv : texcoords) {
    const double u = static_cast<double>(uv.x) * t.scale[0], v = static_cast<double>(uv.y) * t.scale[1];
    uv = {static_cast<float>(c * u + s * v + t.offset[0]), static_cast<float>(c * v - s * u + t.offset[1])};
  }
}

}  // namespace

// Offsets that are broken move nothing.
std::vector<glm::vec3> MeshReader::read_offsets(int accessor, std::size_t count, const char* name,
                                                const std::string& where) {
  std::vector<glm::vec3> out;
  try {
    out = read_optional<glm::vec3>(accessor, count, name, where);
  } catch (const Refusal& e) {
    warn(scene_.warnings, where, std::string(name) + " ignored: " + e.what());
  }
  if (std::all_of(out.begin(), out.end(), [](const glm::vec3& v) { return is_finite(v); })) return out;
  warn(scene_.warnings, where, std::string(name) + " ignored: has a value that is not finite");
  return {};
}

MeshReader::Attributes MeshReader::attributes_of(const tinygltf::Primitive& primitive) const {
  int set = 0, transformer = -1;
  if (primitive.material >= 0) {
    const auto m = static_cast<std::size_t>(primitive.material);
    set = document_.model.materials[m].pbrMetallicRoughness.baseColorTexture.texCoord;
    if (const auto& transform = document_.transforms[m]) {
      transformer = primitive.material;
      if (transform->texcoord >= 0) set = transform->texcoord;
    }
  }
  return {attribute(primitive, "POSITION"), attribute(primitive, "NORMAL"),
          attribute(primitive, "TEXCOORD_" + std::to_string(set)), transformer};
}

Vertices MeshReader::read_vertices(const Attributes& attributes, const std::string& where) {
  Vertices out;
  out.positions = to_vectors<glm::vec3>(read_floats(document_.model, attributes[0], 3, vertices_left_));
  spend_vertices(out.positions.size(), where);
  for (std::size_t v = 0; v < out.positions.size(); ++v) {
    if (!is_finite(out.positions[v]))
      throw Refusal(where, "position " + std::to_string(v) + " is not finite");
  }
  const std::size_t count = out.positions.size();
  out.normals = read_optional<glm::vec3>(attributes[1], count, "NORMAL", where);
  out.texcoords = read_optional<glm::vec2>(attributes[2], count, "TEXCOORD", where);
  out.texcoords.resize(count, glm::vec2(0.0f));
  if (attributes[3] >= 0) {
    transform_texcoords(*document_.transforms[static_cast<std::size_t>(attributes[3])], out.texcoords);
  }
  std::size_t broken = 0;
  for (glm::vec2& uv : out.texcoords) {
    if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
    uv = glm::vec2(0.0f);
    ++broken;
  }
  if (broken > 0)
    warn(scene_.warnings, where, std::to_string(broken) + " texture coordinates were not finite");
  return out;
}

// What a picture can do without is dropped with a warning; only positions and indices can refuse a file by
// content.
template <class Vec>
std::vector<Vec> MeshReader::read_optional(int accessor, std::size_t count, const char* name,
                                           const std::string& where) {
  if (accessor < 0) return {};
  const std::size_t given = document_.model.accessors[static_cast<std::size_t>(accessor)].count;
  if (given != count) {
    warn(scene_.warnings, where,
         std::string(name) + " has " + std::to_string(given) + " entries for " + std::to_string(count) +
             " vertices, ignored");
    return {};
  }
  try {
    return to_vectors<Vec>(read_floats(document_.model, accessor, Vec::length(), count));
  } catch (const LeftOut& e) {
    warn(scene_.warnings, where, std::string(name) + " ignored: " + e.what());
    return {};
  }
}

std::vector<std::uint32_t> MeshReader::read_corners(int mesh, std::size_t primitive, std::size_t vertex_count,
                                                    const std::string& where) {
  std::vector<std::uint32_t> corners;
  if (const int indices = document_.indices[static_cast<std::size_t>(mesh)][primitive]; indices >= 0) {
    corners = read_integers(document_.model, indices, 1, corners_left_);
  } else {
    corners.resize(vertex_count);
    std::iota(corners.begin(), corners.end(), 0u);
  }
  for (const std::uint32_t corner : corners) {
    if (corner >= vertex_count) {
      throw Refusal(where, "index " + std::to_string(corner) + " is out of range, there are " +
                               std::to_string(vertex_count) + " vertices");
    }
  }
  return corners;
}

std::vector<std::uint32_t> MeshReader::read_triangles(int mesh, std::size_t primitive,
                                                      std::size_t vertex_count, const std::string& where) {
  const tinygltf::Primitive& source =
      document_.model.meshes[static_cast<std::size_t>(mesh)].primitives[primitive];
  std::vector<std::uint32_t> corners = read_corners(mesh, primitive, vertex_count, where);
  const std::size_t given = corners.size();
  std::vector<std::uint32_t> triangles = triangle_list(source.mode, std::move(corners));
  spend_corners(std::max(given, triangles.size()), where);
  if (triangles.empty()) throw LeftOut("has no triangle");
  if (source.mode == TINYGLTF_MODE_TRIANGLES && given % 3 != 0) {
    warn(scene_.warnings, where, "its last triangle is not whole, skipped");
  }
  return triangles;
}

void MeshReader::drop_invisible(const tinygltf::Primitive& primitive, std::size_t vertex_count,
                                const std::string& where, std::vector<std::uint32_t>& triangles) {
  const int color = attribute(primitive, "COLOR_0");
  if (color < 0 || primitive.material < 0) return;
  const tinygltf::Material& material =
      document_.model.materials[static_cast<std::size_t>(primitive.material)];
  const bool mask = material.alphaMode == "MASK";
  if (!mask && material.alphaMode != "BLEND") return;
  if (document_.model.accessors[static_cast<std::size_t>(color)].type != TINYGLTF_TYPE_VEC4) return;
  const auto colors = read_optional<glm::vec4>(color, vertex_count, "COLOR_0", where);
  if (colors.empty()) return;
  const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
  const double alpha = factor.size() == 4 ? factor[3] : 1.0;
  // A picture's alpha only lowers it.
  const auto shows = [&](std::uint32_t corner) {
    const double at = alpha * static_cast<double>(colors[corner].a);
    return mask ? at >= material.alphaCutoff : at > 0.0;
  };
  std::vector<std::uint32_t> kept;
  std::size_t cut = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const int shown = int{shows(triangles[i])} + int{shows(triangles[i + 1])} + int{shows(triangles[i + 2])};
    if (shown == 0) continue;
    if (shown < 3 && mask) ++cut;
    kept.insert(kept.end(), triangles.begin() + static_cast<std::ptrdiff_t>(i),
                triangles.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  if (kept.empty()) throw LeftOut("its vertex colours make all of it invisible");
  if (cut > 0)
    warn(scene_.warnings, where,
         "the alpha mask of its vertex colours ends within " + std::to_string(cut) +
             " triangles, which are drawn whole");
  triangles = std::move(kept);
}

}  // namespace gnomon::detail
