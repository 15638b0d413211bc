// Where are a skinned mesh's vertices in its bind pose?
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 3.7.3 "Skins".
#include "gltf_skin.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

#include "gltf_accessor.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

namespace {

constexpr int kInfluenceSets = 4;            // JOINTS_0..3, 16 joints per vertex; exporters stop at 8
constexpr std::uint64_t kMaxJoints = 65536;  // joints are at most 16-bit numbers

struct Influences {
  std::vector<std::uint32_t> joints;  // four per vertex
  std::vector<float> weights;
};

std::vector<Influences> read_influences(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                        std::size_t vertex_count) {
  std::vector<Influences> sets;
  for (int set = 0; set < kInfluenceSets; ++set) {
    const auto joints = primitive.attributes.find("JOINTS_" + std::to_string(set));
    const auto weights = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) break;
    sets.push_back({read_integers(model, joints->second, 4, vertex_count),
                    read_floats(model, weights->second, 4, vertex_count)});
    if (sets.back().joints.size() != vertex_count * 4 || sets.back().weights.size() != vertex_count * 4) {
      throw LeftOut("joints or weights are fewer than the vertices");
    }
  }
  if (sets.empty()) throw LeftOut("has a skin but no joints and weights");
  return sets;
}

glm::dmat4 blend(const std::vector<Influences>& sets, std::size_t vertex,
                 const std::vector<glm::dmat4>& joints) {
  glm::dmat4 sum(0.0);
  double total = 0.0;
  for (const Influences& set : sets) {
    for (std::size_t i = vertex * 4; i < vertex * 4 + 4; ++i) {
      const double weight = static_cast<double>(set.weights[i]);
      if (!(weight >= 0.0) || !std::isfinite(weight))
        throw LeftOut("has a weight that is negative or not finite");
      if (weight == 0.0) continue;
      if (set.joints[i] >= joints.size()) {
        throw LeftOut("names joint " + std::to_string(set.joints[i]) + " of " +
                      std::to_string(joints.size()));
      }
      sum += joints[set.joints[i]] * weight;
      total += weight;
    }
  }
  if (total == 0.0) {
    const std::uint32_t joint = sets[0].joints[vertex * 4];
    return joints[joint < joints.size() ? joint : 0];
  }
  return sum * (1.0 / total);
}

// The cofactor matrix carries normals like the inverse transpose does, and needs no inverse.
glm::dvec3 carry_normal(const glm::dmat3& m, const glm::dvec3& n) {
  const glm::dvec3 carried =
      glm::cross(m[1], m[2]) * n.x + glm::cross(m[2], m[0]) * n.y + glm::cross(m[0], m[1]) * n.z;
  return glm::determinant(m) < 0.0 ? -carried : carried;
}

}  // namespace

std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, const tinygltf::Skin& skin,
                                       const NodeTree& tree) {
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
    out.push_back(tree.world_from_node[static_cast<std::size_t>(skin.joints[j])] * joint_from_mesh);
  }
  return out;
}

void bend(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
          const std::vector<glm::dmat4>& joints, Vertices& vertices, std::vector<std::uint32_t>& triangles) {
  std::vector<Influences> sets;
  try {
    sets = read_influences(model, primitive, vertices.positions.size());
  } catch (const Refusal& e) {
    throw LeftOut(e.what());
  }
  std::size_t mirrored = 0;
  for (std::size_t v = 0; v < vertices.positions.size(); ++v) {
    const glm::dmat4 world = blend(sets, v, joints);
    const glm::dvec3 position(world * glm::dvec4(glm::dvec3(vertices.positions[v]), 1.0));
    vertices.positions[v] = glm::vec3(position);
    if (!std::isfinite(glm::length(glm::dvec3(vertices.positions[v]))))
      throw LeftOut("carries a vertex to infinity");
    const glm::dmat3 turn(world);
    mirrored += glm::determinant(turn) < 0.0 ? 1u : 0u;
    if (!vertices.normals.empty()) {
      const glm::dvec3 normal = carry_normal(turn, glm::dvec3(vertices.normals[v]));
      const double length = glm::length(normal);
      vertices.normals[v] = length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
    }
  }
  if (mirrored * 2 > vertices.positions.size()) {
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) std::swap(triangles[i + 1], triangles[i + 2]);
  }
}

}  // namespace gnomon::detail
