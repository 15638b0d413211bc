// Do maps of the logarithmic shape have the even error along the view that it is made for, and do plans fall
// back to linear texels where it is of no use?
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string_view>

#include "gnomon/extend/shape.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/study/bias.hpp"
#include "gnomon/study/log_perspective.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

constexpr double kNear = 1.0, kFar = 100.0, kFov = 1.0471975511965976;
constexpr int kPixels = 512, kSize = 1024;
const Box kEverywhere{{-1e4, -1e4, -1e4}, {1e4, 1e4, 1e4}};
const SceneBounds kBounds{{&kEverywhere, 1}, {&kEverywhere, 1}};

Camera overhead_camera() {
  return perspective_camera({3, 5, 7}, {0, 0, -1}, {0, 1, 0}, kFov, 1.0, kNear, kFar, kPixels, kPixels);
}
PlanOptions one_logarithmic_map() {
  PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = kSize;
  options.filter.texels = 0.0;
  options.split.range = SplitRange::camera;
  options.warp.shape = &shapes::logarithmic;
  options.prune = kPruneNothing;
  return options;
}
ShadowPlan overhead_plan(const PlanOptions& options) {
  return make_plan(overhead_camera(), DirectionalLight{{0, -1, 0}}, kBounds, options);
}
bool omits(const ShadowPlan& plan, OmissionKind kind) {
  for (const Omission& omission : plan.omitted()) {
    if (omission.kind == kind) return true;
  }
  return false;
}
bool ignores_shape(const ShadowPlan& plan) {
  for (const Omission& o : plan.omitted()) {
    if (o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(IgnoredOption::shape))
      return true;
  }
  return false;
}

TEST(LogarithmicMap, overhead_every_depth_has_the_same_error_along_the_view) {
  const ShadowPlan plan = overhead_plan(one_logarithmic_map());
  ASSERT_EQ(plan.map_count, 1);
  ASSERT_EQ(plan.map[0].shape, &shapes::logarithmic);
  EXPECT_EQ(plan.map[0].warp, &warps::psm);
  constexpr double kEven = 1e-9;
  double first = 0.0;
  for (const double depth : {1.0, 1.5, 3.0, 10.0, 40.0, 99.9}) {
    const PointAliasing a = measure_perspective(plan.map[0], overhead_camera(), {3, 5, 7 - depth});
    ASSERT_EQ(a.status, PointAliasing::Status::ok) << depth;
    if (first == 0.0) first = a.m_t;
    EXPECT_CLOSE(a.m_t, first, kEven) << depth;
  }
  // Texels per pixel that make it 1: dz / ds = z ln(far / near), over a pixel's slope.
  const double pixels_per_slope = kPixels / (2.0 * std::tan(0.5 * kFov));
  EXPECT_CLOSE(first, std::log(kFar / kNear) * pixels_per_slope / kSize, 1e-6);
}

TEST(LogarithmicMap, overhead_the_storage_is_the_logarithm_of_the_depth_ratio) {
  for (const double far : {10.0, 100.0, 1000.0}) {
    Camera camera = overhead_camera();
    camera.far_depth = far;
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0, -1, 0}}, kBounds, one_logarithmic_map());
    ASSERT_EQ(plan.map_count, 1);
    const ShadowMap& map = plan.map[0];
    EXPECT_CLOSE(map.storage, std::log(far / kNear), 0.02) << far;
    PlanOptions linear = one_logarithmic_map();
    linear.warp.shape = &shapes::linear;
    linear.warp.warp = &warps::psm;
    const ShadowPlan other = make_plan(camera, DirectionalLight{{0, -1, 0}}, kBounds, linear);
    EXPECT_CLOSE(other.map[0].storage / map.storage, (far / kNear - 1.0) / std::log(far / kNear), 0.02);
  }
}

