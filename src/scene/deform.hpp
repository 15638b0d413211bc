// Where do joints carry vertices? For a mesh at rest and for every pose alike.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace gnomon::detail {

/// Joints of vertices, by how much each counts. Weights are finite and >= 0; joints that count are in range.
struct InfluenceView {
  std::uint32_t per_vertex = 0;
  std::span<const std::uint32_t> joints;  ///< per_vertex for each vertex
  std::span<const float> weights;         ///< the same
};

/// Moves vertices to where the joints carry them, world from mesh. `normals` may be empty. Returns how many
/// vertices lie where the joints mirror; positions may come out infinite.
std::size_t carry(const InfluenceView& influences, std::span<const glm::dmat4> joints,
                  std::span<glm::vec3> positions, std::span<glm::vec3> normals) noexcept;

}  // namespace gnomon::detail
