// Far cascades that are planned every few frames: which maps are cached, and the room that lets them serve.
#pragma once

#include "gnomon/extend/body.hpp"
#include "map/context.hpp"

namespace gnomon {

/// How far, in world units, a point of the slice up to the view depth `end` may move against the camera while
/// its map is cached.
[[nodiscard]] double room_for_motion(const PlanContext& c, double end) noexcept;

/// The receivers within `room` of the camera's frustum between two view depths.
[[nodiscard]] Polytope receivers_with_room(const PlanContext& c, double begin, double end,
                                           double room) noexcept;

/// A cascade and the depths that it is to serve.
struct CascadeSlot {
  int cascade;
  double begin, end;
};
/// The map of an earlier frame that still serves the slot; nullptr: it is to be planned.
[[nodiscard]] const PlanHistory::KeptMap* cached_cascade(const PlanContext& c, const PlanHistory& history,
                                                         const CascadeSlot& slot) noexcept;

}  // namespace gnomon
