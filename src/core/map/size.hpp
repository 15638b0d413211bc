// How small a map may be for a bound of its aliasing error.
#pragma once

#include "map/light_body.hpp"

namespace gnomon {

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
/// The size in `request`, or where c.error_bound is above 0 the smallest in steps of kSizeStep whose bound of
/// m is at or below it. `share`: as border_share.
[[nodiscard]] MapSize map_size(const PlanContext& c, const MapRequest& request, const PlaneMap& plane,
                               const TexelsNeeded& needed, double obliquity, double share) noexcept;

}  // namespace gnomon
