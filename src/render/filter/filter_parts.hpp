// What the references of several filters share; shaders/library holds the same in GLSL.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// compare.glsl: the receiver's plane, `offset` texels from the point. It may go on behind the map's far
/// plane, where nothing is drawn: lit.
[[nodiscard]] inline double plane_depth(const FilterLookup& lookup, const glm::dvec2& offset) noexcept {
  return std::min(lookup.depth + glm::dot(lookup.depth_gradient, offset), 1.0);
}

/// compare.glsl: four comparisons round `texel`, each with the plane at its texel, weighted bilinearly.
[[nodiscard]] inline double compare_2x2(const FilterLookup& lookup, const glm::dvec2& texel) {
  const glm::dvec2 first{std::floor(texel.x - 0.5), std::floor(texel.y - 0.5)};
  const glm::dvec2 part = texel - 0.5 - first;
  double sum = 0.0;
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) {
      const glm::dvec2 cell = first + glm::dvec2(x, y);
      if (plane_depth(lookup, cell + 0.5 - lookup.position) >
          lookup.map_depth(static_cast<int>(cell.x), static_cast<int>(cell.y))) {
        continue;
      }
      sum += (x == 0 ? 1.0 - part.x : part.x) * (y == 0 ? 1.0 - part.y : part.y);
    }
  }
  return sum;
}

/// disc.glsl: points spread over the unit disc.
[[nodiscard]] glm::dvec2 vogel_point(int i, int count, double angle) noexcept;
[[nodiscard]] glm::dvec2 poisson_point(int i, double angle) noexcept;

/// lookup.glsl: towards the light to where the map's depth is z, world units.
[[nodiscard]] inline double distance_to_depth(const FilterLookup& lookup, double z) noexcept {
  const double slope = lookup.ray.z - z * lookup.ray.w;
  return slope == 0.0 ? 0.0 : (lookup.ray.x - z * lookup.ray.y) / slope;
}

/// Clamps to [0, 1]; not-a-number becomes 1, lit.
[[nodiscard]] inline double saturate(double value) noexcept {
  return value < 1.0 ? std::max(value, 0.0) : 1.0;
}

}  // namespace gnomon::render
