// LiSPSM with the strength that is best for this body: the objective, exact at the body's vertices, minimised
// over kappa. Based on: Wimmer, Scherzer, Purgathofer, "Light Space Perspective Shadow Maps", 2004; Lloyd et
// al., "Warping and Partitioning for Low Error Shadow Maps", 2006 (the error measure). The search over the
// vertices is this project's.
#include "gnomon/extend/warp.hpp"
#include "warp/along_view.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  if (input.flat() || !(input.y_max - input.y_min > 0.0)) return input.unwarped;
  return input.along_view(AlongView(input).best().kappa);
}

}  // namespace

const Warp lispsm{"lispsm", "light-space perspective, strength chosen for the visible body", choose, true};

}  // namespace gnomon::warps
