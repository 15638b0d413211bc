// Which lights and cameras does a glTF document have, and which nodes hold them?
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gnomon/scene/scene.hpp"

namespace gnomon::detail {

struct NodeTree;

/// Of KHR_lights_punctual and `cameras`, as if their nodes were at the origin. What is broken is warned of,
/// and missing.
struct ViewSource {
  template <class Entry>
  struct OfNode {
    std::size_t node;
    Entry entry;
  };
  std::vector<OfNode<SceneLight>> lights;    // in the order of nodes; a range of 0: without end
  std::vector<OfNode<SceneCamera>> cameras;  // the same order
};
[[nodiscard]] ViewSource read_view_source(const nlohmann::json& source, std::vector<std::string>& warnings);

/// Places them in the scene: those of nodes that are shown. A light without a range gets twice the diagonal
/// of the scene and itself.
void place_views(const ViewSource& source, const NodeTree& tree, Scene& scene);

}  // namespace gnomon::detail
