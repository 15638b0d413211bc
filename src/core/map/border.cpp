// The border of a map that filter kernels need: no receiver falls into it.
#include "map/border.hpp"

#include <cmath>

#include "geometry/vector.hpp"

namespace gnomon {

int border_texels(const PlanOptions& options, int size, double share) noexcept {
  double wanted = options.filter.texels;
  if (options.filter.world > 0.0) {
    // Kernels wider than the side end up with the most there is; the border makes the side itself smaller.
    const double reach = options.filter.world * min_of(share, 1.0 / options.filter.world);
    wanted = max_of(wanted, reach * size / (1.0 + 2.0 * reach));
  }
  return static_cast<int>(std::ceil(min_of(wanted, 0.25 * size)));
}

double border_share(const PlanContext& c, const MapRequest& request, const LightBody& body,
                    const PlaneMap& plane) noexcept {
  if (!(c.options.filter.world > 0.0)) return 0.0;
  const double share = share_per_unit(plane, body.points());
  if (!request.space.perspective) return share;
  // A step across the ray at a distance is, as a slope, at most this step over the distance over the cosine
  // to the light's axis.
  double steepest = 0.0;
  for (const WarpInput::Point& p : body.points()) steepest = max_of(steepest, p.x * p.x + p.y * p.y);
  return share * std::sqrt(1.0 + steepest) / body.nearest;
}

int border_of(const PlanOptions& options, int width, int height, double share) noexcept {
  // Of a kernel in world units the longer side has more texels; the shorter side has room for no more than a
  // quarter of its own.
  const int longer = width > height ? width : height, shorter = width + height - longer;
  const int border = border_texels(options, longer, share);
  return border < shorter / 4 ? border : border_texels(options, shorter, share);
}

}  // namespace gnomon
