// How far a map may go, in one frame, from where the last frame's was towards where it is best.
#pragma once

#include <span>

#include "map/light_body.hpp"

namespace gnomon {

/// True where the last frame has a map of this size for the same slot and light.
[[nodiscard]] bool remembered(const MapRequest& request) noexcept;

/// What the last frame found and drew, and what a search does with it. False where nothing is known.
[[nodiscard]] bool find_start(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                              WarpStart& start) noexcept;
/// Where the next frame's search may begin: at this frame's choice.
[[nodiscard]] SearchedWarp searched_warp(const PlanContext& c, const MapRequest& request,
                                         const PlaneMap& plane) noexcept;

/// The best map, `best`, or one on the way there from the last frame's that keeps the change of texels per
/// area over the body small; reports an event where it cannot.
[[nodiscard]] PlaneMap steady_plane(const PlanContext& c, const MapRequest& request,
                                    const WarpQuestion& question, const PlaneMap& best,
                                    MapResult& result) noexcept;

/// The last frame's map with this frame's body in it, as it was fitted: the whole rectangle and its depths.
struct HeldMap {
  bool holds;
  PlaneMap plane;
  LightDepths depths;
};
[[nodiscard]] HeldMap held_map(const PlanContext& c, const MapRequest& request,
                               const LightBody& body) noexcept;

/// Moves the edges between cascades at most a small step from those of the last frame, `last` (empty: there
/// is none); the first and the last edge only give way slowly.
void steady_edges(std::span<const double> last, std::span<double> edges) noexcept;

}  // namespace gnomon
