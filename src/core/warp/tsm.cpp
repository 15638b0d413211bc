// Trapezoidal shadow maps: a warp that gives 80 % of the map to a focus region near the viewer.
// Based on: Martin and Tan, "Anti-aliasing and Continuity with Trapezoidal Shadow Maps", 2004. The focus is
// put where the logarithm of depth is halved: the paper leaves it to the user.
#include <cmath>

#include "geometry/vector.hpp"
#include "gnomon/extend/warp.hpp"
#include "warp/formulas.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  const double length = input.y_max - input.y_min;
  if (input.orthographic || !(length > 0.0) || !(input.depth_begin > 0.0)) return input.unwarped;
  const double focus_depth = std::sqrt(input.depth_begin) * std::sqrt(input.depth_end);
  const glm::dvec3 focus = input.view.forward * focus_depth;
  // A focus behind a local light is beyond the far end.
  const bool seen = input.light.distance(focus) > 0.0;
  const double y = seen ? input.light.project(focus).y : input.y_max;
  const double delta = clamp_to(y - input.y_min, 0.0, length);
  const double distance = trapezoid_distance(length, delta);
  return input.along_view(distance > 0.0 ? 1.0 / distance : 0.0);
}

}  // namespace

const Warp tsm{"tsm", "trapezoidal: 80 % of the map for the nearer half of the depths", choose, true};

}  // namespace gnomon::warps
