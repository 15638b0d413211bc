// Which simpler meshes cast in place of a scene's own?
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gnomon/scene/load.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon::detail {

/// By Scene::nodes: why a shadow proxy neither replaces the node's shadow nor is made of its mesh. Empty: it
/// may.
[[nodiscard]] std::vector<std::string> why_no_proxies(const Scene& scene);

/// Lets other meshes cast for nodes of a scene. Instances are added behind all others.
class ProxyPlacer {
 public:
  ProxyPlacer(Scene& scene, const LoadLimits& limits);
  /// Places the primitives wherever the mesh of `node` stands, which casts no more. The node may have a
  /// proxy, as why_no_proxies() says. Throws Refusal where the scene grows beyond its limits.
  void place(std::uint32_t node, std::span<const std::uint32_t> primitives);

 private:
  Scene& scene_;
  const LoadLimits& limits_;
  std::uint64_t triangles_;
  std::vector<std::vector<std::uint32_t>> instances_;  ///< by Scene::nodes
  std::vector<int> moved_by_;                          ///< by instance: SceneMotion::nodes, or -1
};

/// Throws Refusal for shadow proxies that take a scene to `count` of something, and above `most`.
void check_limit(std::uint64_t count, std::uint64_t most, const char* what);

}  // namespace gnomon::detail
