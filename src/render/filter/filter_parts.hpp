// What the references of several filters share; shaders/library holds the same in GLSL.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <string_view>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// Half side of the box with the variance of a unit disc: sqrt(3) / 2.
constexpr double kBoxOfDisc = 0.8660254037844386;

/// compare.glsl: what a way of `offset` texels from the point is longer by than that many of the point's own
/// texels, in those: it may leave the point's piece of the map.
[[nodiscard]] inline glm::dvec2 beyond_piece(const FilterLookup& lookup, const glm::dvec2& offset) noexcept {
  return lookup.longer_below * glm::min(offset - lookup.ends_below, 0.0) +
         lookup.longer_above * glm::max(offset - lookup.ends_above, 0.0);
}

/// compare.glsl: the receiver's plane, `offset` texels from the point. It may go on behind the map's far
/// plane, where nothing is drawn: lit.
[[nodiscard]] inline double plane_depth(const FilterLookup& lookup, const glm::dvec2& offset) noexcept {
  const glm::dvec2 own_texels = offset + beyond_piece(lookup, offset);
  return std::min(lookup.depth + glm::dot(lookup.depth_gradient, own_texels), 1.0);
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

/// Options that several filters have. Lists name them as option::NAME: cmake/option_names.cmake reads that.
namespace option {
/// For the filters whose kernel can cover the pixel.
inline constexpr FilterOption footprint{
    "footprint", 0, 0, 1, "1 widens the kernel to the pixel's footprint, at most 32 texels to each side",
    true};
/// For the filters of a light with a size.
inline constexpr FilterOption angle_deg{
    "angle_deg", 2.0, 0.01, 60.0, "apparent diameter of a directional light, degrees; the sun has 0.53"};
inline constexpr FilterOption light_radius{"light_radius", 0.25, 1e-6, 1e6,
                                           "radius of a local light, world units"};
/// For the filters whose shadows fade in over a length along the light.
inline constexpr FilterOption falloff_world{
    "falloff_world", 0.0, 0.0, 1e6,
    "least distance over which a caster's shadow fades in behind it, world units: alike in all maps"};
[[nodiscard]] constexpr FilterOption falloff_kernel(double fallback) noexcept {
  return {"falloff_kernel", fallback, 0.0, 1000.0,
          "the same in half widths of the kernel; the longer of both counts"};
}
}  // namespace option

/// Where FilterSettings::option holds the options of a filter, by their names.
class OptionPlaces {
 public:
  consteval explicit OptionPlaces(std::span<const FilterOption> options,
                                  std::span<const std::string_view> own = {})
      : options_(options), own_(own) {}
  /// Does not compile where neither list has an option of that name.
  [[nodiscard]] consteval std::size_t operator()(std::string_view name) const {
    for (std::size_t i = 0; i < options_.size(); ++i)
      if (options_[i].name == name) return i;
    for (std::size_t i = 0; i < own_.size(); ++i)
      if (own_[i] == name) return options_.size() + i;
    throw "the filter has no option of that name";
  }

 private:
  std::span<const FilterOption> options_;
  std::span<const std::string_view> own_;
};

/// penumbra.glsl: radius of the light's disc seen through a point `away` from the receiver, across the light
/// at the receiver, world units.
[[nodiscard]] double penumbra_radius(double angle_deg, double light_radius, double away,
                                     double light_distance) noexcept;
/// The same by the options of a filter.
template <const OptionPlaces& kPlace>
[[nodiscard]] double penumbra_radius(const FilterSettings& settings, double away,
                                     double light_distance) noexcept {
  return penumbra_radius(settings.option[kPlace("angle_deg")], settings.option[kPlace("light_radius")], away,
                         light_distance);
}

/// caster.glsl: the longer axis of an ellipse.
[[nodiscard]] inline double widest_axis(const glm::dmat2& disc) noexcept {
  return std::sqrt(std::max(glm::dot(disc[0], disc[0]), glm::dot(disc[1], disc[1])));
}
/// caster.glsl: distance to what the texel under `offset` stores, world units; below 0 where that is not in
/// front of the receiver's plane.
[[nodiscard]] inline double caster_at(const FilterLookup& lookup, const glm::dvec2& offset) {
  const glm::dvec2 texel = lookup.position + offset, cell{std::floor(texel.x), std::floor(texel.y)};
  const double stored = lookup.map_depth(static_cast<int>(cell.x), static_cast<int>(cell.y));
  if (plane_depth(lookup, cell + 0.5 - lookup.position) <= stored) return -1.0;
  return std::max(distance_to_depth(lookup, stored), 0.0);
}

/// The values of option::falloff_world and option::falloff_kernel.
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

template <const OptionPlaces& kPlace>
[[nodiscard]] Falloff falloff_of(const FilterSettings& settings) noexcept {
  return {settings.option[kPlace("falloff_world")], settings.option[kPlace("falloff_kernel")]};
}

/// Clamps to [0, 1]; not-a-number becomes 1, lit.
[[nodiscard]] inline double saturate(double value) noexcept {
  return value < 1.0 ? std::max(value, 0.0) : 1.0;
}

}  // namespace gnomon::render
