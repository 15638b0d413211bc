// Which triangles stand for points and lines, which have no width of their own?
#include "marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "gltf_mesh.hpp"
#include "gnomon/bounds.hpp"

namespace gnomon::detail {
namespace {

// Corners in the order -X, +X, -Y, +Y, -Z, +Z; each face is seen counter-clockwise from outside.
constexpr std::array<std::array<std::uint32_t, 3>, kPointTriangles> kFaces{
    {{1, 3, 5}, {3, 0, 5}, {0, 2, 5}, {2, 1, 5}, {3, 1, 4}, {0, 3, 4}, {2, 0, 4}, {1, 2, 4}}};

void add(const Vertices& of, std::uint32_t corner, const glm::vec3& normal, float distance, Vertices& out) {
  out.positions.push_back(of.positions[corner] + normal * distance);
  out.normals.push_back(normal);
  out.texcoords.push_back(of.texcoords[corner]);
}

}  // namespace

std::vector<std::uint32_t> line_list(int mode, std::span<const std::uint32_t> corners) {
  constexpr int kLines = 1, kLoop = 2;
  std::vector<std::uint32_t> pairs;
  for (std::size_t i = 0; i + 1 < corners.size(); i += mode == kLines ? 2 : 1) {
    pairs.push_back(corners[i]);
    pairs.push_back(corners[i + 1]);
  }
  if (mode == kLoop && corners.size() > 2) {
    pairs.push_back(corners.back());
    pairs.push_back(corners.front());
  }
  return pairs;
}

float guessed_width(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners,
                    bool points) {
  constexpr double kOfSpacing = 0.5, kMostOfExtent = 1.0 / 50.0, kLine = 1.0 / 250.0;
  Box box;
  for (const std::uint32_t corner : corners) box.extend(glm::dvec3(positions[corner]));
  if (box.empty()) return 0.0f;
  const double extent = glm::length(box.max - box.min);
  const double spacing = 1.0 / std::sqrt(static_cast<double>(corners.size()));
  return static_cast<float>(extent * (points ? std::min(kOfSpacing * spacing, kMostOfExtent) : kLine));
}

Vertices point_marks(const Vertices& of, std::span<const std::uint32_t> corners, float width,
                     std::vector<std::uint32_t>& triangles) {
  Vertices out;
  for (const std::uint32_t corner : corners) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.0f, 1.0f}) {
        glm::vec3 normal(0.0f);
        normal[axis] = side;
        add(of, corner, normal, 0.5f * width, out);
      }
    for (const auto& face : kFaces)
      for (const std::uint32_t k : face) triangles.push_back(first + k);
  }
  return out;
}

Vertices line_marks(const Vertices& of, std::span<const std::uint32_t> pairs, float width,
                    std::vector<std::uint32_t>& triangles) {
  Vertices out;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const glm::dvec3 along = glm::dvec3(of.positions[pairs[i + 1]]) - glm::dvec3(of.positions[pairs[i]]);
    const double length = glm::length(along);
    if (!(length > 0.0)) continue;
    const glm::dvec3 ahead = along / length;
    // Across the line, off the axis that it follows least.
    const glm::dvec3 size = glm::abs(ahead);
    glm::dvec3 other(0.0);
    other[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1.0;
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, other)), up = glm::cross(right, ahead);
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    const float out_of_middle = width * std::sqrt(0.5f);
    for (const std::uint32_t end : {pairs[i], pairs[i + 1]})
      for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
        add(of, end, glm::vec3(glm::normalize(right * x + up * y)), out_of_middle, out);
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      for (const std::uint32_t k : {a, b, c, a, c, d}) triangles.push_back(first + k);
    };
    for (std::uint32_t k = 0; k < 4; ++k) quad(k, 4 + k, 4 + (k + 1) % 4, (k + 1) % 4);
    quad(0, 1, 2, 3);
    quad(7, 6, 5, 4);
  }
  return out;
}

}  // namespace gnomon::detail
