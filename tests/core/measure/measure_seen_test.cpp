// Is the error at points that are seen the metric's own at each of them?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "gnomon/measure.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// A street of 200 units seen from its end.
struct Street {
  Camera camera = perspective_camera({0, 5, 0}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 250, 960, 640);
  std::vector<Box> boxes = {{{-20, -1, -200}, {20, 30, -1}}};
  std::vector<glm::dvec3> points;

  Street() {
    for (int i = 0; i < 500; ++i) points.push_back({-4.0 + i % 9, 0.0, -8.0 - 0.38 * i});
  }
  [[nodiscard]] ShadowPlan plan(int cascades) const {
    PlanOptions options;
    options.cascades = cascades;
    return make_plan(camera, DirectionalLight{{0.3, -1, 0.2}}, {boxes, boxes}, options);
  }
};

TEST(MeasureSeen, is_the_perspective_error_at_each_point_in_the_map_that_serves_it) {
  const Street street;
  for (const int cascades : {1, 4}) {
    const ShadowPlan plan = street.plan(cascades);
    ASSERT_EQ(plan.map_count, cascades);
    std::vector<double> m;
    std::vector<PointAliasing> worst(static_cast<std::size_t>(cascades));  // sides over each map's points
    const CameraAxes axes = camera_axes(street.camera);
    for (const glm::dvec3& point : street.points) {
      const int map = map_serving(plan, point, glm::dot(point - street.camera.position, axes.forward));
      ASSERT_GE(map, 0);
      const auto index = static_cast<std::size_t>(map);
      const PointAliasing one = measure_perspective(plan.map[index], street.camera, point);
      m.push_back(one.m_max);
      worst[index].m_s = std::max(worst[index].m_s, one.m_s);
      worst[index].m_t = std::max(worst[index].m_t, one.m_t);
    }
    double storage = 0.0;  // texels over pixels that an error of 1 takes, all maps together
    for (std::size_t i = 0; i < worst.size(); ++i)
      storage += worst[i].m_s * worst[i].m_t * plan.map[i].width * plan.map[i].height;
    storage /= static_cast<double>(street.camera.width) * street.camera.height;
    std::sort(m.begin(), m.end());
    double sum = 0.0;
    for (const double one : m) sum += one;
    const AliasingStats stats = measure(plan, {.camera = street.camera, .points_world = street.points}, {});
    EXPECT_EQ(stats.samples, street.points.size());
    EXPECT_EQ(stats.outside, 0u);
    EXPECT_NEAR(stats.mean, sum / static_cast<double>(m.size()), 1e-12 * stats.mean);
    EXPECT_NEAR(stats.p95, m[475], 0.01 * stats.p95);
    EXPECT_EQ(stats.max, m.back());
    EXPECT_NEAR(stats.storage, storage, 1e-12 * storage);
  }
}

TEST(MeasureSeen, points_that_no_map_serves_are_counted_apart) {
  Street street;
  street.points = {{0, 0, -20}, {0, 0, 30}, {0, 0, -5000}};
  const AliasingStats stats =
      measure(street.plan(2), {.camera = street.camera, .points_world = street.points}, {});
  EXPECT_EQ(stats.samples, 1u);
  EXPECT_EQ(stats.outside, 2u);
}

TEST(MeasureSeen, no_points_and_no_maps_give_zeros) {
  Street street;
  EXPECT_EQ(measure(ShadowPlan{}, {.camera = street.camera, .points_world = street.points}, {}).samples, 0u);
  const AliasingStats stats = measure(street.plan(1), {.camera = street.camera, .points_world = {}}, {});
  EXPECT_EQ(stats.samples, 0u);
  EXPECT_EQ(stats.mean, 0.0);
}

TEST(Measure, the_mean_lies_between_the_ends_and_is_that_of_the_points) {
  int checked = 0;
  for_all(200, [&] {
    const Case c = draw_case();
    const ShadowPlan plan = make_plan(c.camera, DirectionalLight{c.light}, c.bounds(), c.options);
    const AliasingStats stats = measure(plan, c.camera, c.bounds(), {4, 4, 8});
    if (stats.samples == 0 || !std::isfinite(stats.max)) return;
    ++checked;
    require(stats.mean > 0.0 && stats.mean <= stats.max * (1.0 + 1e-12), "mean", stats.mean, "max",
            stats.max);
    // Half of the points lie at or above the median.
    require(stats.mean >= 0.49 * stats.p50, "mean", stats.mean, "median", stats.p50);
  });
  EXPECT_GT(checked, 50);
}

}  // namespace
}  // namespace gnomon::test
