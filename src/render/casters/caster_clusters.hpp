// Which parts of a large caster reach into a map? Runs of its triangles have bounds of their own.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gnomon/scene/scene.hpp"

namespace gnomon::render {

/// Entries of the index buffer that one draw takes.
struct IndexRun {
  std::uint32_t first_index = 0, index_count = 0;
};

/// A cluster is a number of triangles that follow each other: as they stand in the file where that keeps
/// neighbours together, else in a sorted copy. Only depths are drawn of copies, so that their order shows
/// nowhere.
class CasterClusters {
 public:
  explicit CasterClusters(const Scene& scene);

  /// Copies of indices, which the index buffer holds behind those of the scene.
  [[nodiscard]] std::span<const std::uint32_t> sorted_indices() const noexcept { return sorted_; }
  /// Vertices [first, first + count) move from now on: primitives with any of them have no clusters any more.
  void forget(std::uint32_t first, std::size_t count) noexcept;
  /// Whether parts of the primitive can be drawn.
  [[nodiscard]] bool has(std::uint32_t primitive) const noexcept {
    return parts_[primitive].cluster_count > 0;
  }
  /// All of the primitive's triangles, in the order of its clusters if it ever had any.
  [[nodiscard]] IndexRun whole(std::uint32_t primitive) const noexcept {
    return {parts_[primitive].first_index, parts_[primitive].index_count};
  }
  /// Runs of the primitive's triangles that may reach inside all planes; none outside of them. Planes are of
  /// the world. Valid until the next call.
  [[nodiscard]] std::span<const IndexRun> within(std::uint32_t primitive, const glm::dmat4& world_from_object,
                                                 std::span<const glm::dvec4> planes);

 private:
  /// Middle and half the size of bounds, object space, rounded outwards.
  struct Bounds {
    glm::vec3 middle{0.0f}, half{0.0f};
  };
  struct Part {
    std::uint32_t first_index = 0, index_count = 0;
    std::size_t first_cluster = 0, cluster_count = 0;  ///< none: the primitive is small, or its vertices move
    std::size_t first_group = 0;
    std::uint32_t first_vertex = 0, last_vertex = 0;
  };
  /// Adds the clusters of triangles in this order, and returns the sum of their surfaces.
  float add_clusters(const Scene& scene, std::span<const std::uint32_t> indices, Part& part);
  void drop_clusters(const Part& part);
  [[nodiscard]] bool outside(const Bounds& bounds) const noexcept;
  void add(const Part& part, std::size_t cluster);

  std::vector<Part> parts_;  ///< by primitive
  std::vector<Bounds> clusters_, groups_;
  std::vector<std::uint32_t> sorted_;
  std::vector<glm::vec4> planes_;  ///< of within(), object space
  std::vector<IndexRun> runs_;
};

}  // namespace gnomon::render
