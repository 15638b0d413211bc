// Where a plane parts the receivers: are both maps as dense there, and together better than two cascades?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

/// A camera that looks along z over receivers everywhere, under a sun at some height.
struct Scene {
  Camera camera;
  std::vector<Box> boxes{{glm::dvec3(-1e4, -20, -1e4), glm::dvec3(1e4, 5, 1e4)}};
  DirectionalLight sun;
  PlanOptions options;
  Scene(double height_degrees, double far_depth, const Warp& warp) {
    constexpr double kDegree = 3.141592653589793 / 180.0;
    camera.position = glm::dvec3(0.0);
    camera.forward = {0, 0, 1};
    camera.up = {0, 1, 0};
    camera.near_depth = 1.0;
    camera.far_depth = far_depth;
    camera.top = camera.right = 0.5;
    camera.bottom = camera.left = -0.5;
    camera.width = camera.height = 512;
    sun.direction = {0.3, -std::sin(height_degrees * kDegree), std::cos(height_degrees * kDegree)};
    options.warp.warp = &warp;
    options.warp.objective = Objective::storage;
    options.split.partition = Partition::separating_plane;
  }
  [[nodiscard]] ShadowPlan plan() const { return make_plan(camera, sun, {boxes, boxes}, options); }
};

/// Texels per area across the light at a point, by differences.
double density(const ShadowMap& map, const glm::dvec3& light, const glm::dvec3& p) {
  const glm::dvec3 x = glm::normalize(glm::cross(light, glm::dvec3(0.3, 0.2, 0.9))), y = glm::cross(light, x);
  const auto texel = [&](const glm::dvec3& q) {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(q, 1.0);
    return glm::dvec2(clip.x * map.width, clip.y * map.height) * (0.5 / clip.w);
  };
  const double step = 1e-4 * glm::length(p);
  const glm::dvec2 a = texel(p + x * step) - texel(p - x * step),
                   b = texel(p + y * step) - texel(p - y * step);
  return std::abs(a.x * b.y - a.y * b.x) / (4.0 * step * step);
}

/// Where rays along the rim of the image meet the plane that parts the maps.
std::vector<glm::dvec3> points_on_plane(const Scene& scene, const ShadowMap& map) {
  const glm::dvec4 plane = map.select_planes[0];
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 64; ++i) {
    const double x = -0.5 + (i % 8) / 7.0, y = -0.5 + (i / 8) / 7.0;
    const glm::dvec3 ray(x, y, 1.0);
    const double t = -plane.w / glm::dot(glm::dvec3(plane), ray);
    const glm::dvec3 p = ray * t;
    if (t > 1.0 && t < scene.camera.far_depth && p.y > -20.0 && p.y < 5.0) points.push_back(p);
  }
  return points;
}

TEST(SeparatingPlane, both_maps_are_as_dense_at_the_plane) {
  int parted = 0;
  double worst = 0.0;
  for (const Warp* warp : {&warps::lispsm, &warps::lispsm_closed, &warps::tsm}) {
    for (const Objective objective : {Objective::storage, Objective::max, Objective::p95}) {
      for (const double height : {30.0, 45.0, 60.0, 75.0, 90.0}) {
        for (const double far_depth : {20.0, 100.0, 1000.0}) {
          Scene scene(height, far_depth, *warp);
          scene.options.warp.objective = objective;
          const ShadowPlan plan = scene.plan();
          if (plan.selection == MapSelection::view_depth) continue;
          ASSERT_EQ(plan.map_count, 2);
          // A side that takes no warp has no density to fit.
          if (plan.map[0].kappa == 0.0) continue;
          const glm::dvec3 light = glm::normalize(scene.sun.direction);
          const auto points = points_on_plane(scene, plan.map[0]);
          if (points.empty()) continue;
          ++parted;
          for (const glm::dvec3& p : points) {
            const double ratio = density(plan.map[0], light, p) / density(plan.map[1], light, p);
            worst = std::max(worst, std::max(ratio, 1.0 / ratio));
          }
        }
      }
    }
  }
  EXPECT_GE(parted, 3);
  EXPECT_LE(worst, 1.05);
}

TEST(SeparatingPlane, what_is_parted_is_no_worse_than_two_cascades) {
  int parted = 0, cascades = 0;
  for (const Warp* warp : {&warps::lispsm, &warps::optimal, &warps::tsm}) {
    for (const double height : {40.0, 60.0, 90.0}) {
      Scene scene(height, 300.0, *warp);
      const ShadowPlan by_plane = scene.plan();
      (by_plane.selection != MapSelection::view_depth ? parted : cascades) += 1;
      scene.options.split.partition = Partition::view_depth;
      scene.options.cascades = 2;
      const double parts = measure(by_plane, scene.camera, {scene.boxes, scene.boxes}).storage;
      const double slices = measure(scene.plan(), scene.camera, {scene.boxes, scene.boxes}).storage;
      // Plans judge at the bodies' corners, and the error is measured at others.
      EXPECT_LE(parts, 1.15 * slices) << warp->name << " " << height;
    }
  }
  EXPECT_GT(parted + cascades, 8);
}

TEST(Parts, planes_between_the_faces_of_the_frustum_are_parallel_to_the_light) {
  int planes = 0;
  for (const double height : {15.0, 35.0, 60.0, 80.0}) {
    Scene scene(height, 100.0, warps::none);
    scene.camera.left = -0.8;
    scene.camera.top = 0.3;
    scene.options.split.partition = Partition::frustum_faces;
    const ShadowPlan plan = scene.plan();
    const glm::dvec3 light = glm::normalize(scene.sun.direction);
    for (const ShadowMap& map : plan.maps()) {
      for (int i = 0; i < map.select_plane_count; ++i, ++planes)
        EXPECT_NEAR(glm::dot(glm::dvec3(map.select_planes[static_cast<std::size_t>(i)]), light), 0.0, 1e-12);
    }
  }
  EXPECT_GT(planes, 8);
}

}  // namespace
}  // namespace gnomon::test
