// LiSPSM as first published: equal error along the view at both ends, scaled by 1 / sin(gamma).
// Based on: Wimmer, Scherzer, Purgathofer, "Light Space Perspective Shadow Maps", 2004. Kept as published: it
// may be far worse than no warp where the light runs along the view.
#include <cmath>

#include "gnomon/warp.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  const double length = input.y_max - input.y_min;
  if (input.orthographic || !(input.sin_gamma > 0.0) || !(length > 0.0) || !(input.depth_begin > 0.0))
    return {};
  const double z0 = input.depth_begin;
  const double z1 = z0 + length * input.sin_gamma;
  const double n = (z0 + std::sqrt(z0 * z1)) / input.sin_gamma;
  return {1.0 / n};
}

}  // namespace

const Warp lispsm04{"lispsm04", "LiSPSM as published in 2004, for comparison", choose, false};

}  // namespace gnomon::warps
