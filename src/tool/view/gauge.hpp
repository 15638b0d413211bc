// Measures what a setting costs against a baseline, one draw at a time, while nothing else happens.
#pragma once

#include <vector>

#include "gnomon/report/statistics.hpp"

namespace gnomon::tool::view {

/// The time of side A against hard shadows from one unwarped map. Each round draws the baseline twice and
/// side A twice; the first draw of each pair warms up and does not count.
class Gauge {
 public:
  static constexpr int kRounds = 5, kDrawsOfRound = 4;

  [[nodiscard]] bool done() const noexcept { return draws_ >= kRounds * kDrawsOfRound; }
  /// True where the next draw is one of the baseline.
  [[nodiscard]] bool wants_baseline() const noexcept { return draws_ % kDrawsOfRound < kDrawsOfRound / 2; }
  /// The time of that draw.
  void take(double ms) {
    if (draws_ % 2 == 1) (wants_baseline() ? baseline_ms_ : ms_).push_back(ms);
    ++draws_;
  }
  /// Ratio of the medians; 0 before the first round has ended.
  [[nodiscard]] double ratio() const {
    if (ms_.empty()) return 0.0;
    const double base = report::median(baseline_ms_);
    return base > 0.0 ? report::median(ms_) / base : 0.0;
  }

 private:
  std::vector<double> ms_, baseline_ms_;  // a value a round
  int draws_ = 0;
};

}  // namespace gnomon::tool::view
