// Single precision for searches in lanes: their errors need three digits.
#pragma once

#include <array>

#include "warp/error_samples.hpp"

namespace gnomon {

// Those of vector.hpp widen their arguments.
[[nodiscard]] constexpr float min_of(float a, float b) noexcept {
  return a < b ? a : b;
}
[[nodiscard]] constexpr float max_of(float a, float b) noexcept {
  return a > b ? a : b;
}

/// Gains below this are rounding: the first of two that mirror each other is taken, wherever the world stands
/// and whatever its unit.
inline constexpr float kSingleTie = 1.0F - 1e-5F;

/// Kappa times length of the strongest warp that single precision resolves.
inline constexpr double kMaxReach = 2e4;

/// Cosine and sine of an angle up to 1.
struct Turn {
  float cosine = 1.0F, sine = 0.0F;
  constexpr Turn() noexcept = default;
  explicit constexpr Turn(float angle) noexcept {
    const float square = angle * angle;
    cosine = 1.0F - square * (0.5F - square * (1.0F / 24.0F - square * (1.0F / 720.0F)));
    sine = angle * (1.0F - square * (1.0F / 6.0F - square * (1.0F / 120.0F - square * (1.0F / 5040.0F))));
  }
};

/// Samples with the squared extents of a pixel there: J J^T over the square of J's determinant, and one over
/// that determinant.
template <std::size_t most>
struct FormLanes {
  alignas(64) std::array<float, most> x, y, xx, xy, yy, inverse;
  /// A sample's numbers, of which loops keep copies: what they write might be these, for all that the
  /// compiler knows.
  struct Form {
    float x, y, xx, xy, yy, inverse;
  };
  [[nodiscard]] Form at(std::size_t i) const noexcept {
    return {x[i], y[i], xx[i], xy[i], yy[i], inverse[i]};
  }
};

}  // namespace gnomon
