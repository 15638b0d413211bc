// Do the warps that work in the viewer's image match the golden numbers: the light in post-perspective
// space, the plane-optimal map, and where the largest error over a frustum lies?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/golden.hpp"
#include "support/near.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// The golden camera: 60 degrees square, depths 1 to 100, at the origin, along -z.
constexpr double kNear = 1.0, kFar = 100.0;
Camera golden_camera() {
  return perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0471975511965976, 1.0, kNear, kFar, 512, 512);
}
glm::dvec4 vec4(const Json& value) {
  return {vec3(value), value.at(3).get<double>()};
}

// Double against double.
constexpr double kDouble = 1e-12;
void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

TEST(PsmLightGolden, the_light_in_post_perspective_space_is_a_point_or_a_direction_behind_the_eye_or_before) {
  const glm::dmat4 clip_from_world = clip_from_view(golden_camera()) * view_from_world(golden_camera());
  for (const Json& row : golden("extra").at("psm_light")) {
    const glm::dvec4 clip = clip_from_world * vec4(row.at("light")), expected = vec4(row.at("clip"));
    const double scale = glm::length(expected);
    expect_near(clip, expected, kDouble * scale);
    EXPECT_NEAR(clip.w, expected.w, kDouble * scale);
    EXPECT_EQ(clip.w < 0.0, row.at("behind_eye").get<bool>());
    if (row.at("kind") == "point") expect_near(glm::dvec3(clip) / clip.w, vec3(row.at("pos")), kDouble);
  }
  // What is infinitely far ahead lies beyond the far plane of ndc.
  const glm::dvec4 ahead = clip_from_world * glm::dvec4(0, 0, -1, 0);
  EXPECT_CLOSE(ahead.z / ahead.w, number(golden("extra").at("psm_infinity_plane_z")), kDouble);
}

/// w of the published map at a point, before scaling: its light looks from `pos` of ndc at the middle of the
/// cube.
double published_w(const glm::dmat4& clip_from_world, const Json& row, const glm::dvec3& point) {
  const glm::dvec4 clip = clip_from_world * glm::dvec4(point, 1.0);
  const glm::dvec3 pos = vec3(row.at("pos"));
  if (row.at("kind") == "directional") return clip.w;
  return clip.w * glm::dot(glm::dvec3(clip) / clip.w - pos, -pos);
}

TEST(PsmLightGolden, the_planned_map_has_the_published_w_and_depths_in_order_also_behind_the_eye) {
  const glm::dmat4 clip_from_world = clip_from_view(golden_camera()) * view_from_world(golden_camera());
  // On one side of the plane where the published w vanishes: no map holds both.
  const Box scene{{-60, -5, -100}, {60, 5, -1}};
  const Box roof{{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}};
  int planned = 0;
  for (const Json& row : golden("extra").at("psm_light")) {
    const glm::dvec4 light = vec4(row.at("light"));
    if (light.w != 0.0) continue;
    PlanOptions options;
    options.cascades = 1;
    options.warp.warp = &warps::psm;
    const ShadowPlan plan =
        make_plan(golden_camera(), DirectionalLight{-glm::dvec3(light)}, {{&roof, 1}, {&scene, 1}}, options);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    const ShadowMap& map = plan.map[0];
    ASSERT_GT(map.kappa, 0.0) << row;
    ++planned;
    // One factor for all points of the view.
    double factor = 0.0;
    for (const glm::dvec3& p : {glm::dvec3(0, 0, -1), {0.3, -0.5, -2}, {-3, 2, -10}, {20, -4, -60}}) {
      const glm::dvec4 here = map.clip_from_world * glm::dvec4(p, 1.0);
      const double ratio = here.w / published_w(clip_from_world, row, p);
      if (factor == 0.0) factor = ratio;
      EXPECT_CLOSE(ratio, factor, 1e-9);
      EXPECT_GT(here.w, 0.0);
      const glm::dvec4 nearer = map.clip_from_world * glm::dvec4(p - plan.light_direction * 0.01, 1.0);
      EXPECT_LT(nearer.z / nearer.w, here.z / here.w);
    }
    EXPECT_GT(factor, 0.0);
  }
  EXPECT_EQ(planned, 3);
}

