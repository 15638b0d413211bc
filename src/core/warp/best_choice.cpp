// Which of a search's result and other warps is the best at points that the search does not go by?
#include "warp/best_choice.hpp"

#include <cmath>

#include "geometry/vector.hpp"
#include "warp/error_samples.hpp"

namespace gnomon {
namespace {

constexpr double kTie = 1.0 - 1e-9;  // gains below this are rounding

/// The corners of a body round several boxes may lie in air.
bool has_air(const WarpInput& input) noexcept {
  return input.held != nullptr && input.objective == Objective::max;
}

/// One set of points after the other, until one warp is left.
Judged best_percentile(PlaneError& error, const Judged& found, const OtherChoices& others) noexcept {
  // One that one set shows to be worse by more than this is given up; several, by less.
  constexpr double kWorse = 0.07;
  struct Candidate {
    const Judged* judged;
    double sum;  // of the sets' values
  };
  std::array<Candidate, kDoubleLanes + 1> candidate{};
  std::size_t count = 0;
  candidate[count++].judged = &found;
  for (std::size_t i = 0; i < others.count; ++i) candidate[count++].judged = &others.judged[i];
  const auto least = [&] {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if (candidate[i].sum < kTie * candidate[best].sum) best = i;
    }
    return candidate[best];
  };
  for (int set = 1; set < kRaySets && count > 1; ++set) {
    error.take_set(set);
    for (std::size_t i = 0; i < count; ++i) candidate[i].sum += error.value(candidate[i].judged->choice);
    const double most = least().sum * (1.0 + kWorse / std::sqrt(set));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (candidate[i].sum <= most) candidate[kept++] = candidate[i];
    }
    count = kept;
  }
  return *least().judged;
}

/// Where rays through boxes begin and end.
Judged best_at_ends(PlaneError& error, const Judged& found, const OtherChoices& others) noexcept {
  error.take_set(kRayEnds);
  const Judged* best = &found;
  double least = error.value(found.choice);
  for (std::size_t i = 0; i < others.count; ++i) {
    const double value = error.value(others.judged[i].choice);
    if (!(value < kTie * least)) continue;
    least = value;
    best = &others.judged[i];
  }
  return *best;
}

}  // namespace

double nearly_as_good(const WarpInput& input, const PlaneError& error) noexcept {
  constexpr double kPercentile = 2.0, kWorst = 1.3;
  return error.is_percentile() ? kPercentile : has_air(input) ? kWorst : 1.0;
}

Judged best_choice(const WarpInput& input, PlaneError& error, const Judged& found,
                   const OtherChoices& others) noexcept {
  if (others.count == 0) return found;
  if (error.is_percentile()) return best_percentile(error, found, others);
  return has_air(input) ? best_at_ends(error, found, others) : found;
}

}  // namespace gnomon
