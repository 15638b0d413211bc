// What is a fall-off of texels in numbers of a warp? Both precisions of the search share these.
#pragma once

#include "lanes/elementary.hpp"

namespace gnomon {

/// Shares of an extent below which another is rounding.
inline constexpr double kFlattest = 1e-6;
/// Kappa times length, beyond which float matrices end, has this fall-off at most.
inline constexpr float kStrongest = 43.0F;

/// Kappa times length of a fall-off: nearly its exponential less 1, for four multiplications.
template <typename Number>
Number reach_of(Number fall_off) noexcept {
  const auto strongest = static_cast<Number>(kStrongest);
  const Number root = 1 + (fall_off < strongest ? fall_off : strongest) * static_cast<Number>(0.0625);
  const Number power2 = root * root, power4 = power2 * power2, power8 = power4 * power4;
  return power8 * power8 - 1;
}
/// The fall-off whose w has this logarithm of its ratio from end to end.
inline double fall_off_of(double log_ratio) noexcept {
  return 16.0 * elementary::expm1(log_ratio * (1.0 / 16.0));
}

}  // namespace gnomon
