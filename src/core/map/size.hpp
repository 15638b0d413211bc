// How small a map may be for a bound of its aliasing error, and how wide a border filter kernels need.
#pragma once

#include "gnomon/extend/body.hpp"
#include "map/light_body.hpp"

namespace gnomon {

/// Nearest distance from a local light that its maps show, over the farthest: what is known to be nearer than
/// PlanOptions::light_near_share is still shown, down to this.
inline constexpr double kLeastNearShare = kLeastLightNearShare;

/// Under a local light the border of a warped map may reach no farther than where the far end's texels are
/// this much longer again: beyond lies the warp's horizon.
inline constexpr double kBorderGrowth = 0.5;

/// A float offset from the camera is rounded by up to 2^-24 of its length: a rectangle narrower than this
/// much of it has texels, 1024 across, that no shader can tell apart, and one 2^10 times narrower still loses
/// every point it was fitted to.
inline constexpr double kLeastOfOffset = 0x1p-14;

/// Texels along each side of a map of `size` that no receiver may fall into, with `share` of the map's side
/// without them to a world unit.
[[nodiscard]] int border_texels(const PlanOptions& options, int size, double share) noexcept;

/// How far a kernel's step of one world unit moves a point in the map, at most, as a share of the rectangle's
/// side. 0 where no kernel is given in world units.
[[nodiscard]] double border_share(const PlanContext& c, const MapRequest& request, const LightBody& body,
                                  const PlaneMap& plane) noexcept;

/// The border of a map of this size, whose sides may differ.
[[nodiscard]] int border_of(const PlanOptions& options, int width, int height, double share) noexcept;

/// Largest extent of a pixel across its eye ray's tilt, over the body: 1 / cosine of the largest angle
/// between the view direction and an eye ray to the body. The simplified weights of the metric leave it out.
[[nodiscard]] double pixel_obliquity(const PlanContext& c, const Polytope& body) noexcept;

/// Pixels per unit of the image along its finer axis.
[[nodiscard]] double pixels_per_slope(const Camera& camera) noexcept;

/// The size of a map and its border.
struct MapSize {
  int width, height, border;
  double full_error;  ///< bound of m at the size asked for
};
/// The size in `request`, or where c.how.error_bound is above 0 the smallest in steps of kSizeStep whose
/// bound of m is at or below it. `share`: as border_share.
[[nodiscard]] MapSize map_size(const PlanContext& c, const MapRequest& request, const PlaneMap& plane,
                               const TexelsNeeded& needed, double obliquity, double share) noexcept;

}  // namespace gnomon
