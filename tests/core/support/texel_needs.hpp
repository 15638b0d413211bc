// Needs of texels to try a shape with that follows what is seen.
#pragma once

#include <cmath>

#include "gnomon/shape.hpp"

namespace gnomon::test {

/// Largest at one place of each axis, 0..1.
inline TexelNeeds needs_round(double x, double y, int margin_texels) {
  TexelNeeds needs;
  needs.margin_texels = margin_texels;
  for (std::size_t i = 0; i < kNeedStrips; ++i) {
    const double at = (static_cast<double>(i) + 0.5) / kNeedStrips;
    needs.x[i] = 1.0 / (0.05 + std::abs(at - x));
    needs.y[i] = 1.0 / (0.02 + std::abs(at - y));
  }
  return needs;
}

}  // namespace gnomon::test
