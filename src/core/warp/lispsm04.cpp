// LiSPSM as first published: equal error along the view at both ends, scaled by 1 / sin(gamma).
// Based on: Wimmer, Scherzer, Purgathofer, "Light Space Perspective Shadow Maps", 2004; under local lights
// Wimmer, Scherzer, ShaderX4, 2006. Kept as published: it may be far worse than no warp where the light runs
// along the view.
#include <cmath>

#include "gnomon/extend/warp.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  const double length = input.y_max - input.y_min;
  const double z0 = input.scale_near;
  if (input.orthographic || !(input.depth_per_y > 0.0) || !(length > 0.0) || !(z0 > 0.0))
    return input.unwarped;
  const double z1 = z0 + length * input.depth_per_y;
  const double n = (z0 + std::sqrt(z0 * z1)) / input.depth_per_y;
  return input.along_view(1.0 / n);
}

}  // namespace

const Warp lispsm04{"lispsm04", "LiSPSM as published in 2004, for comparison", choose, false};

}  // namespace gnomon::warps
