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

/// Options of the filters of a light with a size, which lists them first and in this order.
inline constexpr FilterOption kLightAngle{
    "angle_deg", 2.0, 0.01, 60.0, "apparent diameter of a directional light, degrees; the sun has 0.53"};
inline constexpr FilterOption kLightRadius{"light_radius", 0.25, 1e-6, 1e6,
                                           "radius of a local light, world units"};
/// penumbra.glsl: radius of the light's disc seen through a point `away` from the receiver, across the light
/// at the receiver, world units.
[[nodiscard]] double penumbra_radius(const FilterSettings& settings, double away,
                                     double light_distance) noexcept;

/// Options of the filters whose shadows fade in over a length along the light.
inline constexpr FilterOption kFalloffWorld{
    "falloff_world", 0.0, 0.0, 1e6,
    "least distance over which a caster's shadow fades in behind it, world units: alike in all maps"};
[[nodiscard]] constexpr FilterOption falloff_kernel(double fallback) noexcept {
  return {"falloff_kernel", fallback, 0.0, 1000.0,
          "the same in half widths of the kernel; the longer of both counts"};
}

/// The values of both.
struct Falloff {
  double world = 0.0, kernels = 0.0;
  /// World units; 0: none asked for.
  [[nodiscard]] double length(const MapDepths& depths) const noexcept {
    return std::max(world, kernels * depths.kernel_world);
  }
};
/// The exponent over a map's depth range at which exp(-c d) falls to 1/20 over the fall-off, between 1 and
/// `most`, which is the result where lengths are unknown.
[[nodiscard]] inline double exponent_for(double most, const Falloff& falloff,
                                         const MapDepths& depths) noexcept {
  constexpr double kFaded = 2.995732273553991;  // ln(20)
  const double length = falloff.length(depths);
  if (!(length > 0.0) || !(depths.range_world > 0.0)) return most;
  return std::min(most, std::max(kFaded * depths.range_world / length, 1.0));
}

/// Clamps to [0, 1]; not-a-number becomes 1, lit.
[[nodiscard]] inline double saturate(double value) noexcept {
  return value < 1.0 ? std::max(value, 0.0) : 1.0;
}

}  // namespace gnomon::render
