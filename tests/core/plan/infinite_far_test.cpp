// Does a camera that sees without end get the plan of one that sees as far as there is anything?
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 ndc(const glm::dmat4& m, const glm::dvec3& p) {
  const glm::dvec4 h = m * glm::dvec4(p, 1.0);
  return glm::dvec3(h) / h.w;
}

/// A sloping sun over a ground and a box.
Case scene() {
  Case c;
  c.camera = perspective_camera({3, 6, 10}, {0.2, -0.3, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 150.0, 800, 500);
  c.light = {0.4, -1.0, 0.3};
  c.receivers = {{{-60, -1, -120}, {60, 0, 20}}, {{-10, 0, -40}, {4, 6, -20}}};
  c.casters = c.receivers;
  c.options.cascades = 1;
  c.options.warp.warp = &warps::lispsm;
  return c;
}

TEST(InfiniteFar, the_matrix_tends_to_that_of_ever_farther_planes) {
  Camera camera = scene().camera;
  camera.far_depth = kInfinity;
  Camera distant = camera;
  distant.far_depth = 1e12;
  const glm::dmat4 endless = clip_from_view(camera), far = clip_from_view(distant);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) EXPECT_NEAR(endless[column][row], far[column][row], 1e-11);
  }
  EXPECT_EQ(ndc(endless, {0, 0, -camera.near_depth}).z, -1.0);
  const glm::dvec4 horizon = endless * glm::dvec4(0, 0, -1, 0);
  EXPECT_EQ(horizon.z, horizon.w);
}

TEST(InfiniteFar, an_orthographic_matrix_is_finite_and_flat) {
  Camera camera = orthographic_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 10.0, 1.0, 1.0, kInfinity, 100, 100);
  EXPECT_EQ(ndc(clip_from_view(camera), {5, 5, -7}), glm::dvec3(1, 1, -1));
}

TEST(InfiniteFar, the_far_plane_stands_as_far_as_the_farthest_corner_or_less_than_a_step_behind) {
  for_all(500, [&] {
    Case c = draw_case({.max_boxes = 6});
    const Camera finite = with_finite_far(c.camera, c.receivers);
    require(finite.far_depth == c.camera.far_depth, "a finite plane moved");
    c.camera.far_depth = kInfinity;
    c.receivers.push_back(Box{});
    const Camera cut = with_finite_far(c.camera, c.receivers);
    Box all;
    for (const Box& box : c.receivers) all.extend(box);
    double farthest = 0.0;
    for (int corner = 0; corner < 8 && !all.empty(); ++corner) {
      const glm::dvec3 p(corner & 1 ? all.min.x : all.max.x, corner & 2 ? all.min.y : all.max.y,
                         corner & 4 ? all.min.z : all.max.z);
      farthest = std::max(farthest, glm::length(p - c.camera.position));
    }
    const double n = c.camera.near_depth;
    const double slack = 1e-9 * std::abs(farthest);
    require(cut.far_depth > n && cut.far_depth >= farthest - slack, "far", cut.far_depth, "of", farthest);
    // 2^(1/2) = 1.41, or the one step that is always there.
    const double reach = c.camera.orthographic
                             ? n + 1.42 * std::max(farthest - n, 0.001 * (c.camera.top - c.camera.bottom))
                             : 1.42 * std::max(farthest, n);
    require(cut.far_depth <= reach + slack, "far", cut.far_depth, "beyond", reach);
  });
}

TEST(InfiniteFar, a_plan_is_the_one_of_the_finite_camera_and_serves_all_receivers) {
  int planned = 0;
  for_all(400, [&] {
    Case c = draw_case({.max_depth_ratio = 1e4, .max_boxes = 6});
    c.camera.far_depth = kInfinity;
    c.options.split.pseudo_near = 0.0;
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
    Case finite = c;
    finite.camera = with_finite_far(c.camera, c.receivers);
    const ShadowPlan same = finite.plan();
    require(plan.status == same.status && plan.map_count == same.map_count, "status");
    for (int i = 0; i < plan.map_count; ++i) {
      const ShadowMap &m = plan.map[static_cast<std::size_t>(i)], &n = same.map[static_cast<std::size_t>(i)];
      require(m.clip_from_world == n.clip_from_world, "map", i);
    }
    if (plan.map_count == 0) return;
    ++planned;
    const AliasingStats stats = measure(plan, c.camera, c.bounds(), {4, 4, 8});
    require(!std::isnan(stats.max) && stats.max == measure(plan, finite.camera, c.bounds(), {4, 4, 8}).max,
            "measure", stats.max);
  });
  EXPECT_GT(planned, 100);
}

