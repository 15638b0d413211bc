// Does a spot under a budget of texels have whichever maps misclassify fewer pixels, one or a cube's faces?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A floor with blocks, seen from above.
struct Hall {
  Camera camera = perspective_camera({0, 3, 12}, {0, -0.25, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 80, 960, 640);
  std::vector<Box> boxes = {{{-40, -1, -40}, {40, 0, 40}}};
  SpotLight spot{{0, 4, 0}, {0, -1, 0}, 60.0 * kDegree, 30.0};
  PlanOptions options;
  std::vector<glm::dvec3> seen;

  Hall() {
    for (int i = 0; i < 16; ++i) {
      const glm::dvec3 at{-12.0 + 8.0 * (i % 4), 0.0, -12.0 + 8.0 * (i / 4)};
      boxes.push_back({at, at + glm::dvec3(0.6, 1.5, 0.6)});
    }
    options.resolution.texel_budget = 1 << 20;
  }
  [[nodiscard]] ShadowPlan plan(PlanHistory* history = nullptr) const {
    const View view{.camera = camera, .points_world = seen};
    return make_plan(view, spot, {boxes, boxes}, options, history);
  }
  /// Points of the floor between two angles from the spot's axis, all around it or in one direction.
  void see_between(double from_degrees, double to_degrees, bool all_around) {
    seen.clear();
    for (int i = 0; i < 96; ++i) {
      const double angle = from_degrees + (to_degrees - from_degrees) * (i % 8 + 0.5) / 8.0;
      const double turn = all_around ? 2.0 * std::numbers::pi * (i / 8) / 12.0 : -0.5 + 0.08 * (i / 8);
      const double radius = spot.position.y * std::tan(angle * kDegree);
      seen.emplace_back(radius * std::sin(turn), 0.0, -radius * std::cos(turn));
    }
  }
};

/// The sum over the points of a texel's extent in any direction, pixels.
double error_at(const ShadowPlan& plan, const Camera& camera, const std::vector<glm::dvec3>& points,
                const SpotLight& spot) {
  const glm::dvec3 direction = glm::normalize(spot.direction);
  double sum = 0.0;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 offset = point - spot.position;
    const double distance = glm::length(offset);
    if (!(distance <= spot.range && glm::dot(offset, direction) >= std::cos(spot.outer_radians) * distance))
      continue;
    const int map = map_serving(plan, point, 0.0);
    if (map < 0) continue;
    const PointAliasing m = measure_perspective(plan.map[static_cast<std::size_t>(map)], camera, point);
    const double both = m.perspective_s * m.perspective_s + m.perspective_t * m.perspective_t;
    if (both < 1e12) sum += std::sqrt(0.5 * both);
  }
  return sum;
}

/// Whether the camera sees the point whatever is rounded: a plan leaves out points beside the view.
bool well_inside(const Camera& camera, const glm::dvec3& point) {
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 offset = point - camera.position;
  const double depth = glm::dot(offset, axes.forward), scale = camera.orthographic ? 1.0 : depth;
  if (!(depth > 1.001 * camera.near_depth && depth < 0.999 * camera.far_depth)) return false;
  const auto inside = [](double at, double low, double high) {
    const double room = 1e-3 * (high - low);
    return at > low + room && at < high - room;
  };
  return inside(glm::dot(offset, axes.right) / scale, camera.left, camera.right) &&
         inside(glm::dot(offset, axes.up) / scale, camera.bottom, camera.top);
}

TEST(SpotMaps, the_view_moves_the_angle_from_which_a_spot_has_faces_either_way) {
  Hall hall;
  // From above, all of the floor in the cone.
  hall.camera = perspective_camera({0, 40, 0}, {0, -1, 0}, {0, 0, -1}, 1.2, 1.5, 0.1, 80, 960, 640);
  // The middle of a cone of 60 degrees lies in one face, and its map wastes texels on the rest.
  hall.see_between(5.0, 40.0, true);
  const ShadowPlan middle = hall.plan();
  hall.see_between(56.0, 60.0, true);
  const ShadowPlan rim = hall.plan();
  EXPECT_NE(middle.map_count > 1, rim.map_count > 1) << middle.map_count << " and " << rim.map_count;
}

