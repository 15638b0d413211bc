// Where are a skinned mesh's vertices in its bind pose?
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 3.7.3 "Skins".
#include "gltf_skin.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "deform.hpp"
#include "gltf_accessor.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

namespace {

constexpr int kInfluenceSets = 4;  // JOINTS_0..3, 16 joints per vertex; exporters stop at 8
constexpr std::uint32_t kSetWidth = 4;
constexpr std::uint64_t kMaxJoints = 65536;  // joints are at most 16-bit numbers

void check_influences(const Influences& influences, std::size_t joint_count) {
  for (std::size_t i = 0; i < influences.weights.size(); ++i) {
    const float weight = influences.weights[i];
    if (!(weight >= 0.0f) || !std::isfinite(weight))
      throw LeftOut("has a weight that is negative or not finite");
    if (weight > 0.0f && influences.joints[i] >= joint_count) {
      throw LeftOut("names joint " + std::to_string(influences.joints[i]) + " of " +
                    std::to_string(joint_count));
    }
  }
}

/// Sets of four side by side, vertex by vertex.
template <class T>
std::vector<T> side_by_side(const std::vector<std::vector<T>>& sets, std::size_t vertex_count) {
  std::vector<T> out;
  out.reserve(sets.size() * kSetWidth * vertex_count);
  for (std::size_t v = 0; v < vertex_count * kSetWidth; v += kSetWidth) {
    for (const std::vector<T>& set : sets) out.insert(out.end(), &set[v], &set[v] + kSetWidth);
  }
  return out;
}

Influences read_influences(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           std::size_t vertex_count) {
  std::vector<std::vector<std::uint32_t>> joint_sets;
  std::vector<std::vector<float>> weight_sets;
  for (int set = 0; set < kInfluenceSets; ++set) {
    const auto joints = primitive.attributes.find("JOINTS_" + std::to_string(set));
    const auto weights = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) break;
    joint_sets.push_back(read_integers(model, joints->second, kSetWidth, vertex_count));
    weight_sets.push_back(read_floats(model, weights->second, kSetWidth, vertex_count));
    if (joint_sets.back().size() != vertex_count * kSetWidth ||
        weight_sets.back().size() != vertex_count * kSetWidth) {
      throw LeftOut("joints or weights are fewer than the vertices");
    }
  }
  if (joint_sets.empty()) throw LeftOut("has a skin but no joints and weights");
  Influences out{static_cast<std::uint32_t>(joint_sets.size() * kSetWidth), {}, {}};
  if (joint_sets.size() == 1) {
    out.joints = std::move(joint_sets[0]);
    out.weights = std::move(weight_sets[0]);
  } else {
    out.joints = side_by_side(joint_sets, vertex_count);
    out.weights = side_by_side(weight_sets, vertex_count);
  }
  return out;
}

}  // namespace

std::vector<glm::dmat4> inverse_binds(const tinygltf::Model& model, const tinygltf::Skin& skin) {
  if (skin.joints.empty() || skin.joints.size() > kMaxJoints) throw LeftOut("has no joints or too many");
  std::vector<float> inverse_bind;
  if (skin.inverseBindMatrices >= 0) {
    try {
      inverse_bind = read_floats(model, skin.inverseBindMatrices, 16, kMaxJoints);
    } catch (const Refusal& e) {
      throw LeftOut(e.what());
    }
    if (inverse_bind.size() / 16 < skin.joints.size())
      throw LeftOut("has fewer inverse bind matrices than joints");
  }
  std::vector<glm::dmat4> out;
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    glm::dmat4 joint_from_mesh(1.0);
    for (std::size_t i = 0; i < 16 && !inverse_bind.empty(); ++i) {
      const double value = static_cast<double>(inverse_bind[j * 16 + i]);
      if (!std::isfinite(value)) throw LeftOut("has an inverse bind matrix that is not finite");
      joint_from_mesh[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = value;
    }
    out.push_back(joint_from_mesh);
  }
  return out;
}

std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, const tinygltf::Skin& skin,
                                       const NodeTree& tree) {
  std::vector<glm::dmat4> out = inverse_binds(model, skin);
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
    out[j] = tree.world_from_node[static_cast<std::size_t>(skin.joints[j])] * out[j];
  return out;
}

Influences bend(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                const std::vector<glm::dmat4>& joints, Vertices& vertices,
                std::vector<std::uint32_t>& triangles) {
  Influences influences;
  try {
    influences = read_influences(model, primitive, vertices.positions.size());
  } catch (const Refusal& e) {
    throw LeftOut(e.what());
  }
  check_influences(influences, joints.size());
  const std::size_t mirrored = carry({influences.per_vertex, influences.joints, influences.weights}, joints,
                                     vertices.positions, vertices.normals);
  for (const glm::vec3& position : vertices.positions) {
    if (!std::isfinite(glm::length(glm::dvec3(position)))) throw LeftOut("carries a vertex to infinity");
  }
  if (mirrored * 2 > vertices.positions.size()) {
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) std::swap(triangles[i + 1], triangles[i + 2]);
  }
  return influences;
}

}  // namespace gnomon::detail
