// How do strips, fans and plain lists become triangles, and what normals do triangles have that name none?
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 3.7.2.1.
#include "triangles.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace gnomon::detail {

namespace {

constexpr int kStrip = 5, kFan = 6;
constexpr glm::vec3 kUp{0.0f, 1.0f, 0.0f};

// In double: the cross product of float edges overflows for large models and vanishes for tiny ones.
glm::dvec3 area_vector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

glm::vec3 unit_or_up(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : kUp;
}

bool is_usable(const glm::vec3& n) {
  const double length = glm::length(glm::dvec3(n));
  return std::isfinite(length) && length > 1e-6;  // exporters write 0 for unknown; below this is noise of it
}

}  // namespace

std::vector<std::uint32_t> triangle_list(int mode, std::vector<std::uint32_t> corners) {
  if (mode != kStrip && mode != kFan) {
    corners.resize(corners.size() / 3 * 3);
    return corners;
  }
  std::vector<std::uint32_t> out;
  if (corners.size() < 3) return out;
  out.reserve((corners.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    std::uint32_t a = corners[i], b = corners[i + 1 + i % 2], c = corners[i + 2 - i % 2];
    if (mode == kFan) {
      a = corners[i + 1];
      b = corners[i + 2];
      c = corners[0];
    }
    if (a == b || b == c || c == a) continue;
    out.insert(out.end(), {a, b, c});
  }
  return out;
}

glm::vec3 face_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return unit_or_up(area_vector(a, b, c));
}

std::size_t repair_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles,
                           std::span<glm::vec3> normals, std::uint32_t first) {
  std::size_t broken = 0;
  for (const glm::vec3& n : normals) broken += is_usable(n) ? 0u : 1u;
  std::vector<glm::dvec3> sums(broken > 0 ? positions.size() : 0, glm::dvec3(0.0));
  for (std::size_t i = 0; broken > 0 && i + 2 < triangles.size(); i += 3) {
    const std::uint32_t a = triangles[i] - first, b = triangles[i + 1] - first, c = triangles[i + 2] - first;
    const glm::dvec3 area = area_vector(positions[a], positions[b], positions[c]);
    for (const std::uint32_t v : {a, b, c}) sums[v] += area;
  }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    normals[v] = is_usable(normals[v]) ? unit_or_up(glm::dvec3(normals[v])) : unit_or_up(sums[v]);
  }
  return broken;
}

}  // namespace gnomon::detail
