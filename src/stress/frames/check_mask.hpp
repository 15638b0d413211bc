// Is each pixel of a mask that is decided what exact geometry says?
#pragma once

#include <string>
#include <string_view>

#include "check_frame.hpp"
#include "frame_stage.hpp"

namespace gnomon::stress {

class FrameReport {
 public:
  explicit FrameReport(FrameVerdict& verdict) : verdict_(verdict) {}
  /// In front of each text from now on.
  void begin_with(const std::string& words) { words_ = words; }
  /// Keeps the worst of each kind.
  void add(std::string_view kind, double amount, const std::string& text);
  [[nodiscard]] FrameCounts& counts() { return verdict_.counts; }

 private:
  FrameVerdict& verdict_;
  std::string words_;
};

/// The mask of the last frame that the stage's keeping renderer drew, and its panes' light.
void check_mask(FrameStage& stage, FrameReport& report);

}  // namespace gnomon::stress
