// What one technique does on one frame: its errors against the truth, what it costs, and how long it takes.
#pragma once

#include <functional>
#include <vector>

#include "entry_file.hpp"
#include "frame_truth.hpp"
#include "gnomon/report/row.hpp"

namespace gnomon::tool {

/// A technique's pictures of the frame, for those who look.
struct FramePictures {
  Image image, heat;
  std::vector<float> mask;
};

/// Fills in the row's errors, aliasing, costs, status and what was left out; the pictures where `drawn` is
/// not nullptr. Returns the masks.
FrameMasks measure_errors(Stage& stage, const FrameTruth& truth, const SweepEntry& entry, report::Row& row,
                          FramePictures* drawn);

/// The same errors of masks that others drew, as far as they can be known: nothing of kernels and maps. Fills
/// in their times.
void measure_given(const FrameTruth& truth, const GivenMasks& given, report::Row& row, FrameMasks& masks);

/// Times the entries one after the other, in a new random order in every round; the first round warms up and
/// is dropped. `done` is called after each measurement. One result per entry, in their order.
[[nodiscard]] std::vector<report::Times> measure_times(Stage& stage, const Camera& camera,
                                                       const std::vector<const SweepEntry*>& entries,
                                                       const SweepEntry& baseline, int rounds,
                                                       const std::function<void()>& done);

}  // namespace gnomon::tool
