// Does the camera-relative float matrix keep its texels a thousand kilometres from the origin?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>

#include "gnomon/gnomon.hpp"
#include "gnomon/study/bias.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// The promise of architecture section 3.
constexpr double kTexel = 0.0005;

Case scene_at(const glm::dvec3& origin) {
  Case c;
  c.camera = perspective_camera(origin + glm::dvec3(0, 2, 0), {0.3, -0.1, -1}, {0, 1, 0}, 1.0472, 1.7778, 0.1,
                                200, 1920, 1080);
  c.light = {0.4, -1, 0.3};
  c.receivers = {{origin + glm::dvec3(-200, -1, -250), origin + glm::dvec3(200, 4, 50)}};
  c.casters = {{origin + glm::dvec3(-200, -1, -250), origin + glm::dvec3(200, 30, 50)}};
  return c;
}

/// Largest difference in texels between shading in float relative to the camera and double in the world.
double worst_texel(const Case& c, const ShadowPlan& plan) {
  double worst = 0.0;
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const double depth =
        c.camera.near_depth * std::pow(c.camera.far_depth / c.camera.near_depth, random.unit());
    // What a shader gets: the offset from the eye, already in float.
    const glm::vec3 offset(point_at(c.camera, random.between(-1, 1), random.between(-1, 1), depth) -
                           c.camera.position);
    const ShadowMap* map = map_for(plan, depth);
    if (map == nullptr) continue;
    const glm::vec4 shaded = map->clip_from_camera_relative * glm::vec4(offset, 1.0f);
    const glm::dvec4 exact = map->clip_from_world * glm::dvec4(glm::dvec3(offset) + c.camera.position, 1.0);
    for (int axis = 0; axis < 2; ++axis) {
      const double difference = static_cast<double>(shaded[axis] / shaded.w) - exact[axis] / exact.w;
      worst = std::max(worst, std::abs(difference) * 0.5 * map->width);
    }
  }
  return worst;
}

TEST(Precision, camera_relative_floats_hold_their_texel_from_the_origin_to_ten_thousand_kilometres) {
  for (const double distance : {0.0, 1e6, 1e7}) {
    for (const Fit fit : {Fit::tight, Fit::stable}) {
      Case c = scene_at(glm::dvec3(distance, 0.3 * distance, -0.7 * distance));
      c.options.fit = fit;
      c.options.warp.warp = &warps::none;
      const ShadowPlan plan = c.plan();
      ASSERT_EQ(plan.status, PlanStatus::ok);
      const double worst = worst_texel(c, plan);
      EXPECT_GT(worst, 0.0);
      EXPECT_LT(worst, kTexel) << distance << ' ' << to_string(fit);
    }
  }
}

TEST(Precision, floats_hit_the_map_of_a_receiver_that_is_tiny_for_its_distance) {
  // Without room for their rounding, offsets of 1e4 units land up to a hundred maps beside one of 1e-4 units.
  for (const double size : {1.0, 1e-3, 1e-6, 0.0}) {
    for (const Warp* warp : {&warps::none, &warps::lispsm, &warps::optimal}) {
      Case c = scene_at({});
      c.camera.far_depth = 2e4;
      c.options.cascades = 1;
      c.options.warp.warp = warp;
      const glm::dvec3 centre = point_at(c.camera, 0.1, -0.2, 1e4);
      c.receivers = {{centre - glm::dvec3(size, 0.3 * size, 2.0 * size), centre + glm::dvec3(size)}};
      c.casters = {{centre - glm::dvec3(5.0), centre + glm::dvec3(5.0)}};
      const ShadowPlan plan = c.plan();
      ASSERT_EQ(plan.status, PlanStatus::ok) << size;
      const ShadowMap& map = plan.map[0];
      for (const glm::dvec3& p : {c.receivers[0].min, c.receivers[0].max, centre}) {
        const glm::vec4 clip =
            map.clip_from_camera_relative * glm::vec4(glm::vec3(p - c.camera.position), 1.0f);
        const glm::dvec4 exact = map.clip_from_world * glm::dvec4(p, 1.0);
        for (int axis = 0; axis < 2; ++axis) {
          const double off = static_cast<double>(clip[axis] / clip.w) - exact[axis] / exact.w;
          EXPECT_LT(std::abs(off) * 0.5 * map.width, 2.0) << size << ' ' << warp->name;
        }
      }
    }
  }
}

