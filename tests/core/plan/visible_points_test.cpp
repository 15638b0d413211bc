// Do visible points shrink the maps across the light to what is seen, and to nothing less?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// A plain of 400 by 400 seen from above its edge; the light comes straight down.
struct Plain {
  Camera camera = perspective_camera({0, 10, 200}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 1, 400, 960, 640);
  std::vector<Box> boxes = {{{-200, 0, -200}, {200, 4, 200}}};
  PlanOptions options;
  glm::dvec3 light{0, -1, 0};
  Plain() {
    options.cascades = 1;
    options.warp.warp = &warps::none;
  }
  [[nodiscard]] ShadowPlan plan(std::span<const glm::dvec3> points) const {
    return make_plan({.camera = camera, .points_world = points}, DirectionalLight{light}, {boxes, boxes},
                     options);
  }
};

bool same(const ShadowPlan& a, const ShadowPlan& b) {
  if (a.status != b.status || a.map_count != b.map_count) return false;
  for (std::size_t i = 0; i < a.maps().size(); ++i) {
    if (a.map[i].clip_from_world != b.map[i].clip_from_world) return false;
  }
  return true;
}

bool ignored(const ShadowPlan& plan, IgnoredOption option) {
  return std::ranges::any_of(plan.omitted(), [&](const Omission& o) {
    return o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(option);
  });
}

TEST(VisiblePoints, by_hand_the_map_is_as_wide_as_their_bounds_and_the_room_round_them) {
  const Plain plain;
  // Seen between x = -10 and 10, at depths round 100.
  const std::vector<glm::dvec3> points = {{-10, 2, 100}, {10, 2, 90}, {0, 1, 95}};
  const ShadowPlan plan = plain.plan(points);
  ASSERT_EQ(plan.map_count, 1);
  const ShadowMap& map = plan.map[0];
  const double texels = map.width - 2 * map.filter_margin_texels;
  const double depth = depth_of(plain.camera, points[1]);
  const double pixel = (plain.camera.top - plain.camera.bottom) / 640;
  const double room = kPointSafety * 20.0 + 16.0 * pixel * depth;
  EXPECT_NEAR(map.texel_world.x * texels, 20.0 + 2.0 * room, 0.01 * room);
  for (const glm::dvec3& point : points) EXPECT_TRUE(map_holds(plan, map, point));
  EXPECT_LT(map.texel_world.x, 0.25 * plain.plan({}).map[0].texel_world.x);
}

// Its depth is the sum of far larger numbers: by their rounding it lies before the slice that begins at it.
TEST(VisiblePoints, a_point_far_beside_the_axis_belongs_to_the_slice_that_begins_at_its_depth) {
  const Camera camera =
      orthographic_camera({0, 0, 0}, {-0.8, -0.08, 1}, {0, 1, 0}, 1.0, 1.0, 2.7e-11, 1.0, 20000, 2000);
  const CameraAxes axes = camera_axes(camera);
  const std::vector<Box> boxes = {{{0, -1, 0}, {1, 0, 1}}};
  const auto at = [&](double x, double y, double depth) {
    return axes.right * x + axes.up * y + axes.forward * depth;
  };
  int before = 0;
  for (const double x : {-0.5, -0.4, -0.3, -0.2, -0.1}) {
    for (const double y : {-0.5, -0.4, -0.3, -0.2}) {
      const double near = camera.near_depth;
      const std::vector<glm::dvec3> points = {at(x, y, near), at(-0.3, -0.3, 1.00001 * near),
                                              at(-0.3, -0.3, 1e-8)};
      const ShadowPlan plan = make_plan({.camera = camera, .points_world = points},
                                        DirectionalLight{{0.25, -1, 0.5}}, {boxes, boxes}, PlanOptions{});
      const double depth = depth_of(camera, points[0]);
      before += depth < near ? 1 : 0;
      const int map = map_serving(plan, points[0], depth);
      ASSERT_GE(map, 0);
      EXPECT_TRUE(map_holds(plan, plan.map[static_cast<std::size_t>(map)], points[0])) << x << ", " << y;
    }
  }
  EXPECT_GT(before, 0);
}

