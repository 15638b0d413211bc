// LiSPSM with the strength that is best for the whole frustum, in closed form: for plans that must cost next
// to nothing. Based on: Wimmer, Scherzer, Purgathofer, "Light Space Perspective Shadow Maps", 2004; Lloyd et
// al. 2006 (the error measure). The closed form is derived for this project.
#include "../vector.hpp"
#include "../warp_formulas.hpp"
#include "gnomon/warp.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  if (input.orthographic) return {};
  const ViewInLight& view = input.view;
  // Slopes along y of the four edges of the frustum; corners and not angles, so that off-axis frusta are
  // right too.
  FrustumProfile profile{input.depth_begin, input.depth_end, 0.0, 0.0};
  for (int corner = 0; corner < 4; ++corner) {
    const double x = (corner & 1) != 0 ? view.image_right : view.image_left;
    const double y = (corner & 2) != 0 ? view.image_top : view.image_bottom;
    const double k = view.forward.y + view.right.y * x + view.up.y * y;
    profile.k_low = corner == 0 ? k : min_of(profile.k_low, k);
    profile.k_high = corner == 0 ? k : max_of(profile.k_high, k);
  }
  const double kappa = storage_optimal_kappa(profile);
  if (!(kappa > 0.0)) return {};
  // The same projection centre, as seen from the near end of the body.
  const double frustum_near = min_of(input.depth_begin * profile.k_low, input.depth_end * profile.k_low);
  return {kappa / (1.0 + kappa * max_of(0.0, input.y_min - frustum_near))};
}

}  // namespace

const Warp lispsm_closed{"lispsm_closed", "LiSPSM, best strength for the whole frustum in closed form",
                         choose, true};

}  // namespace gnomon::warps
