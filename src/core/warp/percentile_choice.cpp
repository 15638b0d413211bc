// Which of several warps has the least 95th percentile, at more points than a search takes?
#include "warp/percentile_choice.hpp"

#include <array>

#include "lanes/lanes.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"
#include "warp/registry.hpp"

namespace gnomon {

WarpChoice best_percentile(const WarpInput& input, const WarpChoice& found) noexcept {
  constexpr double kNearly = 1.5;
  constexpr double kTie = 1.0 - 1e-9;  // gains below this are rounding
  constexpr std::size_t kMost = kDoubleLanes;
  std::array<WarpChoice, kMost> choice;
  std::array<double, kMost> sum{};
  std::size_t count = 0;
  const auto add = [&](const WarpChoice& one, double gain_ratio) {
    choice[count] = one;
    choice[count++].gain_ratio = gain_ratio;
  };
  for (int set = 0; set < kRaySets; ++set) {
    const PlaneError error(input, true, set);
    if (!error.is_percentile()) return found;
    if (set > 0) {
      for (std::size_t i = 0; i < count; ++i) sum[i] += error.value(choice[i]);
      continue;
    }
    const double without = error.value(input.unwarped);
    add(found, found.gain_ratio);
    for (const Warp* other : all_warps()) {
      if (is_searched(*other) || count == kMost) continue;
      const WarpChoice one = other->choose(input);
      if (input.is_unwarped(one) || !usable(input.body, one, input.most_stretch)) continue;
      const double ratio = error.value(one) / without;
      if (ratio < kNearly * found.gain_ratio && ratio < 1.0) add(one, ratio);
    }
    if (count == 1) return found;
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (sum[i] < kTie * sum[best]) best = i;
  }
  return choice[best];
}

}  // namespace gnomon