TEST(PlaneOptimalGolden, sliding_along_the_light_onto_the_plane_leaves_points_of_the_plane_where_they_are) {
  const Json& data = golden("extra").at("plane_optimal");
  const glm::dvec4 light = vec4(data.at("L")), plane = vec4(data.at("plane"));
  const glm::dmat4 slide = glm::dmat4(glm::dot(plane, light)) - glm::outerProduct(light, plane);
  const glm::dmat4 expected = mat4(data.at("A"));
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(slide[k][i], expected[k][i], kDouble * 40.0);
  }
  const glm::dmat4 clip_from_world = clip_from_view(golden_camera()) * view_from_world(golden_camera());
  for (const Json& row : data.at("checks")) {
    const glm::dvec4 p = vec4(row.at("p"));
    const glm::dvec4 slid = clip_from_world * slide * p, seen = clip_from_world * p;
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(slid[i] / slid.w, number(row.at("sm").at(static_cast<std::size_t>(i))), kDouble);
      EXPECT_NEAR(seen[i] / seen.w, number(row.at("cam").at(static_cast<std::size_t>(i))), kDouble);
    }
  }
}

TEST(PlaneOptimalGolden, on_the_golden_plane_the_planned_map_is_the_screen_scaled_and_moved) {
  const Json& data = golden("extra").at("plane_optimal");
  const Box ground{{-40, -2, -60}, {40, -2, -5}}, roof{{-100, -2, -100}, {100, 5, 0}};
  PlanOptions options;
  options.cascades = 1;
  options.warp.warp = &warps::plane_optimal;
  const ShadowPlan plan = make_plan(golden_camera(), DirectionalLight{-glm::dvec3(vec4(data.at("L")))},
                                    {{&roof, 1}, {&ground, 1}}, options);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  ASSERT_GT(plan.map[0].kappa, 0.0);
  std::vector<glm::dvec2> map, screen;
  for (const Json& row : data.at("checks")) {
    const glm::dvec4 clip = plan.map[0].clip_from_world * vec4(row.at("p"));
    map.push_back(glm::dvec2(clip) / clip.w);
    screen.push_back({number(row.at("cam").at(0)), number(row.at("cam").at(1))});
  }
  // A scale and an offset along each axis, from the first two points; the others must follow. The map's x may
  // be the screen's x or y.
  ASSERT_EQ(map.size(), 4u);
  for (int axis = 0; axis < 2; ++axis) {
    const double scale = (map[1][axis] - map[0][axis]) / (screen[1][axis] - screen[0][axis]);
    for (std::size_t i = 2; i < 4; ++i) {
      EXPECT_NEAR(map[i][axis], map[0][axis] + scale * (screen[i][axis] - screen[0][axis]), 1e-9);
    }
  }
}

/// Largest m_s, m_t and m_max over columns x columns rays and `depths` depths of the whole frustum.
std::array<double, 3> worst(const ShadowMap& map, const Camera& camera, int columns, int depths) {
  std::array<double, 3> most{};
  for (int i = 0; i < columns * columns; ++i) {
    for (int k = 0; k < depths; ++k) {
      const double depth = kNear + (kFar - kNear) * k / (depths - 1);
      const auto edge = [&](int at) { return 2.0 * at / (columns - 1) - 1.0; };
      const glm::dvec3 p = point_at(camera, edge(i % columns), edge(i / columns), depth);
      const PointAliasing a = measure_perspective(map, camera, p);
      EXPECT_EQ(a.status, PointAliasing::Status::ok);
      most = {std::max(most[0], a.m_s), std::max(most[1], a.m_t), std::max(most[2], a.m_max)};
    }
  }
  return most;
}

TEST(CornerSufficiencyGolden,
     corners_and_middles_of_both_ends_know_the_worst_error_but_for_the_golden_factor) {
  const Json& golden_ratio = golden("extra").at("corner_vs_dense_ratio");
  const std::array<double, 3> limit = {number(golden_ratio.at("m_s")), number(golden_ratio.at("m_t")),
                                       number(golden_ratio.at("m_max"))};
  // The golden factors are the largest of a sample of cameras; another sample finds a little more.
  constexpr double kAnotherSample = 1.1;
  Random random(20060601);
  std::array<double, 3> largest{};
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 light = random.direction();
    const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, random.between(0.5, 1.6), 1.0,
                                             kNear, kFar, 512, 512);
    const Box all{{-1e4, -1e4, -1e4}, {1e4, 1e4, 1e4}};
    PlanOptions options;
    options.cascades = 1;
    options.warp.warp = &warps::lispsm_closed;
    const ShadowPlan plan = make_plan(camera, DirectionalLight{light}, {{&all, 1}, {&all, 1}}, options);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    const auto few = worst(plan.map[0], camera, 3, 2), dense = worst(plan.map[0], camera, 17, 17);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(dense[k], few[k] * limit[k] * kAnotherSample) << "light " << light.x << ' ' << light.y;
      largest[k] = std::max(largest[k], dense[k] / few[k]);
    }
  }
  // The grid is not exact either: a test that measures the same points twice would find 1.
  EXPECT_GT(largest[0], 1.001);
}

}  // namespace
}  // namespace gnomon::test
