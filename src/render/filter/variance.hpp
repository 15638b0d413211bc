// Two moments: shared by the filters that store them. shaders/library/variance.glsl mirrors it.
#pragma once

#include "filter/filter_parts.hpp"

namespace gnomon::render {

/// Moments of u = 2 depth - 1, whose numbers are the smallest for what they tell: u and u^2, or the depth in
/// the place of u where only [0, 1] can be stored. The second moment includes `slope_share` of the slope
/// within a texel.
[[nodiscard]] StoredTexel store_moments(double depth, const glm::dvec2& slope, double slope_share,
                                        TexelFormat format) noexcept;

struct VarianceLimits {
  double bleed;        ///< visibility up to this becomes 0
  double floor_share;  ///< least variance, of the depth range squared
};
/// The visibility of a receiver at that depth.
[[nodiscard]] double variance_visibility(const StoredTexel& texel, double depth, const VarianceLimits& limits,
                                         TexelFormat format) noexcept;

/// The same by the options `bleed`, `floor` and `slope` of a filter: FilterReference::store and visibility,
/// and FilterHooks::reads_slope.
template <const OptionPlaces& kPlace>
[[nodiscard]] StoredTexel store_moments(double depth, const glm::dvec2& slope,
                                        const FilterSettings& settings) noexcept {
  return store_moments(depth, slope, settings.option[kPlace("slope")], settings.format);
}
template <const OptionPlaces& kPlace>
[[nodiscard]] double variance_visibility(const StoredTexel& texel, const FilterLookup& lookup,
                                         const FilterSettings& settings) {
  return variance_visibility(texel, lookup.depth,
                             {settings.option[kPlace("bleed")], settings.option[kPlace("floor")]},
                             settings.format);
}
template <const OptionPlaces& kPlace>
[[nodiscard]] bool reads_slope(const FilterSettings& settings) noexcept {
  return settings.option[kPlace("slope")] > 0.0;
}

/// Chebyshev's one-sided bound for a receiver at u: 1 up to the mean, else variance / (variance + (u -
/// mean)^2).
[[nodiscard]] double chebyshev(double mean, double variance, double u) noexcept;
/// Answers below `bleed` become 0, and what is above is stretched to 1.
[[nodiscard]] double without_bleeding(double lit, double bleed) noexcept;

}  // namespace gnomon::render
