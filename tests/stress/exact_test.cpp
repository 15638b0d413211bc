// Is the judge right? Vertices, condition numbers and errors whose values are known.
#include "exact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "judge.hpp"

namespace gnomon::stress {
namespace {

TEST(Exact, vertices_of_a_box_in_view_and_of_a_frustum_in_a_box) {
  const Camera camera =
      perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.5707963267948966, 1.0, 1.0, 100.0, 64, 64);
  EXPECT_EQ(visible_vertices(camera, {{-1, -1, -12}, {1, 1, -10}}, 1.0, 100.0).size(), 8u);
  const std::vector<Real3> frustum =
      visible_vertices(camera, {glm::dvec3(-500), glm::dvec3(500)}, 1.0, 100.0);
  ASSERT_EQ(frustum.size(), 8u);
  Real widest = 0.0L;
  for (const Real3& p : frustum) widest = std::max(widest, std::abs(p.x));
  EXPECT_NEAR(static_cast<double>(widest), 100.0, 1e-12);
  EXPECT_TRUE(visible_vertices(camera, {{-1, -1, 10}, {1, 1, 12}}, 1.0, 100.0).empty());
}

TEST(Exact, condition_numbers_of_diagonal_and_turned_matrices) {
  EXPECT_DOUBLE_EQ(condition_number(Real4x4(3.0L)), 1.0);
  Real4x4 m(1.0L);
  m[2][2] = 1e-12L;
  EXPECT_NEAR(condition_number(m) * 1e-12, 1.0, 1e-9);
  const Real c = std::cos(0.7L), s = std::sin(0.7L);
  Real4x4 turn(1.0L);
  turn[0] = {c, s, 0, 0};
  turn[1] = {-s, c, 0, 0};
  EXPECT_NEAR(condition_number(turn * m) * 1e-12, 1.0, 1e-9);
  m[2] = m[1];
  EXPECT_GT(condition_number(m), 1e15);
}

TEST(PlanCheck, sees_a_map_that_is_off_by_two_thousandths_of_a_texel) {
  for (const Fit fit : {Fit::tight, Fit::stable}) {
    Input input = plain_input(0);
    input.options.fit = fit;
    ShadowPlan plan = input.plan();
    ASSERT_EQ(plan.status, PlanStatus::ok);
    EXPECT_LT(judge(input, plan).error_texels, 1e-9);
    glm::dmat4& m = plan.map[0].clip_from_world;
    for (int column = 0; column < 4; ++column) m[column][0] += m[column][3] * 4e-3 / plan.map[0].width;
    EXPECT_NEAR(judge(input, plan).error_texels, 2e-3, 1e-4) << to_string(fit);
  }
}

TEST(PlanCheck, sees_a_map_that_does_not_look_along_the_light) {
  Input input = plain_input(0);
  const ShadowPlan plan = input.plan();
  const auto& light = std::get<DirectionalLight>(input.light);
  input.light = DirectionalLight{light.direction + glm::dvec3(1e-9, 0, 0)};
  const Judgement turned = judge(input, plan);
  EXPECT_GT(turned.drift_texels, 1e-9);
  EXPECT_GE(turned.error_texels, turned.drift_texels);
}

TEST(PlanCheck, sees_what_is_no_number) {
  const Input input = plain_input(0);
  ShadowPlan plan = input.plan();
  EXPECT_TRUE(all_finite(plan));
  plan.map[0].clip_from_world[2][1] = std::nan("");
  EXPECT_FALSE(all_finite(plan));
}

TEST(PlanCheck, computes_texels_per_area) {
  Input input = plain_input(0);
  input.light = DirectionalLight{{0, -1, 0}};
  input.options.warp.warp = &warps::none;
  const ShadowPlan plan = input.plan();
  const ShadowMap& map = plan.map[0];
  const double expected = 1.0 / (map.texel_world.x * map.texel_world.y);
  EXPECT_NEAR(texel_density(map, {1, 0, -5}) / expected, 1.0, 1e-9);
}

}  // namespace
}  // namespace gnomon::stress
