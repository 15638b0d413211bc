// LiSPSM with Lloyd's fall-off: as strong as LiSPSM where the light is across the view, weaker towards the
// view, none within a third of the opening. Based on: Lloyd, "Logarithmic Perspective Shadow Maps", thesis,
// 2007, section 5.2. Kept as published.
#include <cmath>

#include "../elementary.hpp"
#include "../warp_formulas.hpp"
#include "gnomon/warp.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  const double length = input.y_max - input.y_min;
  if (input.orthographic || !(length > 0.0) || !(input.depth_end > input.depth_begin)) return {};
  const double gamma = elementary::atan2(input.sin_gamma, std::abs(input.cos_gamma));
  const double eta = lloyd_eta(gamma, elementary::atan(input.tan_half_fov));
  return {kappa_length_from_eta(eta, input.depth_end / input.depth_begin) / length};
}

}  // namespace

const Warp lispsm_lloyd{"lispsm_lloyd", "LiSPSM with Lloyd's fall-off over the light's angle", choose, false};

}  // namespace gnomon::warps
