// Do the biases in world units keep a plane from shadowing itself, from the texel's own size?
#include "gnomon/study/bias.hpp"
#include "gnomon/extend/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kRounding = 1e-12;
// A map round a single point has texels near the rounding of that point's position: nothing to difference
// there.
constexpr double kFinestTexel = 1e-9;

bool too_fine(const ShadowMap& map, const glm::dvec3& p) {
  return !(std::min(map.texel_world.x, map.texel_world.y) > kFinestTexel * glm::length(p));
}

TEST(Bias, a_map_of_two_units_over_two_texels_has_texels_of_one_unit) {
  const glm::dvec2 texel = texel_extent_world(glm::dmat4(1.0), {2, 4}, {0, 0, -1}, {0, 0, 0});
  EXPECT_CLOSE(texel.x, 1.0, kRounding);
  EXPECT_CLOSE(texel.y, 0.5, kRounding);
}

TEST(Bias, a_singular_map_and_a_point_behind_it_have_no_texel) {
  glm::dmat4 flat(1.0);
  flat[0][0] = 0.0;
  EXPECT_TRUE(std::isinf(texel_extent_world(flat, {8, 8}, {0, 0, -1}, {0, 0, 0}).x));
  glm::dmat4 behind(1.0);
  behind[3][3] = -1.0;
  EXPECT_TRUE(std::isinf(texel_extent_world(behind, {8, 8}, {0, 0, -1}, {0, 0, 0}).y));
}

TEST(Bias, a_surface_that_faces_the_light_needs_only_the_constant_part) {
  const BiasOptions options{0.1, 0.5, 0.0, 8.0};
  EXPECT_CLOSE(slope_bias_world(options, 2.0, 3.0, {0, 1, 0}, {0, -1, 0}), 0.2, kRounding);
}

TEST(Bias, the_slope_is_capped_at_grazing_light_and_for_surfaces_turned_away) {
  const BiasOptions options{0.0, 0.5, 0.0, 8.0};
  EXPECT_CLOSE(slope_bias_world(options, 1.0, 0.0, {1, 0, 0}, {0, -1, 0}), 4.0, kRounding);
  EXPECT_CLOSE(slope_bias_world(options, 1.0, 0.0, {0, -1, 0}, {0, -1, 0}), 4.0, kRounding);
  const glm::dvec3 grazing = glm::normalize(glm::dvec3(1.0, 0.01, 0.0));
  EXPECT_CLOSE(slope_bias_world(options, 1.0, 0.0, grazing, {0, -1, 0}), 4.0, kRounding);
  const glm::dvec3 half = glm::normalize(glm::dvec3(1.0, 1.0, 0.0));  // tan = 1
  EXPECT_CLOSE(slope_bias_world(options, 1.0, 1.5, half, {0, -1, 0}), 2.0, kRounding);
}

TEST(Bias, a_map_carries_its_options_times_its_texel) {
  const Camera camera = perspective_camera({0, 5, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 100, 640, 480);
  const Box ground{{-50, -1, -100}, {50, 0, 10}};
  PlanOptions options;
  options.bias = {0.25, 1.5, 2.0, 8.0};
  const ShadowPlan plan =
      make_plan(camera, DirectionalLight{{0.2, -1, 0.1}}, {{&ground, 1}, {&ground, 1}}, options);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  for (const ShadowMap& map : plan.maps()) {
    const double texel = std::max(map.texel_world.x, map.texel_world.y);
    EXPECT_CLOSE(map.bias_world.constant, 0.25 * texel, kRounding);
    EXPECT_CLOSE(map.bias_world.slope, 1.5 * texel, kRounding);
    EXPECT_CLOSE(map.bias_world.normal_offset, 2.0 * texel, kRounding);
  }
}

TEST(BiasProperty, a_move_along_the_light_changes_depth_by_the_stated_amount_and_nothing_across) {
  std::uint64_t moves = 0;
  for_all(500, [&] {
    const Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 8});
    const ShadowPlan plan = c.plan();
    Random random(5);
    for (const glm::dvec3& p : visible_points(c, random, 2, 3)) {
      const ShadowMap* map = map_for(plan, depth_of(c.camera, p));
      if (map == nullptr || too_fine(*map, p)) continue;
      ++moves;
      const double step = 0.01 * map->depth_range_world;
      const glm::dvec4 a = map->clip_from_world * glm::dvec4(p, 1.0);
      const glm::dvec4 b = map->clip_from_world * glm::dvec4(p - plan.light_direction * step, 1.0);
      const double told = step * ndc_depth_per_world_unit(map->clip_from_world, plan.light_direction, p);
      // Positions lie up to four frustum lengths from the origin; narrow maps magnify their rounding.
      require(std::abs(b.z / b.w - a.z / a.w - told) <= 1e-7, "depth", b.z / b.w - a.z / a.w, "told", told);
      require(told < 0.0, "towards the light depth falls:", told);
      require(std::abs(b.x / b.w - a.x / a.w) <= 1e-7 && std::abs(b.y / b.w - a.y / a.w) <= 1e-7,
              "moved across", b.x / b.w - a.x / a.w, b.y / b.w - a.y / a.w, "by", step, "of texels",
              map->texel_world.x, map->texel_world.y);
    }
  });
  EXPECT_GT(moves, 500u);
}

TEST(BiasProperty, a_step_of_one_texel_in_the_map_is_as_long_as_the_extent_says) {
  std::uint64_t steps = 0;
  for_all(500, [&] {
    const Case c = draw_case({.max_depth_ratio = 1e2, .max_boxes = 8});
    const ShadowPlan plan = c.plan();
    Random random(5);
    for (const glm::dvec3& p : visible_points(c, random, 2, 3)) {
      const ShadowMap* map = map_for(plan, depth_of(c.camera, p));
      if (map == nullptr || too_fine(*map, p)) continue;
      ++steps;
      const glm::dvec2 extent =
          texel_extent_world(map->clip_from_world, map->texels(), plan.light_direction, p);
      // Inverse of d(texel) / d(across), by differences across the light.
      const glm::dvec3 u = any_across(plan.light_direction), v = glm::cross(plan.light_direction, u);
      const double h = 1e-4 * std::min(extent.x, extent.y);
      const auto texel = [&](const glm::dvec3& at) {
        const glm::dvec4 clip = map->clip_from_world * glm::dvec4(at, 1.0);
        return glm::dvec2(0.5 * map->width * clip.x / clip.w, 0.5 * map->height * clip.y / clip.w);
      };
      const glm::dvec2 du = (texel(p + u * h) - texel(p - u * h)) / (2.0 * h);
      const glm::dvec2 dv = (texel(p + v * h) - texel(p - v * h)) / (2.0 * h);
      const double area = std::abs(du.x * dv.y - du.y * dv.x);
      const double along_x = std::hypot(dv.y, du.y) / area, along_y = std::hypot(dv.x, du.x) / area;
      // Differences of a ten-thousandth texel at positions far from the origin.
      require(deviation(along_x, extent.x) <= 1e-3 && deviation(along_y, extent.y) <= 1e-3, "extent",
              extent.x, extent.y, "differences", along_x, along_y);
    }
  });
  EXPECT_GT(steps, 500u);
}

}  // namespace
}  // namespace gnomon::test
