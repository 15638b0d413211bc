// Where does each node of a glTF document stand in the world?
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 3.5 "Scenes and nodes".
#include "gltf_nodes.hpp"

#include <cmath>

#include "node_matrix.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

namespace {

constexpr int kNoParent = -1;

bool is_finite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!std::isfinite(m[c][r])) return false;
    }
  }
  return true;
}

std::vector<int> find_parents(const tinygltf::Model& model) {
  std::vector<int> parents(model.nodes.size(), kNoParent);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    for (const int child : model.nodes[n].children) {
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent != kNoParent) {
        throw Refusal(element("nodes", static_cast<std::size_t>(child)),
                      "is a child of both nodes[" + std::to_string(parent) + "] and " + element("nodes", n));
      }
      parent = static_cast<int>(n);
    }
  }
  return parents;
}

// Depth first without recursion; with one parent per node, a node that no root reaches is in a loop.
void place(const tinygltf::Model& model, std::vector<int> open, std::vector<bool>& placed,
           std::vector<glm::dmat4>& world_from_node) {
  for (const int root : open) {
    world_from_node[static_cast<std::size_t>(root)] =
        local_transform(model.nodes[static_cast<std::size_t>(root)]);
  }
  while (!open.empty()) {
    const auto n = static_cast<std::size_t>(open.back());
    open.pop_back();
    placed[n] = true;
    if (!is_finite(world_from_node[n])) throw Refusal(element("nodes", n), "its transform is not finite");
    for (const int child : model.nodes[n].children) {
      const auto c = static_cast<std::size_t>(child);
      world_from_node[c] = world_from_node[n] * local_transform(model.nodes[c]);
      open.push_back(child);
    }
  }
}

std::vector<int> shown_roots(const tinygltf::Model& model, const std::vector<int>& roots,
                             std::vector<std::string>& warnings) {
  if (model.scenes.empty()) {
    if (!model.nodes.empty()) warn(warnings, "scenes", "there is none, every root node is shown");
    return roots;
  }
  const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
  if (model.scenes.size() > 1 && model.defaultScene < 0) {
    warn(warnings, "scene",
         "no default among " + std::to_string(model.scenes.size()) + ", the first is shown");
  }
  return model.scenes[static_cast<std::size_t>(scene)].nodes;
}

}  // namespace

glm::dmat4 local_transform(const tinygltf::Node& node) {
  glm::dmat4 out(1.0);
  if (node.matrix.size() == 16) {
    for (std::size_t i = 0; i < 16; ++i)
      out[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = node.matrix[i];
    // The bottom row of an affine matrix; anything else would be a projection, which no node is.
    for (int c = 0; c < 4; ++c) out[c][3] = c == 3 ? 1.0 : 0.0;
    return out;
  }
  const PlacedNode at = placed(node);
  return composed(at.translation, at.rotation, at.scale);
}

PlacedNode placed(const tinygltf::Node& node) {
  PlacedNode out;
  const std::vector<double>& r = node.rotation;
  if (r.size() == 4) out.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
  if (node.scale.size() == 3) out.scale = {node.scale[0], node.scale[1], node.scale[2]};
  if (node.translation.size() == 3)
    out.translation = {node.translation[0], node.translation[1], node.translation[2]};
  return out;
}

NodeTree build_node_tree(const tinygltf::Model& model, const std::vector<bool>& hidden,
                         std::vector<std::string>& warnings) {
  const std::vector<int> parents = find_parents(model);
  std::vector<int> roots;
  for (std::size_t n = 0; n < parents.size(); ++n) {
    if (parents[n] == kNoParent) roots.push_back(static_cast<int>(n));
  }
  NodeTree tree;
  tree.world_from_node.assign(model.nodes.size(), glm::dmat4(1.0));
  std::vector<bool> placed(model.nodes.size(), false);
  place(model, roots, placed, tree.world_from_node);
  for (std::size_t n = 0; n < placed.size(); ++n) {
    if (!placed[n]) throw Refusal(element("nodes", n), "is its own ancestor");
  }

  std::vector<bool> seen(model.nodes.size(), false);
  std::vector<int> open = shown_roots(model, roots, warnings);
  std::vector<int> pending(open.rbegin(), open.rend());
  while (!pending.empty()) {
    const int n = pending.back();
    pending.pop_back();
    if (seen[static_cast<std::size_t>(n)]) {
      warn(warnings, element("nodes", static_cast<std::size_t>(n)), "is in the scene twice, shown once");
      continue;
    }
    seen[static_cast<std::size_t>(n)] = true;
    if (static_cast<std::size_t>(n) < hidden.size() && hidden[static_cast<std::size_t>(n)]) continue;
    tree.shown.push_back(n);
    const std::vector<int>& children = model.nodes[static_cast<std::size_t>(n)].children;
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
  return tree;
}

}  // namespace gnomon::detail