TEST(VisiblePoints, the_room_goes_by_the_longer_side_of_a_pixel) {
  for (const bool wide : {true, false}) {
    Plain plain;
    (wide ? plain.camera.width : plain.camera.height) = 40;
    // Beside the axis, so that no edge of the image is the other one's opposite.
    plain.camera.left += 0.1;
    plain.camera.right += 0.1;
    plain.camera.bottom += 0.05;
    plain.camera.top += 0.05;
    const std::vector<glm::dvec3> one = {{0, 2, 100}};
    const ShadowPlan plan = plain.plan(one);
    ASSERT_EQ(plan.map_count, 1);
    const ShadowMap& map = plan.map[0];
    const Camera& camera = plain.camera;
    const double pixel = wide ? (camera.right - camera.left) / 40 : (camera.top - camera.bottom) / 40;
    const double room = 16.0 * pixel * depth_of(camera, one[0]);
    EXPECT_NEAR(map.texel_world.x * (map.width - 2 * map.filter_margin_texels), 2.0 * room, 0.01 * room);
  }
}

TEST(VisiblePoints, none_or_none_in_view_or_beside_all_receivers_change_nothing) {
  const Plain plain;
  const ShadowPlan without = plain.plan({});
  const std::vector<glm::dvec3> behind = {{0, 2, 500}}, beyond = {{0, 2, -900}}, beside = {{900, 2, -100}};
  EXPECT_TRUE(same(plain.plan(behind), without));
  EXPECT_TRUE(same(plain.plan(beyond), without));
  EXPECT_TRUE(same(plain.plan(beside), without));
}

TEST(VisiblePoints, one_point_gets_a_map_of_its_own_size) {
  const Plain plain;
  const std::vector<glm::dvec3> one = {{3, 2, 150}};
  const ShadowPlan plan = plain.plan(one);
  ASSERT_EQ(plan.map_count, 1);
  EXPECT_TRUE(map_holds(plan, plan.map[0], one[0]));
  EXPECT_TRUE(std::isfinite(plan.map[0].m_max));
}

TEST(VisiblePoints, a_broken_point_is_named) {
  const Plain plain;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<glm::dvec3> broken = {{0, 2, 100}, {0, nan, 0}};
  const ShadowPlan plan = plain.plan(broken);
  EXPECT_EQ(plan.status, PlanStatus::invalid_input);
  EXPECT_EQ(plan.invalid_field, "view.points_world");
}

TEST(VisiblePoints, that_are_turned_from_the_light_move_no_texels) {
  Plain plain;
  plain.options.warp = {};
  plain.light = {0.2, -1, 0.4};
  // A floor, and walls nearer to the eye.
  std::vector<glm::dvec3> points, normals;
  for (int i = 0; i < 600; ++i) {
    const bool is_wall = i % 2 == 0;
    points.push_back({i % 40 - 20.0, is_wall ? 3.0 : 0.0, is_wall ? 190.0 - 0.02 * i : 150.0 - 0.5 * i});
    normals.push_back(is_wall ? glm::dvec3{0, 0, 1} : glm::dvec3{0, 1, 0});
  }
  const auto plan = [&](const std::vector<glm::dvec3>& facing) {
    const View view{.camera = plain.camera, .points_world = points, .normals_world = facing};
    return make_plan(view, DirectionalLight{plain.light}, {plain.boxes, plain.boxes}, plain.options);
  };
  const std::vector<glm::dvec3> up(points.size(), {0, 1, 0});
  EXPECT_TRUE(same(plan(up), plan({}))) << "all may be lit";
  EXPECT_FALSE(same(plan(normals), plan({})));
  const auto at_the_floor = [&](const ShadowPlan& of) {
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); i += 2)
      sum += measure_perspective(of.map[0], plain.camera, points[i]).perspective_max;
    return sum;
  };
  EXPECT_LT(at_the_floor(plan(normals)), 0.9 * at_the_floor(plan({})));
}

