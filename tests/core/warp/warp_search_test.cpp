// What searches over warps are made of: the error at samples, strengths along the view, rows from fans, and
// sides that turn.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/gnomon.hpp"
#include "lanes/lanes.hpp"
#include "support/seeded_input.hpp"
#include "warp/along_view.hpp"
#include "warp/error_samples.hpp"
#include "warp/formulas.hpp"
#include "warp/plane_error.hpp"
#include "warp/row_search.hpp"
#include "warp/side_search.hpp"

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

TEST(WarpSearch, visible_points_lie_in_the_body_also_beside_a_face_through_the_eye) {
  // The ground ends at the height of the eye, and a rolled camera sees beyond its edge on one side.
  for (const glm::dvec3 up : {glm::dvec3{0, 1, 0}, glm::dvec3{1, 2, 0}, glm::dvec3{-1, 1, 0}}) {
    const Camera camera = perspective_camera({0, 2, 0}, {0.1, 0, -1}, up, 1.0, 1.5, 0.5, 200.0, 960, 640);
    looked = 0;
    ASSERT_EQ(show(camera, {0.1, -1, -0.3}, {{{-150, -3, -190}, {150, 2, 20}}}, Objective::p95,
                   [](const WarpInput& input) {
                     PixelLanes lanes;
                     for (const int set : {0, 1}) add_visible_points(input, set, lanes);
                     ASSERT_GT(lanes.count, 50u);
                     for (std::size_t i = 0; i < lanes.count; ++i) {
                       const glm::dvec3 point{lanes.x[i], lanes.y[i], lanes.z()[i]};
                       for (int f = 0; f < input.polytope->face_count; ++f) {
                         const Plane& plane = input.polytope->plane[static_cast<std::size_t>(f)];
                         EXPECT_GE(glm::dot(plane.normal, point) + plane.offset, -1e-6 * glm::length(point))
                             << f;
                       }
                     }
                     ++looked;
                   }),
              1);
    EXPECT_EQ(looked, 1);
  }
}

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

TEST(WarpSearch, the_best_rows_near_straight_ones_are_no_worse_than_those) {
  looked = 0;
  for (const Objective objective : {Objective::storage, Objective::max}) {
    show(street(), {0.6, -1, -0.4}, kGround, objective, [](const WarpInput& input) {
      PlaneError error(input);
      RowSearch search(input, error);
      RowLanes candidates{};
      for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
        RowChoice straight;
        straight.fall_off = search.ahead(0.05 + 0.06 * static_cast<double>(lane));
        candidates.set(lane, straight);
      }
      RowLanes found = candidates;
      search.find_rows(0.1, found);
      for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
        EXPECT_TRUE(std::isfinite(found.value[lane])) << lane;
        EXPECT_GT(found.value[lane], 0.0F) << lane;
        // The rows go by both extents together: a little off what the objective says.
        EXPECT_LE(error.value(search.choice(found.at(lane))),
                  1.1 * error.value(search.choice(candidates.at(lane))))
            << lane;
        ++looked;
      }
      EXPECT_EQ(found.best().value, found.value[found.least()]);
    });
  }
  EXPECT_EQ(looked, 32);
}

TEST(WarpSearch, sides_as_they_are_make_the_same_map_again) {
  looked = 0;
  for (const Objective objective : {Objective::storage, Objective::max, Objective::picture}) {
    for (const glm::dvec3 light : {glm::dvec3(0.3, -1, -0.4), glm::dvec3(-1, -0.6, 0.3)}) {
      show(street(), light, kGround, objective, [](const WarpInput& input) {
        PlaneError error(input);
        for (const Warp* warp : all_warps()) {
          const WarpChoice choice = warp->choose(input);
          const double as_is = error.value(choice);
          const double again = error.value(SideSearch(input, error, choice).choice(Sides{}));
          EXPECT_NEAR(again, as_is, 1e-6 * as_is) << warp->name;
          ++looked;
        }
      });
    }
  }
  EXPECT_GT(looked, 30);
}

TEST(WarpSearch, turned_sides_are_worth_what_the_error_says_of_their_map) {
  looked = 0;
  for (const Objective objective : {Objective::storage, Objective::max, Objective::p95, Objective::picture}) {
    show(street(), {0.6, -1, -0.4}, kGround, objective, [](const WarpInput& input) {
      PlaneError error(input);
      const WarpChoice from = warps::lispsm.choose(input);
      const SideSearch search(input, error, from);
      SideLanes lanes;
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = 0; l < kFloatLanes; ++l)
          lanes.turn[k][l] = l == 0 ? 0.0F : 0.1F * static_cast<float>((3 * k + 5 * l) % 7) - 0.3F;
      }
      search.find_values(Sides{}, lanes);
      const double unit = error.value(from) / std::sqrt(lanes.value[0]);
      for (std::size_t l = 0; l < kFloatLanes; ++l) {
        const double exact = error.value(search.choice(lanes.at(l))) / unit;
        EXPECT_NEAR(std::sqrt(lanes.value[l]), exact, 1e-4 * exact) << to_string(input.objective) << l;
        ++looked;
      }
    });
  }
  EXPECT_EQ(looked, 64);
}

TEST(WarpSearch, lines_that_enclose_nothing_make_no_map) {
  looked = 0;
  show(street(), {0.6, -1, -0.4}, kGround, Objective::storage, [](const WarpInput& input) {
    PlaneError error(input);
    const SideSearch search(input, error, input.unwarped);
    SideLanes lanes;
    for (auto& turn : lanes.turn) turn.fill(0.0F);
    // A side turned onto its neighbour, and one turned beyond it.
    lanes.turn[0][1] = 1.0F;
    lanes.turn[2][1] = -1.0F;
    search.find_values(Sides{}, lanes);
    EXPECT_TRUE(std::isfinite(lanes.value[0]));
    EXPECT_TRUE(std::isinf(lanes.value[1]));
    ++looked;
  });
  EXPECT_EQ(looked, 1);
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
      EXPECT_TRUE(is_line(input, error.body()));
      ++looked;
    });
    show(camera, {0, -1, 0}, kGround, Objective::storage, [](const WarpInput& input) {
      PlaneError error(input);
      EXPECT_FALSE(is_line(input, error.body()));
      ++looked;
    });
  }
  EXPECT_EQ(looked, 6);
}

// A percentile's search counts the samples near the worst: the map that was valued last must not be taken for
// another one, nor the samples for all of them.
TEST(WarpSearch, samples_near_the_worst_are_those_of_the_map_in_question) {
  const int maps = show(street(), {0.1, -1, -0.3}, kGround, Objective::p95, [](const WarpInput& in) {
    const WarpChoice warped = warps::lispsm.choose(in);
    PlaneError fresh(in, true), used(in, true);
    fresh.count_worst(warped);
    (void)used.value(in.unwarped);
    used.count_worst(warped);
    EXPECT_LT(used.counted().count, std::size_t{96});
    ASSERT_EQ(used.counted().count, fresh.counted().count);
    for (std::size_t i = 0; i < used.counted().count; ++i)
      EXPECT_EQ(used.counted().x[i], fresh.counted().x[i]);
    const double of_part = used.value(warped);
    used.count_all();
    EXPECT_EQ(of_part, used.value(warped));
  });
  EXPECT_EQ(maps, 1);
}

}  // namespace
}  // namespace gnomon::test
