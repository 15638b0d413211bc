// Does the metric give the numbers one can work out by hand, and the right word where there is none?
#include "gnomon/measure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

using Status = PointAliasing::Status;
constexpr double kRounding = 1e-12;

/// An orthographic map straight down onto [-1, 1]^2 of the xz plane, `size` texels a side.
ShadowMap map_from_above(int size) {
  ShadowMap map;
  map.width = map.height = size;
  map.clip_from_world = glm::dmat4(1, 0, 0, 0, 0, 0, -0.1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
  map.light_world = {0, 1, 0, 0};
  return map;
}

/// A perspective map straight down from (0.5, 3, 0), onto [-1, 1]^2 round (0.5, 0, 0).
ShadowMap local_map(int size) {
  ShadowMap map;
  map.width = map.height = size;
  // w = 3 - y, x = 3 (x - 0.5), y = -3 z, depth from 1 to 4 away from the light.
  map.clip_from_world = glm::dmat4(3, 0, 0, 0, 0, 0, -5.0 / 3.0, -1, 0, -3, 0, 0, -1.5, 0, 7.0 / 3.0, 3);
  map.light_world = {0.5, 3, 0, 1};
  return map;
}

/// A camera straight down from `height`, 100 pixels over two units at the ground.
Camera camera_from_above(double height) {
  Camera camera;
  camera.position = {0, height, 0};
  camera.forward = {0, -1, 0};
  camera.up = {0, 0, -1};
  camera.left = camera.bottom = -1.0 / height;
  camera.right = camera.top = 1.0 / height;
  camera.width = camera.height = 100;
  return camera;
}

TEST(Metric, a_map_with_half_the_pixels_has_texels_of_two_pixels) {
  const PointAliasing m = measure_point(map_from_above(50), camera_from_above(4.0), {0, 0, 0}, {0, 1, 0});
  ASSERT_EQ(m.status, Status::ok);
  for (const double extent : {m.m_max, m.m_min, m.m_s, m.m_t, m.m_area, m.perspective_max}) {
    EXPECT_CLOSE(extent, 2.0, kRounding);
  }
  EXPECT_CLOSE(m.anisotropy, 1.0, kRounding);
  EXPECT_CLOSE(m.projection, 1.0, kRounding);
}

TEST(Metric, twice_as_far_the_texels_are_half_as_large_on_screen) {
  const ShadowMap map = map_from_above(50);
  Camera camera = camera_from_above(4.0);
  camera.position.y = 8.0;
  EXPECT_CLOSE(measure_perspective(map, camera, {0, 0, 0}).m_max, 1.0, kRounding);
}

TEST(Metric, what_a_map_holds_but_for_its_own_rounding_is_not_outside) {
  // The corner of a body that rounding alone made wide, in its map: at x = 1 + 1.2e-9 with exact arithmetic.
  ShadowMap map;
  map.width = map.height = 64;
  map.clip_from_world =
      glm::dmat4(66417038.428117387, -0.2619986964560585, 6704479.9479697431, 6704479.9479697431, 0, 0,
                 -12.210920994187061, 0, -24051410.185472954, -0.071672882772003815, -2427880.7833160996,
                 -2427880.7833160996, -8060986.113503864, -0.0014988864565391054, -813716.83912605606,
                 -813717.96571336209);
  map.light_world = {0, 1, 0, 0};
  const Camera camera =
      perspective_camera({0, 0, 0}, {0.94, -0.04, -0.34}, {0, 1, 0}, 1.55, 1.5, 0.006, 0.25, 101, 64);
  const glm::dvec3 corner(0.048970943276564823, 0.092420270703335861, -0.19992517193467149);
  EXPECT_EQ(measure_perspective(map, camera, corner).status, Status::ok);
  // A thousandth of a texel of the largest map is beside it.
  const ShadowMap wide = map_from_above(1 << 14);
  EXPECT_EQ(measure_perspective(wide, camera_from_above(4.0), {1.0 + 2e-7, 0, 0}).status, Status::outside);
}

TEST(Metric, light_straight_into_the_eye_gives_finite_numbers) {
  // e = -l: the rotation from eye ray to light ray is not unique, any serves.
  Camera camera = camera_from_above(4.0);
  camera.position = {0, -4, 0};
  camera.forward = {0, 1, 0};
  for (const double off : {0.0, 1e-14, 1e-9, 1e-5}) {
    const PointAliasing m = measure_perspective(map_from_above(50), camera, {off, 0, off});
    ASSERT_EQ(m.status, Status::ok);
    EXPECT_CLOSE(m.m_max, 2.0, 1e-4);
    EXPECT_CLOSE(m.m_area, 2.0, 1e-4);
  }
}

TEST(Metric, light_across_the_eye_ray_projects_by_the_ratio_of_cosines) {
  // A plane tilted by 60 degrees to the light: texels are twice as long on it.
  const glm::dvec3 normal{std::sin(1.0471975511965976), std::cos(1.0471975511965976), 0};
  Camera camera = camera_from_above(4.0);
  camera.position = normal * 4.0;
  camera.forward = -normal;
  const PointAliasing m = measure_point(map_from_above(50), camera, {0, 0, 0}, normal);
  EXPECT_CLOSE(m.projection, 2.0, kRounding);
  EXPECT_CLOSE(m.m_max, 4.0, kRounding);
  EXPECT_CLOSE(m.m_min, 2.0, kRounding);
  EXPECT_CLOSE(m.m_area * m.m_area, 8.0, kRounding);
}

TEST(Metric, a_hand_made_map_gets_its_light_from_its_matrix) {
  // Light along (-0.6, -0.8, 0): a floor has it at a cosine of 0.8, a camera from above at 1.
  ShadowMap tilted = map_from_above(50);
  tilted.clip_from_world = glm::dmat4(0.8, 0, -0.06, 0, -0.6, 0, -0.08, 0, 0, -1, 0, 0, 0, 0, 0, 1);
  const PointAliasing floor = measure_point(tilted, camera_from_above(4.0), {0, 0, 0}, {0, 1, 0});
  EXPECT_CLOSE(floor.projection, 1.0 / 0.8, kRounding);
  EXPECT_CLOSE(floor.m_area * floor.m_area, 4.0 / 0.8, kRounding);
  EXPECT_CLOSE(floor.perspective_max, 2.0, kRounding);
  // A local light at (0.5, 3, 0): at (-3.5, 0, 0) its rays come in at a cosine of 3 / 5.
  for (const glm::dvec4& light : {glm::dvec4(0, 1, 0, 0), glm::dvec4(0.5, 3, 0, 1), glm::dvec4(0)}) {
    ShadowMap local = local_map(50);
    local.light_world = light;
    const PointAliasing beside = measure_point(local, camera_from_above(4.0), {-0.4, 0, 0}, {0, 1, 0});
    EXPECT_CLOSE(beside.projection, (4.0 / std::sqrt(16.16)) / (3.0 / std::sqrt(9.81)), kRounding);
  }
  // From below: depth tells where the light comes from.
  ShadowMap below = map_from_above(50);
  below.clip_from_world[1][2] = 0.1;
  EXPECT_EQ(measure_point(below, camera_from_above(4.0), {0, 0, 0}, {0, 1, 0}).status, Status::ok)
      << "a light of the plan's own stands, whatever depth says";
  below.light_world = {0, 0, 1, 0};
  EXPECT_EQ(measure_point(below, camera_from_above(4.0), {0, 0, 0}, {0, 1, 0}).status, Status::faces_away);
}

TEST(Metric, a_matrix_that_shows_nothing_gives_no_number_that_is_none) {
  ShadowMap nothing = map_from_above(50);
  nothing.clip_from_world = glm::dmat4(0.0);
  EXPECT_EQ(measure_point(nothing, camera_from_above(4.0), {0, 0, 0}, {0, 1, 0}).status, Status::outside);
  nothing.clip_from_world[3][3] = 1.0;
  const PointAliasing m = measure_point(nothing, camera_from_above(4.0), {0, 0, 0}, {0, 1, 0});
  EXPECT_FALSE(std::isnan(m.m_max) || std::isnan(m.projection));
}

TEST(Metric, the_light_of_a_plans_matrix_is_the_plans_light) {
  int checked = 0;
  for_all(300, [&] {
    const Case c = draw_case();
    const ShadowPlan plan = c.plan();
    Random random(7);
    for (const glm::dvec3& point : visible_points(c, random, 2, 4)) {
      const int map = map_serving(plan, point, depth_of(c.camera, point));
      if (map < 0) continue;
      const ShadowMap& planned = plan.map[static_cast<std::size_t>(map)];
      ShadowMap hand_made = planned;
      hand_made.light_world = {};
      const glm::dvec3 normal = random.direction();
      const PointAliasing a = measure_point(planned, c.camera, point, normal);
      const PointAliasing b = measure_point(hand_made, c.camera, point, normal);
      const double grazing = std::abs(glm::dot(normal, glm::dvec3(planned.light_world)));
      if (a.status != Status::ok || grazing < 1e-3) continue;
      ++checked;
      // The light's direction from the matrix; gradients of a flat body's map are mostly rounding.
      require(std::abs(a.projection - b.projection) <= 1e-6 * a.projection, "planned", a.projection, "matrix",
              b.projection, c);
    }
  });
  EXPECT_GT(checked, 100);
}

TEST(Metric, outside_the_map_or_behind_it_the_error_is_infinite) {
  const Camera camera = camera_from_above(4.0);
  for (const glm::dvec3& p : {glm::dvec3(1.1, 0, 0), glm::dvec3(0, 0, -1.1)}) {
    const PointAliasing m = measure_point(map_from_above(50), camera, p, {0, 1, 0});
    EXPECT_EQ(m.status, Status::outside);
    EXPECT_TRUE(std::isinf(m.m_max) && std::isinf(m.perspective_max));
  }
  ShadowMap behind = map_from_above(50);
  behind.clip_from_world = behind.clip_from_world * -1.0;
  EXPECT_EQ(measure_perspective(behind, camera, {0, 0, 0}).status, Status::outside);
  EXPECT_EQ(measure_perspective(map_from_above(50), camera, {1.0, 0, 1.0}).status,
            Status::ok);  // the rim itself
}

TEST(Metric, edge_on_to_the_light_is_infinite_edge_on_to_both_is_undetermined) {
  Camera camera = camera_from_above(4.0);
  const PointAliasing both = measure_point(map_from_above(50), camera, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(both.status, Status::undetermined);
  camera.position = {4, 4, 0};
  camera.forward = {-1, -1, 0};
  const PointAliasing light = measure_point(map_from_above(50), camera, {0, 0, 0}, {1, 0, 0});
  EXPECT_FALSE(std::isnan(light.m_max));
  EXPECT_GT(light.m_max, 1e9);
  EXPECT_EQ(measure_point(map_from_above(50), camera, {0, 0, 0}, {-1, 0.1, 0}).status, Status::faces_away);
}

TEST(Metric, edge_on_to_the_eye_the_texel_shrinks_and_its_silhouette_stays_finite) {
  Camera camera = camera_from_above(4.0);
  camera.position = {4, 0, 0};
  camera.forward = {-1, 0, 0};
  camera.up = {0, 1, 0};
  const PointAliasing m =
      measure_point(map_from_above(50), camera, {0, 0, 0}, glm::normalize(glm::dvec3(1e-7, 1, 0)));
  ASSERT_EQ(m.status, Status::ok);
  EXPECT_LT(m.m_min, 1e-5);
  EXPECT_CLOSE(m.m_max, 2.0, 1e-5);
}

bool same_bits(const PointAliasing& a, const PointAliasing& b) {
  const auto numbers = [](const PointAliasing& m) {
    return std::array{m.m_max,      m.m_min,           m.m_s,           m.m_t,           m.m_area,
                      m.anisotropy, m.perspective_max, m.perspective_s, m.perspective_t, m.projection};
  };
  return a.status == b.status && std::bit_cast<std::array<std::uint64_t, 10>>(numbers(a)) ==
                                     std::bit_cast<std::array<std::uint64_t, 10>>(numbers(b));
}

TEST(Metric, no_points_are_measured_as_none_and_of_unequal_lists_the_shortest_counts) {
  const ShadowMap map = map_from_above(50);
  const Camera camera = camera_from_above(4.0);
  measure_points(map, camera, {}, {}, {});
  const std::array<glm::dvec3, 3> points{};
  const std::array<glm::dvec3, 2> normals{glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0)};
  std::array<PointAliasing, 4> out;
  measure_points(map, camera, points, normals, out);
  EXPECT_EQ(out[1].status, Status::ok);
  EXPECT_EQ(out[2].status, Status::undetermined);  // as it was made
  measure_perspectives(map, camera, points, out);
  EXPECT_EQ(out[2].status, Status::ok);
  EXPECT_EQ(out[3].status, Status::undetermined);
}

TEST(Metric, many_points_at_once_are_to_the_bit_what_each_is_alone) {
  constexpr std::size_t kPoints = 203;  // some blocks and a rest, of no multiple of any vector
  const Camera perspective = camera_from_above(4.0);
  const Camera parallel =
      orthographic_camera({0, 4, 0}, {0.2, -1, 0}, {0, 0, -1}, 2.0, 1.0, 0.1, 10, 100, 100);
  ShadowMap sun = map_from_above(50), local = local_map(50), hand_made = local_map(50);
  sun.light_world = {0.6, 0.8, 0, 0};  // not that of the matrix
  hand_made.light_world = {0, 1, 0, 0};
  std::vector<glm::dvec3> points, normals;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double t = static_cast<double>(i);
    points.emplace_back(1.2 * std::sin(t), std::cos(3 * t), 1.2 * std::sin(1.7 * t));  // some outside
    normals.push_back(glm::normalize(glm::dvec3(std::sin(2.3 * t), 0.4 + std::cos(t), std::sin(t * t))));
  }
  points[7] = perspective.position;  // no direction to it
  points[8] = {0, 0, 0};             // lit along the view
  normals[9] = {1, 0, 0};
  for (const Camera& camera : {perspective, parallel}) {
    for (const ShadowMap& map : {sun, local, hand_made, map_from_above(50)}) {
      std::vector<PointAliasing> surface(kPoints), plain(kPoints);
      measure_points(map, camera, points, normals, surface);
      measure_perspectives(map, camera, points, plain);
      std::size_t ok = 0;
      for (std::size_t i = 0; i < kPoints; ++i) {
        ok += surface[i].status == Status::ok;
        EXPECT_TRUE(same_bits(surface[i], measure_point(map, camera, points[i], normals[i]))) << i;
        EXPECT_TRUE(same_bits(plain[i], measure_perspective(map, camera, points[i]))) << i;
      }
      EXPECT_GT(ok, 20u);
      EXPECT_LT(ok, kPoints);
    }
  }
}

