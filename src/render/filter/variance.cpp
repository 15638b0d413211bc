// Chebyshev's bound.
#include "filter/variance.hpp"

namespace gnomon::render {

StoredTexel store_moments(double depth, const glm::dvec2& slope, double slope_share,
                          TexelFormat format) noexcept {
  const double u = 2.0 * depth - 1.0;
  // A plane of this slope has a quarter of the slope's square as variance over a texel; twice the slope in u.
  // At an edge the difference tells nothing of a surface: capped at what makes a tenth of the range.
  constexpr double kSteepest = 0.1;
  const double steep = glm::dot(slope, slope);
  const double within = slope_share * std::min(steep, kSteepest * kSteepest);
  StoredTexel texel{};
  texel[0] = is_unsigned_unit(format) ? depth : u;
  texel[1] = std::min(u * u + within, 1.0);
  return texel;
}

double chebyshev(double mean, double variance, double u) noexcept {
  if (!(u > mean)) return 1.0;
  const double away = u - mean;
  return saturate(variance / (variance + away * away));
}

double without_bleeding(double lit, double bleed) noexcept {
  return saturate((lit - bleed) / (1.0 - bleed));
}

double variance_visibility(const StoredTexel& texel, double depth, const VarianceLimits& limits,
                           TexelFormat format) noexcept {
  // Twice the rounding of the second moment and four times that of the first, which may be stored at half
  // scale.
  constexpr double kRoundings = 6.0;
  const double mean = is_unsigned_unit(format) ? 2.0 * texel[0] - 1.0 : texel[0];
  const double least = std::max(4.0 * limits.floor_share, kRoundings * rounding_of(format));
  const double variance = std::max(texel[1] - mean * mean, least);
  const double u = 2.0 * std::min(depth, 1.0) - 1.0;
  return without_bleeding(chebyshev(mean, variance, u), limits.bleed);
}

}  // namespace gnomon::render
