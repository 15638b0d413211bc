// Where is a scene within the boxes of its large meshes?
#pragma once

#include <cstdint>
#include <vector>

#include "gnomon/scene/scene.hpp"

namespace gnomon::detail {

/// A part of an instance's triangles.
struct MeshPart {
  std::uint32_t instance = 0;  ///< number in the scene
  Box bounds_world;            ///< round whole triangles: parts overlap
};

/// Receivers with more triangles than one of some hundred equal shares of the scene's, in parts of about that
/// many which lie side by side. Parts of one instance follow each other, and hold all of its triangles.
[[nodiscard]] std::vector<MeshPart> mesh_parts(const Scene& scene);

}  // namespace gnomon::detail
