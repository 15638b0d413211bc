// Which nodes does a glTF document hide, which stand in many places, and which cast and receive shadows?
#pragma once

#include <glm/mat4x4.hpp>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "gnomon/scene/load.hpp"

namespace tinygltf {
class Model;
}

namespace gnomon::detail {

/// What extensions and extras of nodes say; one entry for each node.
struct PlacementSource {
  /// Accessors of EXT_mesh_gpu_instancing; -1: none.
  struct Places {
    int translation = -1, rotation = -1, scale = -1;
    [[nodiscard]] bool any() const noexcept { return translation >= 0 || rotation >= 0 || scale >= 0; }
  };
  std::vector<bool> hidden;  ///< by KHR_node_visibility, with all that hangs on it
  std::vector<Places> places;
  /// By `extras` of the node, else of its mesh.
  struct Shadows {
    bool casts = true, receives = true;
  };
  std::vector<Shadows> shadows;
  /// The node whose mesh casts in its place, by `extras.shadowProxy`; -1: none.
  std::vector<int> proxies;
  /// Of each mesh: width of its points and lines in its own space, by `extras.markWidth`; 0: not said.
  std::vector<double> mark_widths;
  /// Is shown nowhere, as its mesh casts for others.
  [[nodiscard]] bool is_proxy(int node) const { return proxy_nodes.contains(node); }
  std::set<int> proxy_nodes;
};

/// A broken extension is warned of, and counts as none.
[[nodiscard]] PlacementSource read_placement_source(const nlohmann::json& source,
                                                    std::vector<std::string>& warnings);

/// Entries of the shortest and of the longest accessor. The mesh has as many places as the shortest.
struct PlaceCount {
  std::uint64_t least = 1, most = 1;
};
[[nodiscard]] PlaceCount place_count(const tinygltf::Model& model, const PlacementSource::Places& places);
/// Node from instance, for each. Throws LeftOut where an accessor is broken.
[[nodiscard]] std::vector<glm::dmat4> places_of(const tinygltf::Model& model,
                                                const PlacementSource::Places& places,
                                                std::uint64_t max_count);

}  // namespace gnomon::detail
