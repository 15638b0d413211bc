// With a pseudo-near depth the map holds everything, and its error counts from that depth on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

constexpr double kNear = 1.0, kFar = 100.0;

/// A square camera at the origin that looks along z, with the sun overhead and receivers everywhere.
struct Scene {
  Camera camera;
  std::vector<Box> boxes{{glm::dvec3(-1e3), glm::dvec3(1e3)}};
  Scene() {
    camera.position = glm::dvec3(0.0);
    camera.forward = {0, 0, 1};
    camera.up = {0, 1, 0};
    camera.near_depth = kNear;
    camera.far_depth = kFar;
    camera.top = camera.right = std::sqrt(1.0 / 3.0);
    camera.bottom = camera.left = -camera.top;
    camera.width = camera.height = 512;
  }
  [[nodiscard]] ShadowMap map(const Warp& warp, double pseudo_near) const {
    PlanOptions o;
    o.cascades = 1;
    o.warp.warp = &warp;
    o.warp.objective = Objective::storage;
    o.split.pseudo_near = pseudo_near;
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0, -1, 0}}, {boxes, boxes}, o);
    EXPECT_EQ(plan.map_count, 1);
    return plan.map[0];
  }
};

/// Storage over the depths from `from` on, of a warp along the view under a sun overhead: the extents of the
/// whole frustum, the errors at `from` and at the far plane.
double storage(double kappa, double from) {
  const auto w = [kappa](double z) { return 1.0 + kappa * (z - kNear); };
  const double width = std::max(kNear / w(kNear), kFar / w(kFar));
  const double across = std::max(w(from) / from, w(kFar) / kFar);
  const double along = std::max(w(from) * w(from) / from, w(kFar) * w(kFar) / kFar);
  return width * across * along * (kFar - kNear) / (1.0 + kappa * (kFar - kNear));
}

double least_storage(double from) {
  double least = storage(0.0, from);
  for (int i = 0; i <= 100000; ++i) least = std::min(least, storage(std::exp(-12.0 + 20.0 * i / 1e5), from));
  return least;
}

TEST(PseudoNear, lispsm_is_within_a_hundredth_of_the_best_strength_for_the_depths_that_count) {
  const Scene scene;
  for (const double from : {2.0, 5.0, 20.0, 50.0}) {
    const ShadowMap map = scene.map(warps::lispsm, from);
    EXPECT_LE(storage(map.kappa, from), 1.01 * least_storage(from)) << "from " << from;
    // What the map reports counts from there on, too.
    EXPECT_LT(map.storage, scene.map(warps::lispsm, 0.0).storage) << "from " << from;
  }
}

/// The worst extents of texels along the map's sides, over the depths from `from` on.
double measured_storage(const Scene& scene, const ShadowMap& map, double from) {
  double s = 0.0, t = 0.0;
  for (int x = -8; x <= 8; ++x) {
    for (int y = -8; y <= 8; ++y) {
      for (int k = 0; k <= 32; ++k) {
        const double z = from * std::pow(kFar / from, k / 32.0) * (1.0 - 1e-9);
        const glm::dvec3 p(z * scene.camera.top * x / 8.01, z * scene.camera.top * y / 8.01, z);
        const glm::dvec3 half = -glm::normalize(glm::normalize(p) + glm::dvec3(0, -1, 0));
        const PointAliasing at = measure_point(map, scene.camera, p, half);
        s = std::max(s, at.m_s);
        t = std::max(t, at.m_t);
      }
    }
  }
  return s * t;
}

TEST(PseudoNear, optimal_is_no_worse_than_lispsm_where_error_counts) {
  const Scene scene;
  for (const double from : {2.0, 5.0, 20.0, 50.0}) {
    const double lispsm = measured_storage(scene, scene.map(warps::lispsm, from), from);
    const double optimal = measured_storage(scene, scene.map(warps::optimal, from), from);
    EXPECT_LE(optimal, 1.01 * lispsm) << "from " << from;
  }
}

TEST(PseudoNear, the_map_still_holds_what_is_nearer) {
  const Scene scene;
  for (const Warp* warp : all_warps()) {
    const ShadowMap map = scene.map(*warp, 20.0);
    for (const double x : {-0.99, 0.99}) {
      for (const double y : {-0.99, 0.99}) {
        const glm::dvec3 p(scene.camera.top * x * kNear, scene.camera.top * y * kNear, kNear * 1.001);
        const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
        EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), clip.w) << warp->name;
      }
    }
  }
}

TEST(PseudoNear, beyond_the_last_depth_it_is_as_if_all_counted_from_one_depth) {
  const Scene scene;
  for (const double from : {kFar, 2.0 * kFar, 1e9}) {
    for (const Warp* warp : all_warps()) {
      const ShadowMap map = scene.map(*warp, from);
      EXPECT_TRUE(std::isfinite(map.kappa) && std::isfinite(map.storage)) << warp->name;
    }
  }
}

}  // namespace
}  // namespace gnomon::test