TEST(Measure, a_plan_without_maps_measures_as_nothing) {
  const AliasingStats stats = measure(ShadowPlan{}, Camera{}, {});
  EXPECT_EQ(stats.samples, 0u);
  EXPECT_EQ(stats.outside, 0u);
  EXPECT_EQ(stats.max, 0.0);
  EXPECT_EQ(stats.storage, 0.0);
}

TEST(Measure, the_maps_of_a_plan_add_up_to_the_whole) {
  const Camera camera = perspective_camera({0, 5, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 200, 640, 480);
  const Box ground{{-100, -1, -200}, {100, 0, 0}};
  const SceneBounds bounds{{&ground, 1}, {&ground, 1}};
  const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.3, -1, 0.2}}, bounds);
  ASSERT_EQ(plan.map_count, 4);
  const MeasureOptions grid{16, 16, 32};
  const AliasingStats all = measure(plan, camera, bounds, grid);
  std::uint64_t samples = 0;
  double largest = 0.0, storage = 0.0;
  for (int i = 0; i < plan.map_count; ++i) {
    const AliasingStats one = measure(plan, camera, bounds, {grid.columns, grid.rows, grid.depths, i});
    samples += one.samples;
    largest = std::max(largest, one.max);
    storage += one.storage;
  }
  EXPECT_GT(samples, 100u);
  EXPECT_EQ(all.samples, samples);
  EXPECT_EQ(all.max, largest);
  EXPECT_CLOSE(all.storage, storage, kRounding);
  EXPECT_LE(all.p50, all.p95);
  EXPECT_LE(all.p95, all.max);
}

}  // namespace
}  // namespace gnomon::test