TEST(LogarithmicMap, its_figures_are_those_of_the_study) {
  const Camera camera =
      perspective_camera({1, 2, 3}, {0.3, -0.2, -1}, {0, 1, 0}, 1.2, 1.5, 0.5, 80, 300, 200);
  for (const glm::dvec3 way : {glm::dvec3(0, -1, 0), glm::dvec3(0.5, -1, 0.3), glm::dvec3(-0.6, -0.5, 0.4)}) {
    const DirectionalLight light{way};
    const ShadowPlan plan = make_plan(camera, light, kBounds, one_logarithmic_map());
    ASSERT_EQ(plan.map_count, 1);
    ASSERT_EQ(plan.map[0].shape, &shapes::logarithmic);
    const AliasingStats drawn = measure(plan, camera, kBounds);
    const AliasingStats study = measure(log_perspective_map(camera, light, kBounds, kSize), camera, kBounds);
    constexpr double kSame = 1e-3;
    EXPECT_CLOSE(drawn.p50, study.p50, kSame);
    EXPECT_CLOSE(drawn.p95, study.p95, kSame);
    EXPECT_CLOSE(drawn.max, study.max, kSame);
    EXPECT_CLOSE(drawn.storage, study.storage, kSame);
  }
}

TEST(LogarithmicMap, a_border_keeps_receivers_off_and_bounds_hold) {
  const Camera camera =
      perspective_camera({0, 4, 0}, {0.1, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.3, 200, 600, 400);
  const std::array<Box, 2> boxes{{{{-60, -0.5, -190}, {60, 0, 5}}, {{-3, 0, -40}, {3, 9, -12}}}};
  for (const double border : {0.0, 3.0, 40.0}) {
    for (const ClipSpace& space : {kOpenGl, kOpenGlZeroToOne, kVulkan}) {
      PlanOptions options = one_logarithmic_map();
      options.cascades = 2;
      options.filter.texels = border;
      options.clip_space = space;
      const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.2, -1, 0.1}}, {boxes, boxes}, options);
      ASSERT_GT(plan.map_count, 0);
      int points = 0;
      const glm::dvec3 forward = glm::normalize(camera.forward);
      const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)),
                       up = glm::cross(right, forward);
      for (double y = camera.bottom; y <= camera.top; y += 0.01) {
        for (double x = camera.left; x <= camera.right; x += 0.1) {
          const glm::dvec3 ray = forward + right * x + up * y;
          const double view_depth = (-0.25 - camera.position.y) / ray.y;
          if (!(view_depth > camera.near_depth && view_depth < camera.far_depth)) continue;
          const glm::dvec3 p = camera.position + ray * view_depth;
          if (std::abs(p.x) > 60.0 || p.z < -190.0) continue;
          const int at = map_serving(plan, p, view_depth);
          if (at < 0) continue;
          const ShadowMap& map = plan.map[static_cast<std::size_t>(at)];
          if (map.shape->affine) continue;
          const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
          const glm::dvec2 texel = map.texels().place(glm::dvec2(clip) / clip.w).texel;
          const PointAliasing a = measure_perspective(map, camera, p);
          if (a.status != PointAliasing::Status::ok) continue;
          ++points;
          for (int axis = 0; axis < 2; ++axis) {
            EXPECT_GE(texel[axis], border - 1e-6);
            EXPECT_LE(texel[axis], kSize - border + 1e-6);
          }
          const glm::dvec2 extent =
              texel_extent_world(map.clip_from_world, map.texels(), plan.light_direction, p);
          EXPECT_LE(extent.x, map.texel_world_max.x * (1 + 1e-9));
          EXPECT_LE(extent.y, map.texel_world_max.y * (1 + 1e-9));
          EXPECT_LE(a.m_max, map.m_max * (1 + 1e-9));
        }
      }
      EXPECT_GT(points, 100) << border;
    }
  }
}

TEST(LogarithmicMap, every_clip_space_has_the_same_texels) {
  const ShadowPlan gl = overhead_plan(one_logarithmic_map());
  PlanOptions options = one_logarithmic_map();
  options.clip_space = kVulkan;
  const ShadowPlan other = overhead_plan(options);
  for (const double depth : {1.5, 10.0, 80.0}) {
    const glm::dvec3 p(3.2, 5, 7 - depth);
    EXPECT_CLOSE(measure_perspective(gl.map[0], overhead_camera(), p).m_max,
                 measure_perspective(other.map[0], overhead_camera(), p).m_max, 1e-9);
  }
}

