// Where do joints carry vertices? For a mesh at rest and for every pose alike.
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 3.7.3 "Skins".
#include "deform.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gnomon::detail {

namespace {

glm::dmat4 blend(const InfluenceView& influences, std::size_t vertex,
                 std::span<const glm::dmat4> joints) noexcept {
  glm::dmat4 sum(0.0);
  double total = 0.0;
  const std::size_t begin = vertex * influences.per_vertex;
  for (std::size_t i = begin; i < begin + influences.per_vertex; ++i) {
    const auto weight = static_cast<double>(influences.weights[i]);
    if (weight == 0.0) continue;
    sum += joints[influences.joints[i]] * weight;
    total += weight;
  }
  if (total == 0.0) {
    const std::uint32_t joint = influences.joints[begin];
    return joints[joint < joints.size() ? joint : 0];
  }
  return sum * (1.0 / total);
}

// The cofactor matrix carries normals like the inverse transpose does, and needs no inverse.
glm::dvec3 carry_normal(const glm::dmat3& m, const glm::dvec3& n) noexcept {
  const glm::dvec3 carried =
      glm::cross(m[1], m[2]) * n.x + glm::cross(m[2], m[0]) * n.y + glm::cross(m[0], m[1]) * n.z;
  return glm::determinant(m) < 0.0 ? -carried : carried;
}

}  // namespace

std::size_t carry(const InfluenceView& influences, std::span<const glm::dmat4> joints,
                  std::span<glm::vec3> positions, std::span<glm::vec3> normals) noexcept {
  std::size_t mirrored = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::dmat4 world = blend(influences, v, joints);
    positions[v] = glm::vec3(glm::dvec3(world * glm::dvec4(glm::dvec3(positions[v]), 1.0)));
    const glm::dmat3 turn(world);
    mirrored += glm::determinant(turn) < 0.0 ? 1u : 0u;
    if (normals.empty()) continue;
    const glm::dvec3 normal = carry_normal(turn, glm::dvec3(normals[v]));
    const double length = glm::length(normal);
    normals[v] = length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
  }
  return mirrored;
}

}  // namespace gnomon::detail
