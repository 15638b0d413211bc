// What a warp gains on a body, and whether a map takes it.
#pragma once

#include "gnomon/extend/warp.hpp"
#include "map/light_body.hpp"

namespace gnomon {

/// The objective with the choice over the objective without, borders included; infinite for a choice that no
/// map can be made with.
[[nodiscard]] double gain_ratio(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                                const WarpChoice& choice) noexcept;

// A warp that gains less than this is dropped: it would come and go with the last bits of the input.
inline constexpr double kLeastWarpGain = 1e-3;
/// Whether a warp with this ratio is used.
[[nodiscard]] bool pays(const Warp& warp, const WarpChoice& choice, double ratio) noexcept;

/// Outcome of a map of the body.
struct FocusedObjective {
  double value;     ///< the plan's objective, up to a factor that is the same for all bodies
  double unwarped;  ///< the same without a warp
};
/// The objective of the map that focused_map would make.
[[nodiscard]] FocusedObjective focused_objective(const PlanContext& c, const MapRequest& request) noexcept;
/// The light plane under that warp.
[[nodiscard]] PlaneMap focused_plane(const PlanContext& c, const MapRequest& request) noexcept;

}  // namespace gnomon
