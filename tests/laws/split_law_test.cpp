// Do splits that are searched for the receivers at hand need no more texels than the formulas' splits?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// What the plan's bounds say for the objective: texels add up over the maps, the worst texel is the worst
/// map's.
double bound(const ShadowPlan& plan, Objective objective) {
  double total = 0.0;
  for (const ShadowMap& map : plan.maps()) {
    total =
        objective == Objective::storage ? total + map.storage : std::max({total, map.m_s_max, map.m_t_max});
  }
  return total;
}

/// Compares the searched borders with logarithmic ones; `boxes` receivers at most.
void compare_with_logarithmic(int boxes, double allowed) {
  std::uint64_t compared = 0, better = 0;
  for_all(1000, [&] {
    Case c = draw_case({.max_depth_ratio = 1e4, .max_boxes = boxes});
    if (boxes == 1) c.receivers.resize(1);
    c.options.fit = Fit::tight;
    c.options.warp = &warps::none;
    c.options.near_hint = 0.0;
    c.options.filter_radius_texels = 0.0;
    c.options.objective = chance(0.5) ? Objective::storage : Objective::max;
    c.options.cascades = 2 + pick(6);
    // The objective weighs slopes alike across and down; so do the bounds where pixels are square.
    c.camera.width = c.camera.height = 512;
    c.camera.right = c.camera.left + (c.camera.top - c.camera.bottom);
    // Every depth can be shadowed, so that no cascade is left out of the sum.
    const double f = 8.0 * c.camera.far_depth;
    c.casters = {{c.camera.position - glm::dvec3(f), c.camera.position + glm::dvec3(f)}};
    RC_LOG() << c;
    c.options.split = SplitScheme::logarithmic;
    const ShadowPlan formula = c.plan();
    c.options.split = SplitScheme::optimal;
    const ShadowPlan searched = c.plan();
    if (formula.map_count == 0) return;
    ++compared;
    const double before = bound(formula, c.options.objective), after = bound(searched, c.options.objective);
    require(after <= before * allowed, to_string(c.options.objective), "searched", after, "logarithmic",
            before);
    if (after < 0.9 * before) ++better;
  });
  EXPECT_GT(compared, 200u);
  EXPECT_GT(better, 50u);
}

TEST(SplitLaw, searched_splits_are_no_worse_than_logarithmic_ones_on_one_receiver) {
  // The search looks at 16 depths and then closes in: how far it may end from a formula that happens to be
  // best.
  constexpr double kSearched = 1.05;
  compare_with_logarithmic(1, kSearched);
}

TEST(SplitLaw, searched_splits_are_no_worse_than_logarithmic_ones_on_receivers_with_gaps_between_them) {
  constexpr double kSearched = 1.15;  // as above, and hulls of what is in each slice
  compare_with_logarithmic(4, kSearched);
}

}  // namespace
}  // namespace gnomon::test