TEST(Precision, floats_hit_the_map_of_a_spot_that_is_all_but_a_ray) {
  // Without room for their rounding they land hundreds of maps beside it.
  for (const Fit fit : {Fit::tight, Fit::stable}) {
    for (const double outer : {1e-3, 1e-6, 1e-9}) {
      Case c = scene_at({});
      c.options.fit = fit;
      const glm::dvec3 place{5.0, 30.0, -60.0}, aim{0.0, 0.0, -70.0};
      const ShadowPlan plan =
          make_plan(c.camera, SpotLight{place, aim - place, outer, 50.0}, c.bounds(), c.options);
      ASSERT_EQ(plan.status, PlanStatus::ok) << outer;
      const ShadowMap& map = plan.map[0];
      const glm::vec4 clip =
          map.clip_from_camera_relative * glm::vec4(glm::vec3(aim - c.camera.position), 1.0f);
      const glm::dvec4 exact = map.clip_from_world * glm::dvec4(aim, 1.0);
      for (int axis = 0; axis < 2; ++axis) {
        const double off = static_cast<double>(clip[axis] / clip.w) - exact[axis] / exact.w;
        EXPECT_LT(std::abs(off) * 0.5 * map.width, 8.0) << outer << ' ' << to_string(fit);
      }
    }
  }
}

TEST(Precision, an_absolute_float_matrix_would_not_do) {
  // The reason for the second matrix: if this held, it could go.
  const Case c = scene_at({1e6, 3e5, -7e5});
  const ShadowPlan plan = c.plan();
  ASSERT_EQ(plan.status, PlanStatus::ok);
  const ShadowMap& map = plan.map[0];
  const glm::dvec3 p = point_at(c.camera, 0.1, -0.3, 0.5 * (map.depth_begin + map.depth_end));
  const glm::vec4 shaded = glm::mat4(map.clip_from_world) * glm::vec4(glm::vec3(p), 1.0f);
  const glm::dvec4 exact = map.clip_from_world * glm::dvec4(p, 1.0);
  EXPECT_GT(std::abs(static_cast<double>(shaded.x / shaded.w) - exact.x / exact.w) * 0.5 * map.width, 1.0);
}

/// Depth along the light that a point of a triangle seems to have where its corners are transformed in float,
/// less what it has, world units.
double lost_depth(const ShadowMap& map, const glm::dvec3& light, const std::array<glm::dvec3, 3>& corner,
                  const glm::dvec3& weight) {
  const glm::mat4 in_float(map.clip_from_world);
  glm::dvec4 seems(0.0), is(0.0);
  glm::dvec3 point(0.0);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3& p = corner[static_cast<std::size_t>(i)];
    seems += weight[i] * glm::dvec4(in_float * glm::vec4(glm::vec3(p), 1.0f));
    is += weight[i] * (map.clip_from_world * glm::dvec4(p, 1.0));
    point += weight[i] * p;
  }
  return std::abs(seems.z / seems.w - is.z / is.w) /
         std::abs(ndc_depth_per_world_unit(map.clip_from_world, light, point));
}

/// Share of the ground's points in view that lose more depth than the default bias covers, where the ground
/// is squares of this side, two triangles each.
double share_lost(const Case& c, double ground_side, double tile_side) {
  const glm::dvec3 light = glm::normalize(c.light);
  const ShadowPlan plan = c.plan();
  Random random(3);
  int lost = 0, seen = 0;
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec3 ray =
        point_at(c.camera, random.between(-1, 1), random.between(-1, 0), 1.0) - c.camera.position;
    if (!(ray.y < -1e-3)) continue;
    const double depth = -c.camera.position.y / ray.y;
    const glm::dvec3 hit = c.camera.position + ray * depth;
    const int serving = map_serving(plan, hit, depth);
    if (serving < 0 || std::max(std::abs(hit.x), std::abs(hit.z)) > 0.5 * ground_side) continue;
    const ShadowMap& map = plan.maps()[static_cast<std::size_t>(serving)];
    const auto begin = [&](double at) {
      return std::floor((at + 0.5 * ground_side) / tile_side) * tile_side - 0.5 * ground_side;
    };
    const glm::dvec3 low{begin(hit.x), 0.0, begin(hit.z)};
    const double a = (hit.x - low.x) / tile_side, b = (hit.z - low.z) / tile_side;
    const bool first = a + b <= 1.0;
    const std::array<glm::dvec3, 3> corner = {
        low + glm::dvec3(first ? 0.0 : tile_side, 0, first ? 0.0 : tile_side),
        low + glm::dvec3(tile_side, 0, 0), low + glm::dvec3(0, 0, tile_side)};
    const glm::dvec3 weight =
        first ? glm::dvec3(1.0 - a - b, a, b) : glm::dvec3(a + b - 1.0, 1.0 - b, 1.0 - a);
    const glm::dvec2 texel = texel_extent_world(map.clip_from_world, map.texels(), light, hit);
    ++seen;
    lost +=
        lost_depth(map, light, corner, weight) > c.options.bias.constant_texels * std::max(texel.x, texel.y)
            ? 1
            : 0;
  }
  return seen > 0 ? static_cast<double>(lost) / seen : 1.0;
}