TEST(VisiblePoints, broken_normals_are_named) {
  const Plain plain;
  const std::vector<glm::dvec3> points = {{0, 2, 100}, {0, 2, 120}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<glm::dvec3>& normals : std::initializer_list<std::vector<glm::dvec3>>{
           {{0, 1, 0}}, {{0, 1, 0}, {0, 2, 0}}, {{0, 1, 0}, {0, nan, 0}}}) {
    const View view{.camera = plain.camera, .points_world = points, .normals_world = normals};
    const ShadowPlan plan =
        make_plan(view, DirectionalLight{plain.light}, {plain.boxes, plain.boxes}, plain.options);
    EXPECT_EQ(plan.status, PlanStatus::invalid_input);
    EXPECT_EQ(plan.invalid_field, "view.normals_world");
  }
}

TEST(VisiblePoints, fits_and_lights_that_do_not_follow_them_say_so) {
  Plain plain;
  // Objective::picture counts error at them where maps do not follow them.
  PlanOptions by_storage;
  by_storage.warp.objective = Objective::storage;
  plain.options = by_storage;
  const std::vector<glm::dvec3> points = {{-10, 2, 100}, {10, 2, 90}};
  EXPECT_FALSE(ignored(plain.plan(points), IgnoredOption::visible_points));
  for (const Fit fit : {Fit::stable, Fit::warped_stable}) {
    plain.options.fit = fit;
    EXPECT_TRUE(ignored(plain.plan(points), IgnoredOption::visible_points));
    EXPECT_TRUE(same(plain.plan(points), plain.plan({})));
  }
  plain.options = by_storage;
  const SceneBounds bounds{plain.boxes, plain.boxes};
  const View view{.camera = plain.camera, .points_world = points};
  const PointLight point{{0, 50, 100}, 200.0};
  EXPECT_TRUE(ignored(make_plan(view, point, bounds, by_storage), IgnoredOption::visible_points));
  EXPECT_FALSE(ignored(make_plan(view, point, bounds), IgnoredOption::visible_points));
  plain.options.split.partition = Partition::separating_plane;
  EXPECT_TRUE(ignored(plain.plan(points), IgnoredOption::visible_points));
}

TEST(VisiblePoints, every_point_that_had_a_map_keeps_one_and_maps_grow_no_wider) {
  int held = 0, narrower = 0;
  for_all(600, [&] {
    Case c = draw_case();
    c.options.warp.warp = &warps::none;
    c.options.fit = Fit::tight;
    c.options.split.scheme = SplitScheme::logarithmic;
    const ShadowPlan without = c.plan();
    Random random(3);
    const std::vector<glm::dvec3> points = visible_points(c, random, 2, 3);
    const ShadowPlan plan = make_plan({.camera = c.camera, .points_world = points}, DirectionalLight{c.light},
                                      c.bounds(), c.options);
    require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
    for (const glm::dvec3& point : points) {
      const double depth = depth_of(c.camera, point);
      const int map = map_serving(plan, point, depth);
      if (map < 0) continue;
      ++held;
      require(map_holds(plan, plan.map[static_cast<std::size_t>(map)], point), "out of map", map, c);
    }
    for (const ShadowMap& map : plan.maps()) {
      for (const ShadowMap& other : without.maps()) {
        if (other.cascade != map.cascade) continue;
        require(
            map.texel_world.x * map.texel_world.y <= other.texel_world.x * other.texel_world.y * (1.0 + 1e-6),
            "wider", c);
        narrower += map.texel_world.x * map.texel_world.y < 0.5 * other.texel_world.x * other.texel_world.y;
      }
    }
  });
  EXPECT_GT(held, 500);
  EXPECT_GT(narrower, 50);
}

}  // namespace
}  // namespace gnomon::test
