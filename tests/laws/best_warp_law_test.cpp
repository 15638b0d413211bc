// Is `optimal` as good as the best of all other warps, by the objective that it searches for?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <variant>

#include "gnomon/warp.hpp"
#include "support/property.hpp"
#include "support/seeded_input.hpp"
#include "warp/along_view.hpp"
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
  double worst = 0.0, apart = 0.0, log_along = 0.0, log_quick = 0.0;
  std::string worst_against;
};
Judged judged;

/// How far the values of choices side by side are from those of each alone.
double apart(const WarpInput& input, PlaneError& error) noexcept {
  std::array<WarpChoice, kWarpLanes> choice;
  ChoiceLanes lanes;
  for (std::size_t i = 0; i < kWarpLanes; ++i) {
    choice[i] = all_warps()[i % all_warps().size()]->choose(input);
    lanes.set(i, choice[i]);
  }
  LaneValues value;
  error.values(lanes, value);
  double most = 0.0;
  for (std::size_t i = 0; i < kWarpLanes; ++i) {
    const bool known = choice[i].kappa == 0.0 || usable(input.body, choice[i], input.most_stretch);
    const double alone = error.value(choice[i]);
    // Bodies of rounding give values of rounding.
    if (!known || !(alone < 1e12)) continue;
    most = std::max(most, std::abs(value[i] - alone) / alone);
  }
  return most;
}

/// The strength found along the view, over the best of many; and the quick search over the thorough one.
void judge_along(const WarpInput& input) noexcept {
  AlongView view(input);
  const AlongViewBest best = view.best();
  const double length = input.y_max - input.y_min;
  double least = warp_error(input, 0.0).value(input.objective);
  if (!(length > 0.0) || !(least < 1e300)) return;
  for (double reach = 0.01; reach < 1e6; reach *= 1.05)
    least = std::min(least, warp_error(input, reach / length).value(input.objective));
  const double found = warp_error(input, best.kappa).value(input.objective) / least;
  if (found > 0.0 && found < 1e300) judged.log_along += std::log(found);
  const double quick = view.quick().value / best.value;
  if (quick > 0.0 && quick < 1e300) judged.log_quick += std::log(quick);
}

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
  judge_along(input);
  judged.apart = std::max(judged.apart, apart(input, error));
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
  double log_along = 0.0, log_quick = 0.0;
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
    constexpr double kRounding = 1e-6;
    require(judged.apart <= kRounding, "values side by side are apart by", judged.apart);
    log_along += judged.log_along;
    log_quick += judged.log_quick;
    require(judged.worst <= kAtMost, to_string(input.options.warp.objective), "optimal over",
            judged.worst_against, judged.worst);
  });
  EXPECT_GT(bodies, least_bodies);
  // Not one by one: a flat body's image has no width at one strength alone.
  constexpr double kAlong = 0.02, kQuick = 0.1;
  EXPECT_LT(log_along, kAlong * bodies) << "strength along the view over the best";
  EXPECT_LT(std::abs(log_quick), kQuick * bodies) << "quick search along the view over the thorough one";
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
