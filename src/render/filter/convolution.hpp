// The step function's Fourier series, as convolution shadow maps take it.
#pragma once

#include "filter/filter_parts.hpp"

namespace gnomon::render {

/// Terms and what they are damped by.
struct FourierStep {
  int order = 16;            ///< terms M, 1..16
  double attenuation = 0.0;  ///< term k counts exp(-attenuation (k / M)^2)
};
/// Lit or not of a receiver at depth d over texels whose means of cos(c_k z), sin(c_k z), c_k = pi (2 k - 1),
/// are channels 2 k - 2 and 2 k - 1: 1/2 + 2 sum a_k / c_k (cos(c_k d) sin_k - sin(c_k d) cos_k). Not
/// clamped. The series has period 2 in d - z, and is 1/2 at differences of -1, 0 and 1. Equation 11 of the
/// paper, as printed, is 1 behind the occluder.
[[nodiscard]] double fourier_lit(const StoredTexel& basis, double depth, const FourierStep& step) noexcept;
/// The basis of one depth.
[[nodiscard]] StoredTexel fourier_basis(double depth, int order) noexcept;

/// Half the distance over which the series steps from dark to lit, of its period of 2: half the shortest
/// wave.
[[nodiscard]] inline double fourier_half_step(int order) noexcept {
  return 0.5 / order;
}

}  // namespace gnomon::render
