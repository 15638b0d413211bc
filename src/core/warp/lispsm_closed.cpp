// LiSPSM with the strength that is best for the whole frustum, in closed form: for plans that must cost next
// to nothing. Based on: Wimmer, Scherzer, Purgathofer, "Light Space Perspective Shadow Maps", 2004; Lloyd et
// al. 2006 (the error measure). The closed form is derived for this project.
#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"
#include "warp/formulas.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  const LightSpace& light = input.light;
  // A local light in the eye's own plane sees a frustum without an apex.
  if (input.orthographic || (light.perspective && light.apex.z == 0.0)) return input.unwarped;
  const ViewInLight& view = input.view;
  const double eye_y = light.perspective ? -light.apex.y / light.apex.z : 0.0;
  FrustumProfile profile{input.depth_begin, input.depth_end, 0.0, 0.0};
  if (light.perspective) {
    profile.near_depth = std::numeric_limits<double>::infinity();
    profile.far_depth = 0.0;
    for (const WarpInput::Point& p : input.body) {
      if (!std::isfinite(p.depth)) continue;
      profile.near_depth = min_of(profile.near_depth, p.depth);
      profile.far_depth = max_of(profile.far_depth, p.depth);
    }
  }
  // Slopes along y, per unit of Point::depth, of the four edges of the frustum; corners and not angles, so
  // that off-axis frusta are right too.
  for (int corner = 0; corner < 4; ++corner) {
    const double x = (corner & 1) != 0 ? view.image_right : view.image_left;
    const double y = (corner & 2) != 0 ? view.image_top : view.image_bottom;
    const double along_z = view.forward.z + view.right.z * x + view.up.z * y;
    const double k =
        view.forward.y + view.right.y * x + view.up.y * y + (light.perspective ? eye_y * along_z : 0.0);
    profile.k_low = corner == 0 ? k : min_of(profile.k_low, k);
    profile.k_high = corner == 0 ? k : max_of(profile.k_high, k);
  }
  const double kappa = storage_optimal_kappa(profile);
  if (!(kappa > 0.0)) return input.unwarped;
  // The same projection centre, as seen from the near end of the body.
  const double frustum_near =
      eye_y + min_of(profile.near_depth * profile.k_low, profile.far_depth * profile.k_low);
  return input.along_view(kappa / (1.0 + kappa * max_of(0.0, input.y_min - frustum_near)));
}

}  // namespace

const Warp lispsm_closed{"lispsm_closed", "LiSPSM, best strength for the whole frustum in closed form",
                         choose, true};

}  // namespace gnomon::warps
