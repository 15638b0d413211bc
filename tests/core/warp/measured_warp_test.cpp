// Is the searched warp as good as others where the error of the drawn maps is measured?
#include <gtest/gtest.h>

#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/extend/warp.hpp"
#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

/// A camera under a stair, the steps of which are all that it sees: the box round them holds the eye.
struct Stair {
  Camera camera = perspective_camera({-0.673, 12.687, -39.098}, {0.535, -0.008, 0.845}, {0, 1, 0}, 1.047,
                                     6.09, 2.5e-5, 700, 100, 100);
  DirectionalLight sun{{-0.21, -0.53, 0.13}};
  std::vector<Box> steps;
  Stair() {
    constexpr double kHalfWidth = 1.636, kRise = 0.1636, kTread = 0.4908;
    for (int i = 0; i < 100; ++i)
      steps.push_back(
          {{-kHalfWidth, kRise * i, -kTread * (i + 1)}, {kHalfWidth, kRise * (i + 1), -kTread * i}});
  }
  [[nodiscard]] AliasingStats measured(const Warp& warp, Objective objective) const {
    PlanOptions options;
    options.cascades = 1;
    options.warp.warp = &warp;
    options.warp.objective = objective;
    return measure(make_plan(camera, sun, {steps, steps}, options), camera, {steps, steps});
  }
};

TEST(MeasuredWarp, air_round_the_eye_does_not_count_before_the_nearest_of_several_receivers) {
  const Stair stair;
  const AliasingStats none = stair.measured(warps::none, Objective::storage);
  ASSERT_GT(none.samples, 1000u);
  for (const Warp* warp : {&warps::optimal, &warps::lispsm}) {
    EXPECT_LE(stair.measured(*warp, Objective::storage).storage, none.storage) << warp->name;
    EXPECT_LE(stair.measured(*warp, Objective::max).max, none.max) << warp->name;
    EXPECT_LE(stair.measured(*warp, Objective::p95).p95, none.p95) << warp->name;
  }
}

TEST(MeasuredWarp, is_kept_under_light_against_the_view_though_pixels_are_not_square) {
  // Sides of 0.7 to 1: the sides of a pixel turn between rays that oppose the light's.
  Camera camera = perspective_camera({15.6, 19.6, 9.3}, {0.729, -0.494, 0.474}, {0, 1, 0}, 0.755, 0.687,
                                     0.225, 267, 960, 540);
  const DirectionalLight sun{{-0.703, -0.701, -0.119}};
  const std::vector<Box> ground = {{{-3000, -1, -3000}, {3000, 0, 3000}}};
  const auto storage = [&](const Warp& warp) {
    PlanOptions options;
    options.cascades = 1;
    options.warp.warp = &warp;
    options.warp.objective = Objective::storage;
    return measure(make_plan(camera, sun, {ground, ground}, options), camera, {ground, ground}).storage;
  };
  EXPECT_LT(storage(warps::optimal), 0.5 * storage(warps::none));
  EXPECT_LE(storage(warps::optimal), 1.02 * storage(warps::lispsm_lloyd));
}

}  // namespace
}  // namespace gnomon::test
