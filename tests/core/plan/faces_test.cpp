// Are the faces of the camera's frustum divided along the view as requested, and does that save texels?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

constexpr glm::dvec3 kDown{0, -1, 0}, kAhead{0, 0, 1}, kSlanting{0.3, -0.8, 0.5},
    kTowardsViewer{0.1, -0.4, -0.9};

/// A camera that looks along z, all of its view full of receivers.
struct Scene {
  Camera camera = perspective_camera({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1.0, 1.5, 1.0, 1000.0, 1200, 800);
  DirectionalLight sun;
  std::vector<Box> boxes{{glm::dvec3(-2000.0), glm::dvec3(2000.0)}};
  PlanOptions options;
  Scene(const glm::dvec3& light, int slices, const Warp& warp = warps::none) : sun{light} {
    options.split.partition = Partition::frustum_faces;
    options.split.face_slices = slices;
    options.warp.warp = &warp;
    options.warp.objective = Objective::storage;
    options.filter.texels = 0.0;
  }
  [[nodiscard]] ShadowPlan plan() const { return make_plan(camera, sun, {boxes, boxes}, options); }
  [[nodiscard]] double storage(const ShadowPlan& plan) const {
    return measure(plan, camera, {boxes, boxes}, {20, 20, 200}).storage;
  }
};

const Omission* omission_of(const ShadowPlan& plan, OmissionKind kind) {
  const auto list = plan.omitted();
  const auto at =
      std::find_if(list.begin(), list.end(), [kind](const Omission& o) { return o.kind == kind; });
  return at == list.end() ? nullptr : &*at;
}

/// How far inside of a map's planes the point lies, at least.
double inside(const ShadowMap& map, const glm::dvec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < map.select_plane_count; ++i) {
    const glm::dvec4& plane = map.select_planes[static_cast<std::size_t>(i)];
    least = std::min(least, glm::dot(glm::dvec3(plane), point) + plane.w);
  }
  return least;
}

TEST(FaceSlices, under_an_overhead_light_are_logarithmic_cascades) {
  for (const Warp* warp : {&warps::none, &warps::psm}) {
    for (int slices = 2; slices <= kMaxMaps; ++slices) {
      const Scene scene(kDown, slices, *warp);
      Scene cascades = scene;
      cascades.options.split.partition = Partition::view_depth;
      cascades.options.split.scheme = SplitScheme::logarithmic;
      cascades.options.cascades = slices;
      const ShadowPlan plan = scene.plan(), along_view = cascades.plan();
      ASSERT_EQ(plan.map_count, slices);
      EXPECT_NEAR(scene.storage(plan) / scene.storage(along_view), 1.0, 0.01) << warp->name << " " << slices;
      for (int i = 0; i < slices; ++i) {
        const auto at = static_cast<std::size_t>(i);
        EXPECT_EQ(plan.map[at].cascade, i);
        EXPECT_NEAR(plan.map[at].depth_end / along_view.map[at].depth_end, 1.0, 1e-9);
      }
    }
  }
}

TEST(FaceSlices, are_divided_by_the_scheme) {
  Scene scene(kDown, 4);
  scene.options.split.scheme = SplitScheme::uniform;
  ShadowPlan plan = scene.plan();
  ASSERT_EQ(plan.map_count, 4);
  EXPECT_NEAR(plan.map[0].depth_end, 1.0 + 999.0 / 4.0, 1e-6);
  scene.options.split.scheme = SplitScheme::given;
  scene.options.split.given = {5.0, 20.0, 100.0};
  plan = scene.plan();
  ASSERT_EQ(plan.map_count, 4);
  EXPECT_NEAR(plan.map[0].depth_end, 5.0, 1e-6);
  EXPECT_NEAR(plan.map[1].depth_end, 20.0, 1e-6);
  EXPECT_NEAR(plan.map[2].depth_end, 100.0, 1e-6);
}

TEST(FaceSlices, need_fewer_texels_the_more_there_are) {
  for (const glm::dvec3& light : {kDown, kAhead, kSlanting, kTowardsViewer}) {
    for (const Warp* warp : {&warps::none, &warps::optimal}) {
      double before = std::numeric_limits<double>::infinity();
      int maps = 0;
      for (int slices = 1; slices <= kMaxMaps; ++slices) {
        const Scene scene(light, slices, *warp);
        const ShadowPlan plan = scene.plan();
        ASSERT_GE(plan.map_count, maps);
        const double now = scene.storage(plan);
        // As many maps: one face may have taken another's slice.
        EXPECT_LE(now, before * (plan.map_count > maps ? 0.99 : 1.001))
            << warp->name << " " << slices << " slices, light " << light.x << " " << light.y << " "
            << light.z;
        before = now;
        maps = plan.map_count;
      }
    }
  }
}

