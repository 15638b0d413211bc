// Does a focus draw texels towards itself, and leave everything else its map?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// A wide plain, seen from a hill; the focus is a table-sized box at this distance.
Case plain_with_focus(double distance) {
  Case c;
  c.camera = perspective_camera({0, 4, 0}, {0, -0.15, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 400.0, 960, 600);
  c.light = {0.5, -1.0, 0.2};
  c.receivers = {{{-400, -1, -400}, {400, 0, 400}}};
  c.casters = {{{-400, -1, -400}, {400, 20, 400}}};
  c.options.cascades = 1;
  c.options.warp.focus = {{-4, -1, -distance - 4}, {4, 0, -distance + 4}};
  return c;
}

double error_in(const Case& c, const ShadowPlan& plan, const Box& where) {
  double worst = 0.0;
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p{random.between(where.min.x, where.max.x), where.max.y,
                       random.between(where.min.z, where.max.z)};
    worst = std::max(worst, measure_perspective(plan.map[0], c.camera, p).m_max);
  }
  return worst;
}

TEST(Focus, an_empty_box_or_one_out_of_view_changes_no_bit) {
  Case c = plain_with_focus(60.0);
  c.options.warp.focus = {};
  const ShadowPlan without = c.plan();
  c.options.warp.focus_weight = 100.0;
  EXPECT_EQ(c.plan().map[0].clip_from_world, without.map[0].clip_from_world);
  c.options.warp.focus = {{-4, -1, 100}, {4, 0, 108}};  // behind the viewer
  EXPECT_EQ(c.plan().map[0].clip_from_world, without.map[0].clip_from_world);
}

TEST(Focus, broken_boxes_and_weights_are_refused_by_name) {
  Case c = plain_with_focus(60.0);
  c.options.warp.focus.min.x = std::nan("");
  EXPECT_EQ(c.plan().invalid_field, "options.warp.focus");
  c = plain_with_focus(60.0);
  c.options.warp.focus_weight = 0.5;
  EXPECT_EQ(c.plan().invalid_field, "options.warp.focus_weight");
}

TEST(Focus, the_worst_texel_inside_shrinks_by_the_objective_that_minds_it) {
  // A perspective's texels only ever grow with distance: the nearer the focus, the less there is to win.
  for (const auto& [distance, share] : {std::pair{60.0, 0.97}, {100.0, 0.95}, {150.0, 0.9}}) {
    Case c = plain_with_focus(distance);
    c.options.warp.objective = Objective::max;
    c.options.warp.focus_weight = 16.0;
    const Box focus = c.options.warp.focus;
    const double with = error_in(c, c.plan(), focus);
    c.options.warp.focus = {};
    EXPECT_LT(with, share * error_in(c, c.plan(), focus)) << distance;
  }
}

TEST(Focus, everything_in_view_keeps_its_map) {
  std::uint64_t points = 0;
  for_all(300, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 6});
    c.options.fit = chance(0.5) ? Fit::tight : Fit::rotated;
    const Box& near = c.receivers.front();
    c.options.warp.focus = {near.min, (near.min + near.max) * 0.5};
    c.options.warp.focus_weight = std::pow(10.0, between(0.0, 4.0));
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    Random random(3);
    for (const glm::dvec3& p : visible_points(c, random, 4, 4)) {
      const ShadowMap* map = map_for(plan, depth_of(c.camera, p));
      if (map == nullptr) continue;
      const glm::dvec4 clip = map->clip_from_world * glm::dvec4(p, 1.0);
      constexpr double kEdge = 1.0 + 1e-6;
      require(clip.w > 0.0 && std::abs(clip.x) <= kEdge * clip.w && std::abs(clip.y) <= kEdge * clip.w,
              "outside", clip.x / clip.w, clip.y / clip.w);
      ++points;
    }
  });
  EXPECT_GT(points, 500u);
}

}  // namespace
}  // namespace gnomon::test