TEST(LogarithmicMap, plans_fall_back_to_linear_texels_and_say_so) {
  // Light along the view, where there is nothing to undo.
  const ShadowPlan along =
      make_plan(overhead_camera(), DirectionalLight{{0, 0, -1}}, kBounds, one_logarithmic_map());
  ASSERT_EQ(along.map_count, 1);
  EXPECT_EQ(along.map[0].shape, &shapes::linear);
  EXPECT_EQ(along.map[0].kappa, 0.0);
  EXPECT_TRUE(omits(along, OmissionKind::shape_without_gain));
  // An unwarped map.
  PlanOptions none = one_logarithmic_map();
  none.warp.warp = &warps::none;
  EXPECT_EQ(overhead_plan(none).map[0].shape, &shapes::linear);
  // A warp that has evened out both ends already: LiSPSM's error along the view is worse with the logarithm.
  PlanOptions lispsm = one_logarithmic_map();
  lispsm.warp.warp = &warps::lispsm;
  const ShadowPlan both = overhead_plan(lispsm);
  EXPECT_EQ(both.map[0].shape, &shapes::linear);
  EXPECT_TRUE(omits(both, OmissionKind::shape_without_gain));
  for (const Fit fit : {Fit::stable, Fit::rotated, Fit::warped_stable}) {
    PlanOptions options = one_logarithmic_map();
    options.fit = fit;
    const ShadowPlan plan = overhead_plan(options);
    ASSERT_EQ(plan.map_count, 1);
    EXPECT_EQ(plan.map[0].shape, &shapes::linear);
    EXPECT_TRUE(ignores_shape(plan));
  }
  PlanOptions unset = one_logarithmic_map();
  unset.warp.shape = nullptr;
  const ShadowPlan linear = overhead_plan(unset);
  EXPECT_EQ(linear.status, PlanStatus::ok);
  EXPECT_EQ(linear.map[0].shape, &shapes::linear);
}

TEST(LogarithmicMap, parts_of_the_frustum_and_spots_have_it_where_it_gains) {
  const Camera camera =
      perspective_camera({0, 4, 0}, {0.1, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.3, 120, 600, 400);
  const std::array<Box, 2> boxes{{{{-60, -0.5, -190}, {60, 0, 5}}, {{-3, 0, -40}, {3, 9, -12}}}};
  const Light sun = DirectionalLight{{0.2, -1, 0.1}};
  const Light spot = SpotLight{{0, 60, -40}, {0, -1, 0.05}, 1.1, 200.0};
  for (const Light& light : {sun, spot}) {
    PlanOptions options = one_logarithmic_map();
    options.cascades = 4;
    options.filter.texels = 2.0;
    options.split.partition = Partition::frustum_faces;
    const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, options);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    int bent = 0;
    for (const ShadowMap& map : plan.maps()) bent += map.shape->affine ? 0 : 1;
    EXPECT_GT(bent, 0);
    options.warp.shape = &shapes::linear;
    options.warp.warp = &warps::psm;
    const ShadowPlan linear = make_plan(camera, light, {boxes, boxes}, options);
    const AliasingStats with = measure(plan, camera, {boxes, boxes});
    const AliasingStats without = measure(linear, camera, {boxes, boxes});
    EXPECT_EQ(with.outside, 0u);
    EXPECT_LT(with.p95, without.p95);
  }
}

TEST(LogarithmicMap, extreme_views_keep_within_what_single_precision_holds) {
  for (const double near : {1e-4, 1e-2, 0.999e3}) {
    Camera camera = overhead_camera();
    camera.near_depth = near;
    camera.far_depth = 1e3;
    const ShadowPlan plan =
        make_plan(camera, DirectionalLight{{0.1, -1, 0.05}}, kBounds, one_logarithmic_map());
    ASSERT_EQ(plan.map_count, 1) << near;
    const ShadowMap& map = plan.map[0];
    EXPECT_LE(std::abs(map.shape_parameters[0]), kMaxLogGrowth);
    EXPECT_TRUE(std::isfinite(map.m_max) && std::isfinite(map.texel_world_max.y));
    EXPECT_EQ(measure(plan, camera, kBounds).outside, 0u);
  }
}

}  // namespace
}  // namespace gnomon::test