TEST(FaceSlices, share_the_maps_of_a_plan_and_report_what_is_missing) {
  // Behind the viewer: four side faces and the near one.
  const ShadowPlan one = Scene(kAhead, 1, warps::optimal).plan(),
                   many = Scene(kAhead, 4, warps::optimal).plan();
  ASSERT_EQ(one.map_count, 5);
  EXPECT_EQ(one.map[4].cascade, 4);
  EXPECT_EQ(omission_of(one, OmissionKind::faces_less_divided), nullptr);
  ASSERT_EQ(many.map_count, kMaxMaps);
  for (int i = 0; i < many.map_count; ++i) EXPECT_EQ(many.map[static_cast<std::size_t>(i)].cascade, i);
  const Omission* const missing = omission_of(many, OmissionKind::faces_less_divided);
  ASSERT_NE(missing, nullptr);
  // Three maps are left for four faces.
  EXPECT_EQ(missing->a, 1.0);
  EXPECT_EQ(missing->b, 4.0);
  // One face, as many maps as slices: nothing is missing.
  EXPECT_EQ(omission_of(Scene(kDown, kMaxMaps).plan(), OmissionKind::faces_less_divided), nullptr);
}

TEST(FaceSlices, hold_each_point_once_and_show_it) {
  int points = 0;
  for (const glm::dvec3& light : {kDown, kAhead, kSlanting, kTowardsViewer}) {
    for (const int slices : {2, 3, kMaxMaps}) {
      const Scene scene(light, slices);
      const ShadowPlan plan = scene.plan();
      ASSERT_GT(plan.map_count, 1);
      for (const ShadowMap& map : plan.maps()) {
        EXPECT_LE(map.select_plane_count, kMaxSelectPlanes);
        for (int i = 0; i < map.select_plane_count; ++i) {
          const glm::dvec3 normal(map.select_planes[static_cast<std::size_t>(i)]);
          EXPECT_NEAR(glm::dot(normal, glm::normalize(light)), 0.0, 1e-12);
        }
      }
      for (int i = 0; i < 12 * 12 * 24; ++i) {
        const double depth = std::exp((i / 144 + 0.5) / 24.0 * std::log(1000.0));
        const double x = (i % 12 + 0.53) / 12.0, y = (i / 12 % 12 + 0.47) / 12.0;
        const glm::dvec3 p =
            depth * glm::dvec3(scene.camera.left + x * (scene.camera.right - scene.camera.left),
                               scene.camera.bottom + y * (scene.camera.top - scene.camera.bottom), 1.0);
        int held = 0, by = -1;
        bool near_border = false;
        for (int k = 0; k < plan.map_count; ++k) {
          const double depth_inside = inside(plan.map[static_cast<std::size_t>(k)], p);
          near_border = near_border || std::abs(depth_inside) < 1e-9 * depth;
          if (depth_inside > 0.0) {
            ++held;
            by = k;
          }
        }
        if (near_border) continue;
        ++points;
        ASSERT_EQ(held, 1) << "slices " << slices << " at " << p.x << " " << p.y << " " << p.z;
        ASSERT_EQ(map_serving(plan, p, depth), by);
      }
    }
  }
  EXPECT_GT(points, 30000);
}

TEST(FaceSlices, take_a_warp_and_a_shape_each) {
  Scene scene(kSlanting, 2, warps::psm);
  scene.options.warp.shape = &shapes::logarithmic;
  const ShadowPlan bent = scene.plan();
  scene.options.warp.shape = &shapes::linear;
  const ShadowPlan straight = scene.plan();
  int logarithmic = 0;
  for (const ShadowMap& map : bent.maps()) logarithmic += map.shape == &shapes::logarithmic ? 1 : 0;
  EXPECT_GT(logarithmic, 1);
  EXPECT_LT(scene.storage(bent), scene.storage(straight));
}

TEST(FaceSlices, leave_faces_whole_where_dividing_gains_nothing) {
  Scene scene(kDown, 4);
  scene.camera.orthographic = true;
  const ShadowPlan even = scene.plan();
  EXPECT_EQ(even.map_count, 1);
  EXPECT_NE(omission_of(even, OmissionKind::partition_without_gain), nullptr);
  // Receivers at one depth.
  Scene wall(kAhead, 4);
  wall.boxes = {{{-1, -1, 50}, {1, 1, 50}}};
  EXPECT_EQ(wall.plan().map_count, 1);
}

TEST(FaceSlices, are_refused_outside_their_range) {
  for (const int slices : {-1, 0, kMaxMaps + 1}) {
    const ShadowPlan plan = Scene(kDown, slices).plan();
    EXPECT_EQ(plan.status, PlanStatus::invalid_input);
    EXPECT_EQ(plan.invalid_field, "options.split.face_slices");
  }
}

}  // namespace
}  // namespace gnomon::test
