// Which triangles does a glTF primitive stand for? Read once into the scene and shared by all its instances.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gltf_document.hpp"
#include "gltf_nodes.hpp"

namespace gnomon::detail {

/// Vertices of one primitive while it is read. Empty `normals`: the file has none.
struct Vertices {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> texcoords;
};

class MotionReader;

/// The mover of a node's vertices, which then are the node's alone.
struct Bending {
  int node = 0;
  const std::vector<glm::dmat4>* joints = nullptr;  // world from mesh at rest; nullptr: no skin
  bool kept = false;                                // for poses
};

class MeshReader {
 public:
  MeshReader(const Document& document, const NodeTree& tree, const LoadLimits& limits, MotionReader& motion,
             Scene& scene);
  /// The scene's primitives for this mesh; those left out are missing from it. Throws Refusal.
  [[nodiscard]] const std::vector<std::uint32_t>& primitives_of(int mesh);
  /// A node's mesh bent by its skin, in world space. Nothing where the skin is broken, which is warned of.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> skinned_primitives_of(int node);
  /// Whether the node's mesh has morph targets of a weight at rest, its own or its mesh's.
  [[nodiscard]] bool morphs_at_rest(int node) const;
  /// A node's mesh without skin, with vertices of its own: morphed as at rest, and kept for poses where
  /// animations drive the weights.
  [[nodiscard]] std::vector<std::uint32_t> morphed_primitives_of(int node);
  /// Source of the primitive's vertices, where it was kept for poses.
  [[nodiscard]] std::optional<DeformedMesh> take_deformed(std::uint32_t primitive);

 private:
  using Attributes =
      std::array<int, 4>;  // accessors of position, normal, texcoord; material that transforms them
  struct Range {
    std::uint32_t first, count;
  };

  std::optional<std::uint32_t> build(int mesh, std::size_t primitive, const Bending* bending);
  std::uint32_t build_triangles(int mesh, std::size_t primitive, const std::string& where,
                                const Bending* bending);
  /// Points and lines as triangles.
  std::uint32_t build_marks(int mesh, std::size_t primitive, const std::string& where);
  void spend_bent(int node);
  /// Moves the vertices by the targets of the primitive, as the node's weights at rest say.
  void morph(int mesh, std::size_t primitive, const std::string& where, int node, Vertices& vertices);
  [[nodiscard]] const std::vector<float>* weights_at_rest(int node) const;
  [[nodiscard]] DeformedMesh keep(int mesh, std::size_t primitive, const std::string& where,
                                  const Bending& bending, const Vertices& vertices);
  std::vector<glm::vec3> read_offsets(int accessor, std::size_t count, const char* name,
                                      const std::string& where);
  const std::vector<glm::dmat4>& joints_of(int skin);
  Attributes attributes_of(const tinygltf::Primitive& primitive) const;
  Vertices read_vertices(const Attributes& attributes, const std::string& where);
  template <class Vec>
  std::vector<Vec> read_optional(int accessor, std::size_t count, const char* name, const std::string& where);
  /// Numbers of vertices, all in range.
  std::vector<std::uint32_t> read_corners(int mesh, std::size_t primitive, std::size_t vertex_count,
                                          const std::string& where);
  std::vector<std::uint32_t> read_triangles(int mesh, std::size_t primitive, std::size_t vertex_count,
                                            const std::string& where);
  /// Drops triangles that vertex colours make invisible: by an alpha mask, or wholly transparent. Throws
  /// LeftOut where none is left.
  void drop_invisible(const tinygltf::Primitive& primitive, std::size_t vertex_count,
                      const std::string& where, std::vector<std::uint32_t>& triangles);
  Range append(const Vertices& vertices);
  std::uint32_t store(Range range, const std::vector<std::uint32_t>& triangles, int material);
  void spend_vertices(std::uint64_t count, const std::string& where);
  void spend_corners(std::uint64_t count, const std::string& where);

  const Document& document_;
  const NodeTree& tree_;
  const LoadLimits& limits_;
  MotionReader& motion_;
  Scene& scene_;
  std::map<std::uint32_t, DeformedMesh> deformed_;  // by primitive
  std::uint64_t vertices_left_, corners_left_;
  std::vector<std::optional<std::vector<std::uint32_t>>> built_;  // per mesh
  std::map<int, std::vector<glm::dmat4>> joints_;                 // per skin
  std::uint64_t bent_ = 0;                                        // primitives tried for one node alone
  std::map<Attributes, Range> shared_;                            // vertex data that several primitives use
};

}  // namespace gnomon::detail
