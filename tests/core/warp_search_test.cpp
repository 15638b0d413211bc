// What searches over warps are made of: the error at samples, strengths along the view, rows from fans.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/seeded_input.hpp"
#include "warp/along_view.hpp"
#include "warp/formulas.hpp"
#include "warp/plane_error.hpp"
#include "warp/row_search.hpp"

namespace gnomon::test {
namespace {

using Look = void (*)(const WarpInput& input);
Look look = nullptr;

WarpChoice choose(const WarpInput& input) noexcept {
  look(input);
  return input.unwarped;
}
/// In the place of a warp: sees what warps are asked about.
const Warp probe{"probe", "looks", choose, true};

/// Shows `use` every body of a plan; returns how many maps it has.
int show(const Camera& camera, const glm::dvec3& light, const std::vector<Box>& receivers,
         Objective objective, Look use) {
  look = use;
  PlanOptions options;
  options.cascades = 1;
  options.warp.warp = &probe;
  options.warp.objective = objective;
  options.split.scheme = SplitScheme::logarithmic;
  options.prune = options.prune.without(PruneRule::casterless_cascades);
  return make_plan(camera, DirectionalLight{light}, {receivers, receivers}, options).map_count;
}

Camera street(double near_depth = 0.5) {
  return perspective_camera({0, 2, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, near_depth, 200.0, 960, 640);
}
const std::vector<Box> kGround = {{{-150, -1, -190}, {150, 0, 20}}};

int looked = 0;

TEST(WarpSearch, a_body_with_a_corner_of_which_nothing_is_known_is_no_ground_for_a_warp) {
  // At a slope of 1e30 rounding leaves a pixel no area across its ray.
  Camera camera = street();
  camera.left = -1e30;
  camera.right = 1e30;
  looked = 0;
  const std::vector<Box> everywhere = {{{-1e30, -1e3, -1e30}, {1e30, 0, 1e30}}};
  ASSERT_EQ(show(camera, {0.1, -1, -0.3}, everywhere, Objective::storage,
                 [](const WarpInput& input) {
                   PlaneError error(input);
                   const double length = input.y_max - input.y_min;
                   EXPECT_TRUE(std::isfinite(error.value(input.unwarped)));
                   EXPECT_TRUE(std::isinf(error.value(input.along_view(1.0 / length))));
                   ++looked;
                 }),
            1);
  EXPECT_EQ(looked, 1);
}

TEST(WarpSearch, the_strength_along_the_view_is_the_weakest_of_the_best) {
  looked = 0;
  for (const glm::dvec3 light :
       {glm::dvec3(0, -1, 0), glm::dvec3(0.01, -1, -0.01), glm::dvec3(0.5, -1, 0.2)}) {
    for (const double near_depth : {0.05, 0.5, 5.0}) {
      show(street(near_depth), light, kGround, Objective::storage, [](const WarpInput& input) {
        const AlongViewBest best = AlongView(input).best();
        if (!(best.kappa > 0.0)) return;
        ++looked;
        const auto storage = [&](double kappa) { return warp_error(input, kappa).value(Objective::storage); };
        const double value = storage(best.kappa);
        for (const double less : {0.99, 0.9, 0.5, 0.1})
          EXPECT_GT(storage(best.kappa * less), value * (1.0 + 1e-6)) << less << " of " << best.kappa;
        for (const double more : {1.01, 1.1, 2.0, 10.0})
          EXPECT_GE(storage(best.kappa * more), value * (1.0 - 1e-3)) << more << " of " << best.kappa;
      });
    }
  }
  EXPECT_GT(looked, 5);
}

TEST(WarpSearch, rows_of_a_choice_make_the_same_map_again) {
  looked = 0;
  for (const Objective objective : {Objective::storage, Objective::max}) {
    for (const glm::dvec3 light : {glm::dvec3(0.3, -1, -0.4), glm::dvec3(-1, -0.6, 0.3)}) {
      show(street(), light, kGround, objective, [](const WarpInput& input) {
        PlaneError error(input);
        RowSearch rows(input, error);
        for (const Warp* warp : all_warps()) {
          const WarpChoice choice = warp->choose(input);
          if (!(choice.kappa > 0.0)) continue;
          const double as_is = error.value(choice), again = error.value(rows.choice(rows.rows_of(choice)));
          EXPECT_NEAR(again, as_is, 1e-6 * as_is) << warp->name;
          ++looked;
        }
      });
    }
  }
  EXPECT_GT(looked, 12);
}

TEST(WarpSearch, the_best_rows_of_a_fan_are_no_worse_than_straight_ones) {
  looked = 0;
  for (const Objective objective : {Objective::storage, Objective::max}) {
    show(street(), {0.6, -1, -0.4}, kGround, objective, [](const WarpInput& input) {
      PlaneError error(input);
      RowSearch search(input, error);
      for (const double share : {0.3, 0.6, 0.9}) {
        const RowChoice found = search.round(search.ahead(share));
        EXPECT_TRUE(std::isfinite(found.value)) << share;
        WarpChoice straight = search.choice(found);
        straight.row_a = {1.0, 0.0};
        straight.row_b = {0.0, 1.0};
        // The corners alone count there, and the samples here: some hundredths apart.
        EXPECT_LE(error.value(search.choice(found)), 1.1 * error.value(straight)) << share;
        ++looked;
      }
    });
  }
  EXPECT_EQ(looked, 6);
}

TEST(WarpSearch, a_wall_along_the_light_is_a_line_at_any_angle_to_the_view) {
  looked = 0;
  // Walls that hold the light's direction, one of them straight ahead, one aside.
  const std::vector<Box> wall = {{{-20, -5, -30}, {20, 5, -30}}};
  for (const glm::dvec3 forward : {glm::dvec3(0, 0, -1), glm::dvec3(0.5, 0, -1), glm::dvec3(-0.7, 0, -1)}) {
    Camera camera = street();
    camera.forward = forward;
    show(camera, {0, -1, 0}, wall, Objective::storage, [](const WarpInput& input) {
      PlaneError error(input);
      EXPECT_TRUE(RowSearch(input, error).line());
      ++looked;
    });
    show(camera, {0, -1, 0}, kGround, Objective::storage, [](const WarpInput& input) {
      PlaneError error(input);
      EXPECT_FALSE(RowSearch(input, error).line());
      ++looked;
    });
  }
  EXPECT_EQ(looked, 6);
}

}  // namespace
}  // namespace gnomon::test