TEST(InfiniteFar, a_tight_plan_is_equal_for_an_infinite_camera_and_one_that_sees_as_far) {
  Case c = scene();
  c.options.cascades = 4;
  const ShadowPlan before = c.plan();
  c.camera.far_depth = kInfinity;
  const ShadowPlan after = c.plan();
  ASSERT_EQ(before.map_count, after.map_count);
  for (int i = 0; i < before.map_count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    EXPECT_CLOSE(before.map[index].depth_end, after.map[index].depth_end, 1e-9);
    EXPECT_CLOSE(before.map[index].texel_world.x, after.map[index].texel_world.x, 1e-6);
  }
}

TEST(InfiniteFar, nothing_ahead_is_nothing_visible_and_a_near_plane_of_zero_is_refused) {
  Case c = scene();
  c.camera.far_depth = kInfinity;
  c.camera.forward = {0, 0, 1};
  c.camera.position = {0, 5, 1000};
  const ShadowPlan plan = c.plan();
  EXPECT_EQ(plan.status, PlanStatus::nothing_visible);
  EXPECT_EQ(plan.origin_world, c.camera.position);
  c.camera.near_depth = 0.0;
  EXPECT_EQ(c.plan().invalid_field, "camera.near_depth");
}

TEST(InfiniteFar, a_near_plane_whose_ratio_to_the_visible_depths_overflows_is_refused) {
  Case c = scene();
  c.camera.far_depth = kInfinity;
  for (const double n : {5e-324, 1e-310, 1e-300}) {
    c.camera.near_depth = n;
    EXPECT_LT(with_finite_far(c.camera, c.bounds().receivers).far_depth, kInfinity) << n;
    const ShadowPlan plan = c.plan();
    EXPECT_EQ(plan.invalid_field, "camera.near_depth") << n;
    EXPECT_EQ(measure(plan, c.camera, c.bounds()).samples, 0u) << n;
  }
}

TEST(InfiniteFar, a_stable_grid_holds_still_while_the_camera_walks) {
  Case c = scene();
  c.camera.far_depth = kInfinity;
  c.options.fit = Fit::stable;
  c.options.warp.warp = nullptr;
  int changes = 0;
  glm::dvec2 texel(0.0);
  for (int frame = 0; frame < 100; ++frame) {
    c.camera.position.z -= 0.05;  // 5 units of 140 in all
    const ShadowPlan plan = c.plan();
    ASSERT_EQ(plan.map_count, 1);
    changes += plan.map[0].snap_key.texel != texel;
    texel = plan.map[0].snap_key.texel;
  }
  EXPECT_LE(changes, 2);  // the first frame's, and one step
}

TEST(InfiniteFar, a_stable_grid_is_the_same_wherever_the_camera_looks) {
  Case c = scene();
  c.options.fit = Fit::stable;
  c.options.cascades = 4;
  for (const double far_depth : {150.0, 1e4, kInfinity}) {
    c.camera.far_depth = far_depth;
    std::array<glm::dvec2, 4> texel{};
    for (int degree = 0; degree < 360; degree += 5) {
      const double angle = degree / 57.29577951308232;
      c.camera.forward = {std::sin(angle), -0.3, -std::cos(angle)};
      const ShadowPlan plan = c.plan();
      for (const ShadowMap& map : plan.maps()) {
        glm::dvec2& known = texel[static_cast<std::size_t>(map.cascade)];
        if (known.x == 0.0) known = map.snap_key.texel;
        ASSERT_EQ(map.snap_key.texel, known) << degree << " degrees, far " << far_depth;
      }
    }
    EXPECT_GT(texel[3].x, 0.0);
  }
}

// docs/integration.md, "How far do shadows reach?"
TEST(InfiniteFar, a_far_plane_behind_all_receivers_costs_nothing) {
  Case c;
  c.camera = perspective_camera({0, 1.7, 5}, {0, -0.08, -1}, {0, 1, 0}, 1.1, 1.5, 0.05, 5000.0, 1920, 1280);
  c.light = {0.4, -0.7, -0.3};
  c.receivers = c.casters = {{{-1000, -1, -1000}, {1000, 0, 1000}}, {{-4, 0, -40}, {4, 20, -30}}};
  const auto p95 = [&](Fit fit, double far_depth) {
    Case tried = c;
    tried.options.fit = fit;
    tried.camera.far_depth = far_depth;
    return measure(tried.plan(), tried.camera, tried.bounds()).p95;
  };
  // The depths that are sampled lie elsewhere.
  for (const Fit fit : {Fit::tight, Fit::rotated, Fit::stable, Fit::warped_stable})
    EXPECT_NEAR(p95(fit, 5000.0) / p95(fit, kInfinity), 1.0, 0.05);
  EXPECT_LT(p95(Fit::stable, 150.0), 0.5 * p95(Fit::stable, kInfinity));
}

}  // namespace
}  // namespace gnomon::test
