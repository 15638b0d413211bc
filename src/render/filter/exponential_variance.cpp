// The variance bound under an exponential.
#include "filter/exponential_variance.hpp"

namespace gnomon::render {

double largest_exponent(TexelFormat format) noexcept {
  // ln(65504) / 2 = 5.5449; ln(3.4e38) / 2 = 44.36, less headroom for what is added up before it is weighted.
  return format == TexelFormat::fp16 ? 5.54 : 42.0;
}

double warp_exponent(double most, const Falloff& falloff, const MapDepths& depths) noexcept {
  return 0.5 * exponent_for(2.0 * most, falloff, depths);
}

std::array<double, 2> warped_moments(double depth, double c) noexcept {
  const double w = std::exp(c * (2.0 * depth - 1.0));
  return {w, w * w};
}

double warped_bound(double mean, double square, double depth, double c, double sign, double least,
                    double rounding) noexcept {
  // Of the second moment, and of the mean's square.
  constexpr double kRoundings = 4.0;
  const double w = std::exp(sign * c * (2.0 * depth - 1.0));
  const double middle = sign * mean, at = sign * w;
  if (!(at > middle)) return 1.0;
  const double floor_at = 2.0 * least * c * w;
  const double variance =
      std::max(square - middle * middle, std::max(floor_at * floor_at, kRoundings * rounding * square));
  return chebyshev(middle, variance, at);
}

}  // namespace gnomon::render
