// Depths warped by exponentials: shared by evsm2 and evsm4. shaders/library/exponential_variance.glsl mirrors
// it.
#pragma once

#include <array>

#include "filter/filter_parts.hpp"
#include "filter/variance.hpp"

namespace gnomon::render {

/// Largest exponent whose square a format holds, with room for sums: exp(2 c) stays below its largest number.
[[nodiscard]] double largest_exponent(TexelFormat format) noexcept;

/// exponent_for of filter_parts.hpp, over half the depth range.
[[nodiscard]] double warp_exponent(double most, const Falloff& falloff, const MapDepths& depths) noexcept;

/// Options of both, and the formats whose range the exponentials have use for.
namespace option {
inline constexpr FilterOption c{
    "c", 40.0, 0.5, 42.0,
    "largest exponent over half the depth range: larger bleeds less; at most 5.54 in half floats"};
inline constexpr FilterOption bleed{
    "bleed", 0.1, 0.0, 0.95,
    "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"};
inline constexpr FilterOption floor{
    "floor", 1e-4, 0.0, 0.1,
    "least standard deviation, as a share of the depth range; never below the format's rounding"};
}  // namespace option
inline constexpr TexelFormat kExponentialFormats[] = {TexelFormat::fp32, TexelFormat::fp16};

/// FilterHooks::fit_map of both.
template <const OptionPlaces& kPlace>
void fit_exponent(FilterSettings& settings, const MapDepths& depths) noexcept {
  double& c = settings.option[kPlace("c")];
  c = warp_exponent(c, falloff_of<kPlace>(settings), depths);
}

/// exp(c u) of u = 2 depth - 1, and its square.
[[nodiscard]] std::array<double, 2> warped_moments(double depth, double c) noexcept;

/// The variance bound in one warp: exp(c u) for `sign` 1, -exp(-c u) for -1, of which the moments of exp(-c
/// u) are given. `least`: a standard deviation, of the depth range; the warp's derivative takes it along.
[[nodiscard]] double warped_bound(double mean, double square, double depth, double c, double sign,
                                  double least, double rounding) noexcept;

}  // namespace gnomon::render
