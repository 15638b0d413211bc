// Is `optimal` as good as the best of all other warps, by the objective that it searches for?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <variant>

#include "gnomon/warp.hpp"
#include "support/property.hpp"
#include "support/seeded_input.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"

namespace gnomon::test {
namespace {

// What `optimal` may come to, over the best other warp.
constexpr double kAtMost = 1.005;
// A warp that gains less is not worth its sampling noise, and is not used.
constexpr double kLeastGain = 0.02;

/// What the bodies of one plan came to.
struct Judged {
  int bodies = 0;
  double worst = 0.0;
  std::string worst_against;
};
Judged judged;

/// In the place of a warp: compares all warps for each body that a plan asks about.
WarpChoice judge(const WarpInput& input) noexcept {
  PlaneError error(input, true);
  const double without = error.value(input.unwarped);
  if (!(without > 0.0 && without < 1e300)) return input.unwarped;
  const auto value = [&](const Warp& warp) {
    const WarpChoice choice = warp.choose(input);
    if (!usable(input.body, choice, input.most_stretch)) return without;
    const double with = error.value(choice);
    return with < without * (1.0 - kLeastGain) ? with : without;
  };
  const double best = value(warps::optimal);
  ++judged.bodies;
  for (const Warp* warp : all_warps()) {
    const double ratio = best / value(*warp);
    if (!(ratio > judged.worst)) continue;
    judged.worst = ratio;
    judged.worst_against = warp->name;
  }
  return input.unwarped;
}
const Warp kJudge{"judge", "compares all warps", judge, true};

void hold(bool parallel, int cases, int least_bodies) {
  std::array<double, 3> worst{};
  int bodies = 0;
  for_all(cases, [&] {
    SeededInput input;
    const auto seed = static_cast<std::uint64_t>(pick(1 << 30));
    seed_input(seed, Extremes::ordinary, input);
    if (std::holds_alternative<DirectionalLight>(input.light) != parallel) return;
    RC_LOG() << "seeded input " << seed;
    input.options.warp.warp = &kJudge;
    judged = {};
    (void)input.plan();
    bodies += judged.bodies;
    double& so_far = worst[static_cast<std::size_t>(input.options.warp.objective)];
    so_far = std::max(so_far, judged.worst);
    require(judged.worst <= kAtMost, to_string(input.options.warp.objective), "optimal over",
            judged.worst_against, judged.worst);
  });
  EXPECT_GT(bodies, least_bodies);
  for (const double ratio : worst) {
    EXPECT_GT(ratio, 0.0);
    std::printf("worst ratio to the best other warp %.6f\n", ratio);
  }
}

TEST(BestWarpLaw, under_parallel_light_no_registered_warp_is_better_than_optimal) {
  hold(true, 1500, 500);
}

TEST(BestWarpLaw, under_local_lights_no_registered_warp_is_better_than_optimal) {
  hold(false, 1500, 100);
}

}  // namespace
}  // namespace gnomon::test
