// Solids out of triangles: what builtin scenes are made of. Counter-clockwise outside, flat or smooth
// normals.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gnomon::detail {

/// Numbers that are the same on every machine and library (PCG32; O'Neill 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 6364136223846793005ull + kIncrement) { next(); }
  std::uint32_t next() noexcept {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + kIncrement;
    const auto mixed = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
    const auto turn = static_cast<std::uint32_t>(old >> 59u);
    return (mixed >> turn) | (mixed << ((32u - turn) & 31u));
  }
  /// In [low, high).
  double uniform(double low, double high) noexcept {
    return low + (high - low) * static_cast<double>(next()) * 0x1p-32;
  }

 private:
  static constexpr std::uint64_t kIncrement = 1442695040888963407ull;
  std::uint64_t state_;
};

/// Triangles of one material, in object space.
class MeshBuilder {
 public:
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> texcoords;
  std::vector<std::uint32_t> indices;

  /// A flat four-sided face, corners counter-clockwise seen from outside; texture coordinates over the unit
  /// square from `a`.
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);
  /// A closed box along the axes.
  void box(const glm::dvec3& min, const glm::dvec3& max);
  /// A closed bar of square section from `a` to `b`, `width` across. `a` and `b` differ.
  void bar(const glm::dvec3& a, const glm::dvec3& b, double width);
  /// A closed round bar, smooth round about, from `a` (radius `ra`) to `b` (radius `rb`, 0: a cone).
  void cylinder(const glm::dvec3& a, const glm::dvec3& b, double ra, double rb, int sides);
  /// A closed lump: a sphere of rings x sides pushed in and out by up to `rough` of its radius.
  void boulder(const glm::dvec3& center, double radius, double rough, int rings, int sides, Random& random);
  /// A roof: a closed prism of triangular section on the rectangle min..max, its ridge along z, `height`
  /// high.
  void gable(const glm::dvec3& min, const glm::dvec3& max, double height);

  std::uint32_t vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec2& texcoord);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    indices.insert(indices.end(), {a, b, c});
  }
};

/// translate * rotate about +Y by `turn_radians` * uniform scale.
[[nodiscard]] glm::dmat4 placed(const glm::dvec3& at, double turn_radians = 0.0, double scale = 1.0);
[[nodiscard]] glm::dmat4 placed(const glm::dvec3& at, double turn_radians, const glm::dvec3& scale);

}  // namespace gnomon::detail
