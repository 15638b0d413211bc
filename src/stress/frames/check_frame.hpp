// What a frame owes its caller: its mask against exact rays, and what it keeps against a new renderer.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "check.hpp"

namespace gnomon::stress {

/// The promises of frames, as all_kinds() has those of plans.
[[nodiscard]] const std::vector<Kind>& all_frame_kinds();

/// What was looked at, so that nothing passes for lack of checks.
struct FrameCounts {
  long long cases = 0, frames = 0, moving = 0, pixels = 0, lit = 0, dark = 0, exact = 0, unserved = 0,
            panes = 0, kept = 0, anew = 0, maps = 0, pages = 0;
  void add(const FrameCounts& other);
};

struct FrameVerdict {
  std::vector<Finding> findings;  ///< at most one of each kind: the worst
  FrameCounts counts;
};

/// Draws the frames of this JSON text and checks each. A context must be current. Throws CaseError where it
/// is no frame.
[[nodiscard]] FrameVerdict check_frame(const nlohmann::ordered_json& frame);

}  // namespace gnomon::stress
