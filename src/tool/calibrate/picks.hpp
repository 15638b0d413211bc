// How good are the planner's picks? They are held against what a sweep measured of all techniques.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gnomon/report/cost_model.hpp"
#include "replanned.hpp"

namespace gnomon::tool {

/// Cost and error of a technique in one frame, or on average over frames. Measured times scatter; the model's
/// leave the errors alone.
struct PricedTechnique {
  double ms = 0.0, model_ms = 0.0;  ///< measured, and by the cost model
  double error = 0.0;               ///< measured: a share of the pixels, above 0
};

/// A technique held against all others. Factors of at least 1, which is the best.
struct Score {
  PricedTechnique priced;
  /// By how much both cost and error exceed those of the technique that beats it most, by measured times and
  /// by the model's.
  double beyond_front = 1.0, beyond_front_by_model = 1.0;
  /// Measured time over the budget, or error over the target.
  double over_request = 1.0;
  /// The same, or by how much error or time exceed the least among the techniques that meet the request: the
  /// larger of both.
  double off_request = 1.0;
};
[[nodiscard]] Score score_of(const PricedTechnique& pick, std::span<const PricedTechnique> all,
                             const Budget& request) noexcept;
/// What counts as on the front, and as met.
inline constexpr double kHit = 1.1;

/// Budgets and errors at equal steps of their logarithm between the ends of what was measured.
[[nodiscard]] std::vector<Budget> requests_between(std::span<const PricedTechnique> all);

/// What was picked for a request.
struct Pick {
  std::string view;  ///< the frame, or the flight
  Budget request;
  std::string technique;           ///< of a flight: the one that is kept; empty: each frame has its own
  std::optional<double> expected;  ///< by the planner, a share of the pixels; none of a flight
  Score score;
};

/// Picks along one flight. The requests lie between the ends of the means over its frames.
struct FlightPicks {
  std::vector<Pick> of_frames;  ///< of each frame, held against the frame
  /// Held against the means over all frames. Kept throughout: the first frame's pick; the hardest frame's, as
  /// `gnomon fly` takes it. Then each frame's own. Empty where the flight has one frame.
  std::vector<Pick> first_kept, hardest_kept, renewed;
  /// All techniques of all frames, and those of them on the front, by measured times and by the model's.
  int techniques = 0, on_front = 0, on_front_by_model = 0;
};
/// Throws std::runtime_error where the frames were not measured with the same full product of techniques.
[[nodiscard]] FlightPicks picks_of(const std::vector<const View*>& frames,
                                   const report::StoredCostModel& model);

}  // namespace gnomon::tool
