// Where does each node of a glTF document stand in the world?
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gltf_document.hpp"

namespace gnomon::detail {

struct NodeTree {
  std::vector<glm::dmat4> world_from_node;  // of every node, also those outside the scene shown
  std::vector<int> shown;  // nodes of the scene, parents before children; none that is hidden
};

/// How a node without a matrix is placed in its parent.
struct PlacedNode {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // as in the file, of any length
  glm::dvec3 scale{1.0};
};
[[nodiscard]] PlacedNode placed(const tinygltf::Node& node);

/// Parent from node.
[[nodiscard]] glm::dmat4 local_transform(const tinygltf::Node& node);

/// `hidden`: by node, or empty. Throws Refusal for loops, for nodes with two parents and for
/// transforms that overflow.
[[nodiscard]] NodeTree build_node_tree(const tinygltf::Model& model, const std::vector<bool>& hidden,
                                       std::vector<std::string>& warnings);

}  // namespace gnomon::detail
