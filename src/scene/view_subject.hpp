// What would a person look at in a scene? Its pieces without skies, grounds, backdrops and what strayed far
// away.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/scene/scene.hpp"

namespace gnomon::detail {

/// Triangles of one instance that belong together.
struct Piece {
  const Instance* instance = nullptr;
  std::vector<std::uint32_t> triangles;  ///< the first of their three entries of Scene::indices
  Box bounds;                            ///< world
  glm::dvec3 normal_area{0.0};           ///< sum of normals times areas, world

  [[nodiscard]] double extent() const noexcept;
};

/// The corners of a triangle, world space. `first` is an entry of Scene::indices.
[[nodiscard]] std::array<glm::dvec3, 3> corners_of(const Scene& scene, const Instance& instance,
                                                   std::uint32_t first) noexcept;

[[nodiscard]] bool is_two_sided(const Scene& scene, const Piece& piece) noexcept;

struct ViewSubject {
  std::vector<Piece> pieces;  ///< what the scene is about; empty where no instance has a triangle
  std::vector<Piece> lands;   ///< uneven grounds that are not looked at, and that may hide the rest
  std::vector<Piece> skies;   ///< that surround the rest, face it, and are not looked at
  Box bounds;                 ///< of `pieces`
  bool grounded = false;      ///< level pieces at the foot are at least as wide as the rest
  bool all = true;            ///< nothing was omitted
};

[[nodiscard]] ViewSubject view_subject(const Scene& scene);

}  // namespace gnomon::detail
