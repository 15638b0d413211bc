// LiSPSM with Lloyd's fall-off: as strong as LiSPSM where the light is across the view, weaker towards the
// view, none within a third of the opening. Based on: Lloyd, "Logarithmic Perspective Shadow Maps", thesis,
// 2007, section 5.2. Kept as published.
#include <cmath>

#include "geometry/vector.hpp"
#include "gnomon/extend/warp.hpp"
#include "lanes/elementary.hpp"
#include "warp/formulas.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  const double length = input.y_max - input.y_min;
  if (input.orthographic || !(length > 0.0) || !(input.depth_end > input.depth_begin) ||
      (input.light.perspective && !(input.scale_near > 0.0)))
    return input.unwarped;
  const double gamma = elementary::atan2(input.sin_gamma, std::abs(input.cos_gamma));
  const double eta = lloyd_eta(gamma, elementary::atan(input.tan_half_fov));
  const double alpha = input.light.perspective
                           ? 1.0 + length * max_of(0.0, input.depth_per_y) / input.scale_near
                           : input.depth_end / input.depth_begin;
  return input.along_view(kappa_length_from_eta(eta, alpha) / length);
}

}  // namespace

const Warp lispsm_lloyd{"lispsm_lloyd", "LiSPSM with Lloyd's fall-off over the light's angle", choose, false};

}  // namespace gnomon::warps
