// Where does a search begin that goes on from the last frame?
#pragma once

#include "map/light_body.hpp"

namespace gnomon {

/// What the last frame found and drew, and what a search does with it. False where nothing is known.
[[nodiscard]] bool find_start(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                              WarpStart& start) noexcept;
/// Where the next frame's search may begin: at this frame's choice.
[[nodiscard]] SearchedWarp searched_warp(const PlanContext& c, const MapRequest& request,
                                         const PlaneMap& plane) noexcept;

}  // namespace gnomon
