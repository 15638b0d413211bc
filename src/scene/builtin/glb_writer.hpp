// From meshes, materials and placements to the bytes of a GLB file.
#pragma once

#include <tiny_gltf.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/scene/scene.hpp"
#include "mesh_builder.hpp"

namespace gnomon::detail {

class GlbWriter {
 public:
  explicit GlbWriter(const std::string& scene_name);
  /// `color` is linear. Returns the material's number.
  int material(const std::string& name, const glm::dvec3& color);
  /// Lets so much of the light through, coloured; double sided.
  int glass_material(const std::string& name, const glm::dvec3& color, double transmission);
  /// Covers this share, and lets the rest of the light through; double sided.
  int blend_material(const std::string& name, const glm::dvec3& color, double alpha);
  /// A cut-out: double sided, alpha from `picture` with a cutoff of one half.
  int mask_material(const std::string& name, const glm::dvec3& color, const Image& picture);
  using Part = std::pair<const MeshBuilder*, int>;  // triangles and their material
  int mesh(const std::string& name, const std::vector<Part>& parts);
  int mesh(const std::string& name, const MeshBuilder& part, int material) {
    return mesh(name, {{&part, material}});
  }
  void node(int mesh, const glm::dmat4& world_from_object = glm::dmat4(1.0));
  [[nodiscard]] std::string glb() const;

 private:
  int view(const void* data, std::size_t bytes, int target);
  int accessor(int view, int component_type, int type, std::size_t count);
  tinygltf::Model model_;
};

/// A square plate of `tiles` x `tiles` single-sided instances of one mesh, centred on the origin at y = 0, so
/// that culling has something to leave out.
void add_ground(GlbWriter& writer, double side, int tiles, int material);

}  // namespace gnomon::detail
