// Is a plan's `optimal` as good as every other registered warp, by the error that is measured of the maps?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/gnomon.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kPi = std::numbers::pi;

struct Scene {
  Camera camera;
  DirectionalLight sun;
  std::vector<Box> boxes;
};

/// A camera over a box that holds all that it sees, a slab of ground, or boxes round it.
Scene scene_of(std::uint64_t seed) {
  Random random(seed);
  const glm::dvec3 eye{random.between(-20, 20), random.between(0.3, 30), random.between(-20, 20)};
  const double yaw = random.between(0, 2 * kPi), pitch = random.between(-0.9, 0.5);
  const double near_depth = std::pow(10.0, random.between(-2, 0.3)),
               far_depth = near_depth * std::pow(10.0, random.between(1.5, 4));
  const double height = random.between(0.05, 1.5), way = random.between(0, 2 * kPi);
  Scene scene;
  scene.camera = perspective_camera(
      eye, {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)}, {0, 1, 0},
      random.between(30, 100) * kPi / 180, random.between(0.6, 2.2), near_depth, far_depth, 960, 540);
  scene.sun = {{-std::cos(height) * std::sin(way), -std::sin(height), -std::cos(height) * std::cos(way)}};
  const int kind = static_cast<int>(seed % 3);
  if (kind == 0) scene.boxes = {{glm::dvec3(-3000), glm::dvec3(3000)}};
  if (kind == 1) scene.boxes = {{{-3000, -1, -3000}, {3000, 0, 3000}}};
  for (int count = kind == 2 ? 1 + random.pick(60) : 0; count > 0; --count) {
    const double reach = far_depth * std::pow(10.0, random.between(-2.5, -0.2)),
                 half = far_depth * std::pow(10.0, random.between(-3, -0.7));
    const glm::dvec3 middle =
        eye + reach * glm::dvec3(random.between(-1, 1), random.between(-0.3, 0.3), random.between(-1, 1));
    const glm::dvec3 size =
        half * glm::dvec3(random.between(0.2, 1), random.between(0.2, 1), random.between(0.2, 1));
    scene.boxes.push_back({middle - size, middle + size});
  }
  return scene;
}

/// The corners of each receiver's part in view, and what measure() counts: its grid alone misses the nearest
/// corner of a slab by up to a step of its depths.
struct Measured {
  double storage = 0.0, max = 0.0, p95 = 0.0;
  std::uint64_t samples = 0;
  [[nodiscard]] double by(Objective objective) const {
    return objective == Objective::storage ? storage : objective == Objective::max ? max : p95;
  }
};

Measured measured(const ShadowPlan& plan, const Scene& scene) {
  const Camera& camera = scene.camera;
  const SceneBounds bounds{scene.boxes, scene.boxes};
  const AliasingStats grid = measure(plan, camera, bounds);
  Measured result{grid.storage, grid.max, grid.p95, grid.samples};
  const ShadowMap& map = plan.map[0];
  double s = 0.0, t = 0.0;
  for (const Box& box : scene.boxes) {
    Polytope part = frustum_slice(camera, camera_axes(camera), camera.near_depth, camera.far_depth);
    clip(part, Box{box.min - camera.position, box.max - camera.position});
    for (const Polytope::Vertex& v : part.vertices()) {
      const PointAliasing at = measure_perspective(map, camera, v.position + camera.position);
      if (at.status != PointAliasing::Status::ok) continue;
      s = std::max(s, at.perspective_s);
      t = std::max(t, at.perspective_t);
      result.max = std::max(result.max, at.perspective_max);
    }
  }
  result.storage = std::max(result.storage, s * t * map.width * map.height / (camera.width * camera.height));
  return result;
}

/// What the ratios of `optimal` to the best other warp came to.
struct Ratios {
  int all = 0, over = 0;
  double worst = 0.0;
  void add(double ratio) {
    constexpr double kOver = 1.02;
    ++all;
    over += ratio > kOver ? 1 : 0;
    worst = std::max(worst, ratio);
  }
};

/// Under one map of the scene; 0 where too few points are seen for a percentile.
double ratio_to_best_other(const Scene& scene, Objective objective) {
  constexpr std::uint64_t kFewest = 1000;
  PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = 1024;
  options.warp.objective = objective;
  double optimal = 0.0, best_other = std::numeric_limits<double>::infinity();
  for (const Warp* warp : all_warps()) {
    if (warp == &warps::optimal_thorough) continue;
    options.warp.warp = warp;
    const ShadowPlan plan = make_plan(scene.camera, scene.sun, {scene.boxes, scene.boxes}, options);
    if (plan.status != PlanStatus::ok) return 0.0;
    const Measured found = measured(plan, scene);
    if (found.samples < kFewest) return 0.0;
    if (warp == &warps::optimal) {
      optimal = found.by(objective);
    } else {
      best_other = std::min(best_other, found.by(objective));
    }
  }
  return optimal / best_other;
}

TEST(MeasuredWarpLaw, optimal_is_as_good_as_every_other_registered_warp_where_it_is_measured) {
  const int seeds = 320 / draws_divisor();
  constexpr double kWorst = 1.15;
  constexpr const char* kKinds[] = {"box", "slab", "boxes"};
  for (const Objective objective : {Objective::storage, Objective::max, Objective::p95}) {
    Ratios ratios[3];
    for (int seed = 1; seed <= seeds; ++seed) {
      const Scene scene = scene_of(static_cast<std::uint64_t>(seed));
      if (const double ratio = ratio_to_best_other(scene, objective); ratio > 0.0)
        ratios[seed % 3].add(ratio);
    }
    for (int kind = 0; kind < 3; ++kind) {
      const Ratios& r = ratios[kind];
      EXPECT_GT(r.all, of_all_draws(30)) << kKinds[kind];
      EXPECT_LE(r.over, 1 + r.all / 30) << kKinds[kind];
      EXPECT_LE(r.worst, kWorst) << kKinds[kind];
      std::printf("%s, %s: %d of %d over 2 %%, worst %.3f\n", std::string(to_string(objective)).c_str(),
                  kKinds[kind], r.over, r.all, r.worst);
    }
  }
}

}  // namespace
}  // namespace gnomon::test
