// Where does each node of a glTF document stand in the world?
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "gltf_document.hpp"

namespace gnomon::detail {

struct NodeTree {
  std::vector<glm::dmat4> world_from_node;  // of every node, also those outside the scene shown
  std::vector<int> shown;                   // nodes of the scene, parents before children
};

/// Throws Refusal for loops, for nodes with two parents, for trees too deep and transforms that overflow.
[[nodiscard]] NodeTree build_node_tree(const tinygltf::Model& model, const LoadLimits& limits,
                                       std::vector<std::string>& warnings);

}  // namespace gnomon::detail
