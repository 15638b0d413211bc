// What one technique does on one frame: its errors against the truth, what it costs, and how long it takes.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "entry_file.hpp"
#include "frame_truth.hpp"
#include "gnomon/report/row.hpp"
#include "planned.hpp"

namespace gnomon::tool {

/// A technique's pictures of the frame, for those who look.
struct FramePictures {
  Image image, heat;
  std::vector<float> mask;
};

/// A technique's plan for the frame before, and its mask through the camera of that frame; empty where the
/// truth holds no whole pixels.
struct FrameBefore {
  std::unique_ptr<Planned> plan;
  std::vector<float> mask;
};

/// Draws the frame before by each of the entries, one after the other: the camera's surfaces are drawn once.
[[nodiscard]] std::vector<FrameBefore> draw_before(Stage& stage, const FrameTruth& truth,
                                                   std::span<const SweepEntry* const> entries);

/// Fills in the row's errors, aliasing, costs, status and what was left out; the pictures where `drawn` is
/// not nullptr. Returns the masks.
FrameMasks measure_errors(Stage& stage, const FrameTruth& truth, const SweepEntry& entry, FrameBefore before,
                          report::Row& row, FramePictures* drawn);

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
