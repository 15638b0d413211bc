// Two moments: shared by the filters that store them. shaders/library/variance.glsl mirrors it.
#pragma once

#include "filter/filter_parts.hpp"

namespace gnomon::render {

/// Moments of u = 2 depth - 1, whose numbers are the smallest for what they tell: u and u^2, or the depth in
/// the place of u where only [0, 1] can be stored. Options: bleed, floor, slope.
[[nodiscard]] StoredTexel store_moments(double depth, const glm::dvec2& slope,
                                        const FilterSettings& settings) noexcept;
/// FilterHooks::reads_slope of the filters whose third option is `slope`.
[[nodiscard]] bool reads_slope(const FilterSettings& settings) noexcept;
[[nodiscard]] double variance_visibility(const StoredTexel& texel, const FilterLookup& lookup,
                                         const FilterSettings& settings);

/// Chebyshev's one-sided bound for a receiver at u: 1 up to the mean, else variance / (variance + (u -
/// mean)^2).
[[nodiscard]] double chebyshev(double mean, double variance, double u) noexcept;
/// Answers below `bleed` become 0, and what is above is stretched to 1.
[[nodiscard]] double without_bleeding(double lit, double bleed) noexcept;

}  // namespace gnomon::render
