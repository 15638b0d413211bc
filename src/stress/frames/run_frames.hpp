// Draws random frames, checks each, shrinks what fails, and sums up.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "check_frame.hpp"
#include "failures.hpp"

namespace gnomon::stress {

struct FrameOptionsOfRun {
  long long frames = 100;  ///< at least so many are drawn; the last scene's are drawn to its end
  std::uint64_t seed = 1;
  bool shrink = true;
};

struct FramesResult {
  std::vector<KindFound> kinds;  ///< in the order of all_frame_kinds()
  FrameCounts counts;
  double seconds = 0.0;
};

/// A context must be current. `step` is called after each scene with the frames drawn so far.
[[nodiscard]] FramesResult run_frames(const FrameOptionsOfRun& options,
                                      const std::function<void(long long)>& step = {});

/// Counts, and a line for each kind of failure.
[[nodiscard]] std::string summary(const FrameOptionsOfRun& options, const FramesResult& result);

}  // namespace gnomon::stress
