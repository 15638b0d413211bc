// Draws random cases, checks each, shrinks what fails, and sums up.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "check.hpp"
#include "failures.hpp"

namespace gnomon::stress {

struct RandomOptions {
  long long cases = 1000;
  std::uint64_t seed = 1;
  bool shrink = true;
};

/// Time of a plan, for cases of one sort.
struct PlanTimes {
  std::string sort;
  long long cases = 0;
  double median_ms = 0.0, p99_ms = 0.0, worst_ms = 0.0;
  std::uint64_t worst_case = 0;
};

struct RandomResult {
  std::vector<KindFound> kinds;  ///< in the order of all_kinds()
  std::vector<PlanTimes> times;
  Counts counts;
};

/// `step` is called after each case.
[[nodiscard]] RandomResult run_random(const RandomOptions& options, const std::function<void()>& step = {});

/// Counts, times and a line for each kind of failure.
[[nodiscard]] std::string summary(const RandomOptions& options, const RandomResult& result);

}  // namespace gnomon::stress