TEST(SpotMaps, without_a_budget_or_with_a_history_or_a_stable_grid_the_angle_decides) {
  Hall hall;
  for (const double degrees : {50.0, 60.0, 65.0, 67.0, 75.0}) {
    hall.spot.outer_radians = degrees * kDegree;
    const bool faces = degrees > 66.0;
    for (int towards = 0; towards < 2; ++towards) {
      hall.see_between(towards ? 5.0 : degrees - 5.0, towards ? 20.0 : degrees, true);
      Hall other = hall;
      other.options.resolution.texel_budget = 0;
      EXPECT_EQ(other.plan().map_count > 1, faces) << degrees;
      other = hall;
      PlanHistory history;
      EXPECT_EQ(other.plan(&history).map_count > 1, faces) << degrees;
      other.options.fit = Fit::stable;
      EXPECT_EQ(other.plan().map_count > 1, faces) << degrees;
      other = hall;
      other.options.warp.objective = Objective::storage;
      EXPECT_EQ(other.plan().map_count > 1, faces) << degrees;
    }
  }
}

TEST(SpotMaps, under_a_budget_no_view_is_worse_by_more_than_a_fiftieth_than_by_the_angle) {
  int other = 0, compared = 0;
  double gain = 0.0;
  for_all(400, [&] {
    CaseLimits limits;
    limits.max_depth_ratio = 1e3;
    limits.max_boxes = 12;
    Case c = draw_case(limits);
    PlanOptions options;
    options.resolution.texel_budget = std::int64_t{1} << (17 + pick(6));
    Random random(static_cast<std::uint64_t>(pick(1 << 30)));
    std::vector<glm::dvec3> seen = visible_points(c, random, 10, 12);
    std::erase_if(seen, [&](const glm::dvec3& point) { return !well_inside(c.camera, point); });
    if (seen.size() < 20) return;
    const glm::dvec3 target = seen[static_cast<std::size_t>(random.pick(static_cast<int>(seen.size())))];
    const double distance = glm::length(target - c.camera.position) * random.between(0.05, 0.6);
    const glm::dvec3 towards = random.direction();
    const SpotLight spot{target - towards * distance, towards + random.direction() * random.between(0.0, 0.9),
                         random.between(40.0, 75.0) * kDegree, distance * random.between(1.2, 5.0)};
    const View view{.camera = c.camera, .points_world = seen};
    const ShadowPlan by_view = make_plan(view, spot, c.bounds(), options);
    // With a history the angle decides; the first frame of one has nothing to be steady for.
    PlanHistory history;
    const ShadowPlan by_angle = make_plan(view, spot, c.bounds(), options, &history);
    if (by_view.status != PlanStatus::ok || by_angle.status != PlanStatus::ok) return;
    const double error = error_at(by_view, c.camera, seen, spot);
    const double angle_error = error_at(by_angle, c.camera, seen, spot);
    if (!(error > 0.0 && angle_error > 0.0)) return;
    ++compared;
    if (getenv("DBG") && error > 1.02 * angle_error) {
      fprintf(stderr, "%g %g ortho %d seen %zu filter %g world %g\n", error, angle_error,
              c.camera.orthographic, seen.size(), options.filter.texels, options.filter.world);
      for (auto& p : {by_view, by_angle})
        for (auto& m : p.maps())
          fprintf(stderr, "  map %d %dx%d warp %s near %g far %g\n", m.cascade, m.width, m.height,
                  m.warp->name.data(), m.depth_begin, m.depth_end);
    }
    require(error <= 1.02 * angle_error, "half angle", spot.outer_radians / kDegree, "maps",
            by_view.map_count, by_angle.map_count, "errors", error, angle_error);
    if (error < 0.999 * angle_error) {
      ++other;
      gain += error / angle_error;
    }
  });
  EXPECT_GT(compared, 150);
  EXPECT_GT(other, compared / 20);
  EXPECT_LT(gain, 0.95 * other);
}

}  // namespace
}  // namespace gnomon::test
