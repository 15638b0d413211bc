// The uniform block of a filter's settings; shaders/pass/common/filter.glsl mirrors it.
#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "gnomon/plan.hpp"
#include "gnomon/render/filter.hpp"

namespace gnomon::render {

inline constexpr std::size_t kTapVectors = 9;  ///< 36 taps: the widest kernel reaches 32 texels

inline constexpr std::size_t kOptionVectors = kMaxFilterOptions / 4;

struct FilterBlock {
  glm::vec4 kernel, sums;
  std::array<glm::ivec4, kMaxMaps> reach;
  std::array<glm::vec4, kMaxMaps * kOptionVectors> options;
  std::array<glm::vec4, kMaxMaps * kTapVectors> weights;
  std::array<glm::vec4, kMaxMaps> depth_curve;
};
static_assert(sizeof(FilterBlock) == 16 * (2 + kMaxMaps * (2 + kOptionVectors + kTapVectors)),
              "std140 has no padding here");

/// Half the side of the box that each map's stored texels are blurred with, texels; 0: not blurred.
using BlurSides = std::array<double, kMaxMaps>;
/// In world units, the widest blur that is nowhere on the map wider than asked for: lookups add the rest.
[[nodiscard]] BlurSides blur_sides(const FilterSettings& settings, const ShadowPlan& plan) noexcept;

/// True where a lookup may have to average more than the stored texels' own blur did.
[[nodiscard]] bool wants_mipmaps(const FilterSettings& settings, const ShadowPlan& plan) noexcept;

/// Weights of the taps 0, 1, .. from the middle of a blur, which sum up to 1 over both sides. Answers how
/// many there are beyond the middle one.
int tap_weights(BlurShape shape, double half_side, std::array<double, 4 * kTapVectors>& weights) noexcept;

/// Lengths of a map that settings_for_map takes.
[[nodiscard]] MapDepths map_depths(const FilterSettings& settings, const ShadowMap& map) noexcept;
/// Options of one map.
void set_options(const FilterSettings& settings, std::size_t map, FilterBlock& block) noexcept;
/// shaders/library/lookup.glsl: depths of a local light's map made even in distance.
[[nodiscard]] inline double linear_depth(double depth, double curve) noexcept {
  return depth / (1.0 + (1.0 - depth) * curve);
}
/// The other way.
[[nodiscard]] inline double depth_from_linear(double linear, double curve) noexcept {
  return linear * (1.0 + curve) / (1.0 + linear * curve);
}
/// The curve of a map: for a local light far over near distance less 1 along its middle ray, 0 for parallel
/// light.
[[nodiscard]] double depth_curve(const ShadowPlan& plan, const ShadowMap& map) noexcept;
/// What makes a map's depths even along the light: clip z times this, in the clip space that maps are drawn
/// in. It is 1 over the largest clip z on the far plane. It is 0 for a map without an inverse, and for a map
/// that bends lines under a warp whose w grows more than 64 times across it: their depths are divided by w.
[[nodiscard]] double even_depth_scale(const ShadowPlan& plan, const ShadowMap& map) noexcept;
/// Curves, or minus even_depth_scale of maps with even depths: as ShadowMap of
/// shaders/library/shadow_map.glsl has them.
using DepthCurves = std::array<double, kMaxMaps>;
[[nodiscard]] DepthCurves depth_curves(const ShadowPlan& plan, bool even = false) noexcept;
void set_depth_curves(const DepthCurves& curves, FilterBlock& block) noexcept;

/// Options of each map of a plan.
void fit_options(const FilterSettings& settings, const ShadowPlan& plan, FilterBlock& block) noexcept;
/// With the same options for all maps, and no curve for any.
[[nodiscard]] FilterBlock filter_block(const FilterSettings& settings, const BlurSides& sides) noexcept;

/// Vectors of four channels that a stored texel of these settings takes, 1 where nothing is stored.
[[nodiscard]] int shadow_vectors(const FilterSettings& settings) noexcept;

}  // namespace gnomon::render
