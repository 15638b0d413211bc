// What a plan costs: time and heap allocations of make_plan() over many runs of one case.
#pragma once

#include <cstdint>

#include "gnomon/casefile/casefile.hpp"

namespace gnomon::tool {

class Progress;

/// Nanoseconds of one make_plan(), each run timed alone with the steady clock; reading the clock is in it
/// (some 20 to 50 ns). `allocations` is the largest count in any one run, warm-up included.
struct PlanTiming {
  std::int64_t min_ns = 0, median_ns = 0, p99_ns = 0;
  std::uint64_t allocations = 0;
};

inline constexpr int kMaxRepeats = 10'000'000;  ///< 80 MB of samples

/// Runs the case `repeats` times (1..kMaxRepeats) after a warm-up that is not counted. `steps_before` runs of
/// other cases are already on the bar.
[[nodiscard]] PlanTiming time_plan(const Case& input, int repeats, Progress& progress,
                                   long long steps_before);

}  // namespace gnomon::tool
