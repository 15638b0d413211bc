// Where are a skinned mesh's vertices in its bind pose?
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "gltf_mesh.hpp"

namespace gnomon::detail {

/// Joints of a primitive's vertices, by how much each counts.
struct Influences {
  std::uint32_t per_vertex = 0;
  std::vector<std::uint32_t> joints;  ///< per_vertex for each vertex
  std::vector<float> weights;         ///< the same
};

/// Joint from mesh for each joint of a skin. Throws LeftOut where the skin is broken.
[[nodiscard]] std::vector<glm::dmat4> inverse_binds(const tinygltf::Model& model, const tinygltf::Skin& skin);

/// World from mesh for each joint of a skin. Throws LeftOut where the skin is broken.
[[nodiscard]] std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, const tinygltf::Skin& skin,
                                                     const NodeTree& tree);

/// Moves `vertices` to where the joints carry them, and turns `triangles` round where that mirrors them.
/// Returns which joints those were. Throws LeftOut where weights or joints are broken.
Influences bend(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                const std::vector<glm::dmat4>& joints, Vertices& vertices,
                std::vector<std::uint32_t>& triangles);

}  // namespace gnomon::detail