// docs/bias.md, "Large triangles".
TEST(Precision, a_ground_in_tiles_keeps_its_depths_under_a_warp_that_none_bounds) {
  constexpr double kSide = 2000.0;
  Case c;
  c.camera = perspective_camera({0, 1.7, 5}, {0.05, -0.08, -1}, {0, 1, 0}, 1.1, 1.5, 0.05, 5000, 1920, 1280);
  c.light = {0.4, -0.7, -0.3};
  c.casters = c.receivers = {{{-1000, -1, -1000}, {1000, 0, 1000}}, {{-4, 0, -40}, {4, 20, -30}}};
  c.options.cascades = 1;
  EXPECT_LT(share_lost(c, kSide, kSide), 0.01) << "searched, and bounded";
  c.options.warp.warp = &warps::psm;
  EXPECT_GT(share_lost(c, kSide, kSide), 0.2);
  EXPECT_LT(share_lost(c, kSide, 100.0), 0.01);
}

TEST(Precision, a_ground_of_a_hundred_kilometres_is_not_lost_in_the_depths_near_the_eye) {
  // Two triangles are the ground. Its corners' w is tens of thousands of times that of what is near in a
  // warped map.
  constexpr double kFar = 5e4;
  const std::array<glm::dvec3, 3> ground = {{{-kFar, 0, -kFar}, {kFar, 0, -kFar}, {-kFar, 0, kFar}}};
  Case c;
  c.light = {-0.5065, -0.6157, -0.6037};
  c.casters = c.receivers = {{{-kFar, 0, -kFar}, {kFar, 0, kFar}}, {{-0.5, 0, -0.5}, {0.5, 1, 0.5}}};
  const glm::dvec3 light = glm::normalize(c.light);
  for (const double far_depth : {1000.0, 3000.0, 1e4, 131072.0}) {
    c.camera =
        perspective_camera({-20, 2, -15}, {0, -0.3, -1}, {0, 1, 0}, 1.0472, 1.7778, 1.0, far_depth, 480, 270);
    for (const Warp* warp : {&warps::optimal, &warps::optimal_thorough}) {
      for (const int cascades : {1, 4}) {
        c.options.warp.warp = warp;
        c.options.cascades = cascades;
        const ShadowPlan plan = c.plan();
        ASSERT_EQ(plan.status, PlanStatus::ok);
        Random random(3);
        for (int i = 0; i < 400; ++i) {
          const glm::dvec3 ray =
              point_at(c.camera, random.between(-1, 1), random.between(-1, 0), 1.0) - c.camera.position;
          if (!(ray.y < -1e-3)) continue;
          const glm::dvec3 hit = c.camera.position - ray * (c.camera.position.y / ray.y);
          const int serving = map_serving(plan, hit, -c.camera.position.y / ray.y);
          const double b = (hit.x + kFar) / (2.0 * kFar), a = (hit.z + kFar) / (2.0 * kFar);
          if (serving < 0 || a + b > 1.0) continue;
          const ShadowMap& map = plan.maps()[static_cast<std::size_t>(serving)];
          const glm::dvec2 texel = texel_extent_world(map.clip_from_world, map.texels(), light, hit);
          EXPECT_LT(lost_depth(map, light, ground, {1.0 - a - b, b, a}), 0.7 * std::max(texel.x, texel.y))
              << far_depth << ' ' << warp->name << ' ' << cascades;
        }
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
