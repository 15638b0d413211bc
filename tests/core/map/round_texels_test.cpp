// Do local lights' maps of the paraboloid shape have texels even in angle where that lowers the error, and
// hold what linear ones hold?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "gnomon/extend/shape.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/study/bias.hpp"
#include "support/fitted_shapes.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

const Shape& kShape = shapes::paraboloid;

/// Slopes off the axis of a place in the square.
glm::dvec2 slopes_at(const RoundShape& round, const glm::dvec2& ndc) {
  return glm::mix(round.slopes.low, round.slopes.high, ndc * 0.5 + 0.5);
}

TEST(ParaboloidShape, places_a_ray_by_the_tangent_of_half_its_angle) {
  const RoundShape round = kShape.round({{-1.0, -1.0}, {1.0, 1.0}}, {100.0, 100.0}, 0);
  const TexelGrid grid{100, 100, &kShape, round.parameters};
  // Towards the middle of a side of a cube's face: 45 degrees off the axis, the last texel.
  EXPECT_NEAR(grid.place({1.0, 0.0}).texel.x, 100.0, 1e-9);
  const double half_way = std::tan(std::atan(0.5) / 2.0) / std::tan(std::atan(1.0) / 2.0);
  EXPECT_NEAR(grid.place({0.5, 0.0}).texel.x, 50.0 + 50.0 * half_way, 1e-9);
  EXPECT_NEAR(grid.place({0.0, 0.0}).texel.y, 50.0, 1e-9);
}

TEST(ParaboloidShape, shows_slopes_and_margin_and_bounds_its_texels) {
  for (const ShapeRectangle& slopes : rectangles_of_slopes()) {
    for (const int margin : {0, 3, 40}) {
      const glm::dvec2 size(320.0, 200.0), extent = slopes.high - slopes.low;
      const RoundShape round = kShape.round(slopes, size, margin);
      const TexelGrid grid{320, 200, &kShape, round.parameters};
      const glm::dvec2 half = 0.5 * (round.slopes.high - round.slopes.low);
      glm::dvec2 least(1e9), most(-1e9);
      for (int i = 0; i <= 20; ++i) {
        for (int k = 0; k <= 20; ++k) {
          const glm::dvec2 at = glm::mix(slopes.low, slopes.high, glm::dvec2(i, k) / 20.0);
          const glm::dvec2 ndc = (at - 0.5 * (round.slopes.low + round.slopes.high)) / half;
          const ShapedPoint p = grid.place(ndc);
          least = glm::min(least, p.texel);
          most = glm::max(most, p.texel);
          // A margin round every receiver lies in the square, where casters are drawn.
          for (const glm::dvec2 step : {glm::dvec2(margin, 0), glm::dvec2(-margin, 0), glm::dvec2(0, margin),
                                        glm::dvec2(0, -margin)}) {
            const glm::dvec2 beside = grid.ndc_of(p.texel + step);
            // Farther than 89 degrees off the axis there is none.
            EXPECT_TRUE(half.y > 50.0 || std::max(std::abs(beside.x), std::abs(beside.y)) <= 1.0 + 1e-9);
          }
          const glm::dmat2 slope_from_texel =
              glm::dmat2(half.x, 0, 0, half.y) * glm::inverse(p.texel_from_ndc);
          const glm::dvec2 linear = extent / (size - 2.0 * margin);
          EXPECT_LE(glm::length(slope_from_texel[0]), linear.x * round.longest.x * (1.0 + 1e-9));
          EXPECT_LE(glm::length(slope_from_texel[1]), linear.y * round.longest.y * (1.0 + 1e-9));
        }
      }
      // All of the map but its margin is used.
      EXPECT_GE(std::min(least.x, least.y), margin - 1e-6);
      EXPECT_LE(most.x, 320.0 - margin + 1e-6);
      EXPECT_LE(most.y, 200.0 - margin + 1e-6);
      EXPECT_LT(least.x, margin + 4.0);
      EXPECT_GT(most.y, 196.0 - margin);
      EXPECT_TRUE(std::isfinite(slopes_at(round, {1.0, -1.0}).x));
    }
  }
}

