// How far a map may go, in one frame, from where the last frame's was towards where it is best.
#pragma once

#include <span>

#include "map/light_body.hpp"

namespace gnomon {

/// True where the last frame has a map of this size for the same slot and light.
[[nodiscard]] bool remembered(const MapRequest& request) noexcept;

/// The best map, `best`, or one on the way there from the last frame's that keeps the change of texels per
/// area over the body small; reports an event where it cannot.
[[nodiscard]] PlaneMap steady_plane(const PlanContext& c, const MapRequest& request,
                                    const WarpQuestion& question, const PlaneMap& best,
                                    MapResult& result) noexcept;

/// 1 + kappa length of the strongest warp whose texels change smoothly as it moves along with the viewer:
/// they change with the third power of w. `length`: of the body along the warp's axis. Infinite where neither
/// moves.
[[nodiscard]] double smooth_stretch(const PlanContext& c, const WarpQuestion& question,
                                    double length) noexcept;

/// A change of the logarithm of texels per area beyond this is a cut: nothing is gained by going slowly.
inline constexpr double kCut = 0.4054651081081644;  // ln 1.5

}  // namespace gnomon
