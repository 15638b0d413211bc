// Is a map as deep as its casters, whichever axis of the world points to the light?
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

/// Axes taken in turn, each with a sign: what turned or mirrored worlds differ by.
struct Turn {
  int by = 0;
  glm::dvec3 sign{1.0};
  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& v) const {
    return glm::dvec3(v[by % 3], v[(by + 1) % 3], v[(by + 2) % 3]) * sign;
  }
  [[nodiscard]] Box operator()(const Box& box) const {
    const glm::dvec3 a = (*this)(box.min), b = (*this)(box.max);
    return {glm::min(a, b), glm::max(a, b)};
  }
};

/// A ground, and a tower whose faces all lie at different distances from the origin.
double depth_range(const Turn& turn, const glm::dvec3& light) {
  const Camera camera = perspective_camera(turn({1, 6, 40}), turn({0.1, -0.3, -1}), turn({0, 1, 0}), 1.0, 1.0,
                                           1.0, 100.0, 512, 512);
  const std::vector<Box> receivers = {turn({{-50, -1, -60}, {55, 0, 45}})};
  const std::vector<Box> casters = {receivers[0], turn({{-7, 0, -12}, {3, 21, 5}})};
  PlanOptions options;
  options.cascades = 1;
  options.warp.warp = &warps::none;
  const ShadowPlan plan = make_plan(camera, DirectionalLight{turn(light)}, {casters, receivers}, options);
  EXPECT_EQ(plan.map_count, 1);
  return plan.map_count == 1 ? plan.map[0].depth_range_world : 0.0;
}

TEST(Depths, of_a_map_are_the_same_along_every_axis_and_against_it) {
  constexpr double kRounding = 1e-9;
  for (const glm::dvec3 light : {glm::dvec3(0.3, -1, 0.2), glm::dvec3(-0.4, -1, -0.7)}) {
    const double upright = depth_range({}, light);
    // The tower's top, not its far corner, bounds the depths: they end below that.
    EXPECT_LT(upright, 150.0);
    for (int by = 0; by < 3; ++by) {
      for (int mirrored = 0; mirrored < 8; ++mirrored) {
        const glm::dvec3 sign{(mirrored & 1) ? -1 : 1, (mirrored & 2) ? -1 : 1, (mirrored & 4) ? -1 : 1};
        EXPECT_NEAR(depth_range({by, sign}, light), upright, kRounding * upright) << by << " " << mirrored;
      }
    }
  }
}

TEST(Depths, of_a_spot_begin_before_the_nearest_of_many_casters_listed_from_far_to_near) {
  const Camera camera =
      perspective_camera({0, 60, 150}, {0, -0.4, -1}, {0, 1, 0}, 1.0, 1.0, 1.0, 400.0, 512, 512);
  const SpotLight spot{{0, 100, 0}, {0, -1, 0}, 0.5, 200.0};
  const std::vector<Box> receivers = {{{-100, -1, -100}, {100, 0, 100}}};
  PlanOptions options;
  options.warp.warp = &warps::none;
  // More than are cut at first, and more than are cut at all.
  for (const int count : {8, 9, 10, 20, 64, 65, 70, 90}) {
    std::vector<Box> casters;
    for (int i = 1; i <= count; ++i) {
      const double height = 95.0 * i / count;
      casters.push_back({{-0.1, height, -0.1}, {0.1, height + 0.5, 0.1}});
    }
    const ShadowPlan plan = make_plan(camera, spot, {casters, receivers}, options);
    ASSERT_EQ(plan.map_count, 1) << count;
    const glm::dvec4 top = plan.map[0].clip_from_world * glm::dvec4(0.0, 95.5, 0.0, 1.0);
    EXPECT_GT(top.w, 0.0);
    EXPECT_GE(top.z, -top.w) << count << " casters";
    EXPECT_LE(top.z, -0.98 * top.w) << "no nearer than needed, with " << count << " casters";
  }
}

TEST(Depths, of_a_spot_in_a_room_begin_before_a_caster_nearer_than_where_the_room_lets_them_begin) {
  const Camera camera =
      perspective_camera({0, 60, 150}, {0, -0.4, -1}, {0, 1, 0}, 1.0, 1.0, 1.0, 400.0, 512, 512);
  const SpotLight spot{{0, 100, 0}, {0, -1, 0}, 0.5, 200.0};
  const std::vector<Box> receivers = {{{-100, -1, -100}, {100, 0, 100}}};
  // The room holds the light, and the shade does not: 0.04 below it, where maps begin at 101 / 1024.
  const Box room{{-200, -1, -200}, {200, 120, 200}}, shade{{-0.001, 99.95, -0.001}, {0.001, 99.96, 0.001}};
  PlanOptions options;
  options.warp.warp = &warps::none;
  const auto shows_shade = [&](const std::vector<Box>& casters) {
    const ShadowPlan plan = make_plan(camera, spot, {casters, receivers}, options);
    EXPECT_EQ(plan.map_count, 1);
    const glm::dvec4 top = plan.map[0].clip_from_world * glm::dvec4(0.0, shade.max.y, 0.0, 1.0);
    return top.w > 0.0 && top.z >= -top.w;
  };
  EXPECT_FALSE(shows_shade({room}));
  EXPECT_TRUE(shows_shade({room, shade}));
  EXPECT_TRUE(shows_shade({shade}));
}

}  // namespace
}  // namespace gnomon::test