/// A hall with boxes under a local light, seen from a corner.
struct Hall {
  Camera camera = perspective_camera({-9, 3, 9}, {0.8, -0.25, -1}, {0, 1, 0}, 1.1, 1.5, 0.2, 60.0, 600, 400);
  std::vector<Box> boxes{
      {{-12, -0.2, -12}, {12, 0, 12}}, {{-12, 0, -12.2}, {12, 8, -12}}, {{12, 0, -12}, {12.2, 8, 12}}};
  Hall() {
    for (int i = 0; i < 8; ++i) {
      const double x = -8.0 + 2.3 * i, z = 6.0 - 1.9 * i;
      boxes.push_back({{x, 0, z}, {x + 0.8, 1.0 + 0.2 * i, z + 0.8}});
    }
  }
  [[nodiscard]] static PlanOptions options(const Shape& shape, Partition partition = Partition::view_depth) {
    PlanOptions options;
    options.cascades = 1;
    options.resolution.max_size = 512;
    options.split.partition = partition;
    options.warp.warp = &warps::none;
    options.warp.shape = &shape;
    options.prune = kPruneNothing;
    return options;
  }
  [[nodiscard]] ShadowPlan plan(const Light& light, const PlanOptions& options) const {
    return make_plan(camera, light, {boxes, boxes}, options);
  }
  /// Errors of points all over the floor that maps hold: the longer of m_s and m_t.
  [[nodiscard]] std::vector<double> errors(const ShadowPlan& plan) const {
    std::vector<double> all;
    const CameraAxes axes = camera_axes(camera);
    for (double x = -11.5; x < 12.0; x += 0.25) {
      for (double z = -11.5; z < 12.0; z += 0.25) {
        const glm::dvec3 p(x, 0.0, z), ray = p - camera.position;
        const double depth = glm::dot(ray, axes.forward);
        const double s = glm::dot(ray, axes.right) / depth, t = glm::dot(ray, axes.up) / depth;
        if (!(depth > camera.near_depth) || s < camera.left || s > camera.right || t < camera.bottom ||
            t > camera.top)
          continue;
        const int map = map_serving(plan, p, depth);
        if (map < 0) continue;
        const PointAliasing m = measure_point(plan.map[static_cast<std::size_t>(map)], camera, p, {0, 1, 0});
        if (m.status == PointAliasing::Status::ok) all.push_back(std::max(m.m_s, m.m_t));
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }
};
int shaped(const ShadowPlan& plan) {
  return static_cast<int>(std::count_if(plan.maps().begin(), plan.maps().end(),
                                        [](const ShadowMap& map) { return map.shape == &kShape; }));
}
bool ignores_shape(const ShadowPlan& plan) {
  return std::any_of(plan.omitted().begin(), plan.omitted().end(), [](const Omission& o) {
    return o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(IgnoredOption::shape);
  });
}
bool gains_nothing(const ShadowPlan& plan) {
  return std::any_of(plan.omitted().begin(), plan.omitted().end(),
                     [](const Omission& o) { return o.kind == OmissionKind::shape_without_gain; });
}

TEST(ParaboloidMap, of_a_wide_spot_is_as_good_as_the_faces_of_a_cube_with_as_many_texels) {
  const Hall hall;
  const SpotLight spot{{-4, 5, 3}, {0.0, -1.0, -0.0}, 1.45, 40.0};
  const ShadowPlan round = hall.plan(spot, Hall::options(kShape));
  ASSERT_EQ(round.map_count, 1);
  PlanOptions options = Hall::options(shapes::linear);
  options.resolution.max_size = 229;  // five of them have the texels of one of 512
  const ShadowPlan faces = hall.plan(spot, options);
  ASSERT_EQ(faces.map_count, 5);
  const std::vector<double> before = hall.errors(faces), now = hall.errors(round);
  EXPECT_LT(now[now.size() / 2], 1.1 * before[before.size() / 2]);
  EXPECT_LT(now[now.size() * 95 / 100], 1.1 * before[before.size() * 95 / 100]);
}

TEST(ParaboloidMap, of_a_tetrahedron_holds_the_receivers_of_linear_ones_and_has_no_more_error) {
  const Hall hall;
  const PointLight light{{-4, 5, 3}, 40.0};
  PlanOptions options = Hall::options(kShape, Partition::tetrahedron);
  options.filter.texels = 4.0;
  const ShadowPlan round = hall.plan(light, options);
  options.warp.shape = &shapes::linear;
  const ShadowPlan linear = hall.plan(light, options);
  ASSERT_EQ(round.map_count, linear.map_count);
  EXPECT_GT(shaped(round), 0);
  for (double x = -11.5; x < 12.0; x += 0.5) {
    for (double z = -11.5; z < 12.0; z += 0.5) {
      const glm::dvec3 p(x, 0.0, z);
      for (int i = 0; i < round.map_count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const ShadowMap &a = round.map[at], &b = linear.map[at];
        if (!map_holds(linear, b, p)) continue;
        EXPECT_TRUE(map_holds(round, a, p)) << i << " " << x << " " << z;
        if (a.shape != &kShape) continue;
        const glm::dvec2 extent = texel_extent_world(a.clip_from_world, a.texels(),
                                                     glm::normalize(p - glm::dvec3(a.light_world)), p);
        EXPECT_LE(extent.x, a.texel_world_max.x * (1.0 + 1e-9));
        EXPECT_LE(extent.y, a.texel_world_max.y * (1.0 + 1e-9));
      }
    }
  }
  const std::vector<double> before = hall.errors(linear), now = hall.errors(round);
  EXPECT_LE(now[now.size() * 95 / 100], 1.05 * before[before.size() * 95 / 100]);
}

TEST(ParaboloidMap, without_a_warp_named_none_is_taken_and_a_warp_that_is_named_keeps_its_texels) {
  const Hall hall;
  const SpotLight spot{{-4, 5, 3}, {0.0, -1.0, -0.0}, 1.45, 40.0};
  PlanOptions options = Hall::options(kShape);
  options.warp.warp = nullptr;
  EXPECT_EQ(shaped(hall.plan(spot, options)), 1);
  options.warp.warp = &warps::lispsm;
  const ShadowPlan warped = hall.plan(spot, options);
  ASSERT_EQ(warped.map_count, 1);
  if (warped.map[0].kappa > 0.0) {
    EXPECT_EQ(shaped(warped), 0);
    EXPECT_TRUE(gains_nothing(warped));
  }
  // A narrow cone looks alike either way.
  const ShadowPlan narrow =
      hall.plan(SpotLight{{-4, 5, 3}, {0.3, -1.0, -0.2}, 0.05, 40.0}, Hall::options(kShape));
  for (const ShadowMap& map : narrow.maps()) EXPECT_TRUE(map.shape == &kShape || gains_nothing(narrow));
}

TEST(ParaboloidMap, is_linear_where_rays_are_parallel_and_maps_are_kept) {
  const Hall hall;
  const SpotLight spot{{-4, 5, 3}, {0.0, -1.0, -0.0}, 1.45, 40.0};
  const auto expect_linear = [](const ShadowPlan& plan) {
    ASSERT_EQ(plan.status, PlanStatus::ok);
    EXPECT_EQ(shaped(plan), 0);
    EXPECT_TRUE(ignores_shape(plan));
  };
  expect_linear(hall.plan(DirectionalLight{{0.3, -1.0, 0.2}}, Hall::options(kShape)));
  PlanOptions stable = Hall::options(kShape);
  stable.fit = Fit::stable;
  expect_linear(hall.plan(spot, stable));
  PlanOptions sized = Hall::options(kShape);
  sized.resolution.max_error = 1.0;
  expect_linear(hall.plan(spot, sized));
  // With a map that may be smaller than it is given.
  PlanOptions pruned = Hall::options(kShape);
  pruned.resolution.max_size = 4096;
  pruned.prune = {};
  const ShadowPlan smaller = hall.plan(SpotLight{{-4, 5, 3}, {0.3, -1.0, -0.2}, 0.1, 40.0}, pruned);
  ASSERT_EQ(smaller.map_count, 1);
  EXPECT_LT(smaller.map[0].width, 4096);
  EXPECT_EQ(shaped(smaller), 0);
  EXPECT_TRUE(gains_nothing(smaller));
  PlanHistory history;
  expect_linear(make_plan(hall.camera, spot, {hall.boxes, hall.boxes}, Hall::options(kShape), &history));
}

}  // namespace
}  // namespace gnomon::test
