// How far from their true place are shadow edges under a sun that is held, and how many pages does that save?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iostream>
#include <limits>
#include <utility>
#include <vector>

#include "gnomon/pages.hpp"

namespace gnomon::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
// A quarter of a degree in a minute of 60 Hz.
constexpr double kTurnPerFrame = 0.25 / 3600.0 * kPi / 180.0;

glm::dvec3 sun_after(double frames) {
  const double angle = 0.4 + kTurnPerFrame * frames;
  return {std::sin(angle), -std::cos(angle), 0.2};
}

/// A camera above level ground, with casters up to 20 units high.
struct Ground {
  Camera camera =
      perspective_camera({0, 5, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 16.0 / 9.0, 0.5, 200, 1920, 1080);
  glm::dmat4 clip_from_world = clip_from_view(camera) * view_from_world(camera);
  Box casters{{-60, 0, -160}, {60, 20, 0}};
  std::vector<glm::dvec3> points, normals;

  Ground() {
    for (int x = -8; x <= 8; ++x)
      for (int z = 8; z < 150; z += 2) points.push_back({0.06 * x * z, 0.0, -1.0 * z});
    normals.assign(points.size(), {0, 1, 0});
  }
  [[nodiscard]] HeldSun hold(const glm::dvec3& held, const glm::dvec3& sun, double most = 0.25) const {
    return hold_sun({.camera = camera, .points_world = points, .normals_world = normals}, held, sun, casters,
                    most);
  }
  [[nodiscard]] glm::dvec2 pixel(const glm::dvec3& p) const {
    const glm::dvec4 at = clip_from_world * glm::dvec4(p, 1.0);
    return {at.x / at.w * 960.0, at.y / at.w * 540.0};
  }
};

glm::dvec3 on_ground(const glm::dvec3& caster, const glm::dvec3& sun) {
  return caster - sun * (caster.y / sun.y);
}

TEST(HoldSun, edges_of_every_caster_stay_within_the_bound_and_the_farthest_reach_it) {
  const Ground ground;
  for (const double bound : {0.1, 0.25, 1.0}) {
    glm::dvec3 held = sun_after(0);
    double worst = 0.0;
    for (int frame = 1; frame < 2000; ++frame) {
      const glm::dvec3 sun = sun_after(frame);
      held = ground.hold(held, sun, bound).direction;
      for (const glm::dvec3& point : ground.points) {
        const glm::dvec2 place = ground.pixel(point);
        for (const double height : {2.0, 19.9}) {
          const glm::dvec3 caster = point - held * (height / -held.y);
          if (std::abs(caster.x) > 60.0 || caster.z < -160.0 || caster.z > 0.0) continue;
          worst = std::max(worst, glm::distance(place, ground.pixel(on_ground(caster, sun))));
        }
      }
    }
    EXPECT_LE(worst, bound);
    EXPECT_GT(worst, 0.8 * bound) << "turns before it must";
  }
}

TEST(HoldSun, a_held_direction_has_its_bits_and_reports_its_error) {
  const Ground ground;
  const glm::dvec3 held = sun_after(0), near = sun_after(1), far = sun_after(100000);
  const HeldSun kept = ground.hold(held, near);
  EXPECT_EQ(kept.direction, held);
  EXPECT_GT(kept.error_pixels, 0.0);
  EXPECT_LE(kept.error_pixels, 0.25);
  EXPECT_EQ(kept.turned_pixels, 0.0);
  const HeldSun turned = ground.hold(held, far);
  EXPECT_EQ(turned.direction, far);
  EXPECT_GT(turned.turned_pixels, 0.25);
}

TEST(HoldSun, what_has_no_bound_is_not_held) {
  const Ground ground;
  const glm::dvec3 held = sun_after(0), sun = sun_after(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ground.hold(held, sun, 0.0).direction, sun);
  EXPECT_EQ(ground.hold(held, sun, nan).direction, sun);
  EXPECT_EQ(ground.hold(glm::dvec3(0.0), sun).direction, sun);
  EXPECT_EQ(ground.hold({nan, -1, 0}, sun).direction, sun);
  EXPECT_EQ(hold_sun(ground.camera, held, sun, ground.casters).direction, sun);
  EXPECT_EQ(
      hold_sun({.camera = ground.camera, .points_world = ground.points}, held, -held, ground.casters, 1e9)
          .direction,
      -held);
  Box unbounded = ground.casters;
  unbounded.max.y = nan;
  EXPECT_EQ(
      hold_sun({.camera = ground.camera, .points_world = ground.points, .normals_world = ground.normals},
               held, sun, unbounded)
          .direction,
      sun);
  const std::vector<glm::dvec3> broken = {{nan, 0, -10}};
  EXPECT_EQ(hold_sun({.camera = ground.camera, .points_world = broken}, held, sun, ground.casters).direction,
            sun);
}

TEST(HoldSun, surfaces_that_the_light_grazes_are_counted_and_not_evaluated) {
  const Ground ground;
  const glm::dvec3 held{1.0, -0.01, 0.0}, sun{1.0, -0.011, 0.0};
  const HeldSun kept = ground.hold(held, sun);
  EXPECT_EQ(kept.direction, held);
  EXPECT_EQ(kept.points_capped, ground.points.size());
}

void expect_few_pages(const Ground& ground) {
  const std::vector<Box> boxes = {ground.casters};
  PageOptions options;
  options.plan.fit = Fit::stable;
  options.page_texels = 64;
  options.capacity = 2048;
  for (const bool holds : {false, true}) {
    std::vector<std::byte> memory(page_memory(2048, 1 << 14));
    std::vector<PageSlot> slots(2048);
    std::vector<std::uint32_t> table(page_table_size(2048));
    std::vector<KeptPage> kept(2048);
    glm::dvec3 held{0.0};
    std::uint64_t drawn = 0, resident = 0;
    double worst = 0.0;
    for (int frame = 0; frame <= 600; ++frame) {
      const glm::dvec3 sun = sun_after(frame);
      const HeldSun now = ground.hold(held, sun);
      held = holds ? now.direction : sun;
      if (now.direction != sun) worst = std::max(worst, now.error_pixels);
      const PagePlan plan = plan_pages(
          {.camera = ground.camera, .points_world = ground.points, .normals_world = ground.normals},
          DirectionalLight{held}, {boxes, boxes}, options, memory);
      ASSERT_EQ(plan.status, PlanStatus::ok);
      const KeptPages result = keep_pages(plan, {}, slots, table, kept);
      ASSERT_TRUE(result.fits);
      if (frame == 0) continue;
      drawn += result.drawn;
      resident += plan.pages.size();
    }
    const double share = static_cast<double>(drawn) / static_cast<double>(resident);
    std::cout << (holds ? "held" : "not held") << ": " << 100.0 * share
              << " % of resident pages drawn, error " << (holds ? worst : 0.0) << " pixels\n";
    if (holds)
      EXPECT_LE(share, 0.1);
    else
      EXPECT_GT(share, 0.9);
  }
}

TEST(HoldSun, a_sun_of_a_quarter_degree_a_minute_draws_a_tenth_of_the_pages_at_most) {
  const Ground ground;
  expect_few_pages(ground);
  Ground towers;
  towers.casters = {{-600, 0, -160}, {600, 100, 200}};
  expect_few_pages(towers);
}

TEST(HoldSun, a_surface_that_only_one_of_both_suns_grazes_is_not_evaluated_either) {
  const Ground ground;
  // Sines of 0.06 and 0.04, on both sides of the least one.
  const glm::dvec3 above{1.0, -0.06, 0.0}, below{1.0, -0.04, 0.0};
  for (const auto& [held, sun] : {std::pair(above, below), std::pair(below, above)}) {
    const HeldSun kept = ground.hold(held, sun);
    EXPECT_EQ(kept.direction, held);
    EXPECT_EQ(kept.points_capped, ground.points.size());
  }
}

}  // namespace
}  // namespace gnomon::test
