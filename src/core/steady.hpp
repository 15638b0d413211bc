// How far a map may go, in one frame, from where the last frame's was towards where it is best.
#pragma once

#include <span>

#include "gnomon/history.hpp"
#include "light_map.hpp"
#include "map_parts.hpp"
#include "plan_context.hpp"

namespace gnomon {

/// The last frame's map of this cascade; nullptr where none is remembered or its shape is another.
[[nodiscard]] const PlanHistory::Map* remembered(const PlanContext& c, const ShadowMap& map) noexcept;

/// The best map for `best`, or one on the way there from the last frame's that keeps the change of texels per
/// area over the body small; adds an event where it cannot.
[[nodiscard]] PlaneMap steady_plane(const PlanContext& c, const WarpInput& in, const WarpChoice& best,
                                    const ShadowMap& map) noexcept;

/// The last frame's map with this frame's body in it, as it was laid: the whole rectangle and its depths.
struct HeldMap {
  bool holds;
  PlaneMap plane;
  LightDepths depths;
};
/// `rim`: of the last frame's map, as a share of its side.
[[nodiscard]] HeldMap held_map(const PlanContext& c, const PlanHistory::Map& last, const LightBody& body,
                               double rim) noexcept;

/// Moves the edges between cascades at most a small step from those of the last frame; the first and the last
/// edge only give way slowly.
void steady_edges(PlanHistory& history, std::span<double> edges) noexcept;

void remember(PlanHistory& history, int cascade, const ShadowMap& map,
              const glm::dmat4& gl_from_world) noexcept;
void add_event(PlanHistory& history, PlanEventKind kind, int map, double ratio) noexcept;

}  // namespace gnomon
