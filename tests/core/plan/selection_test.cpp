// Does a point take the finest map that holds it, and what does that bring?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/near.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// A map straight down onto a square of half side `half` round the origin, for points from y = -10 to 10.
ShadowMap map_from_above(double half, int size) {
  ShadowMap map;
  map.width = map.height = size;
  map.clip_from_world = glm::dmat4(1 / half, 0, 0, 0, 0, 0, -0.1, 0, 0, -1 / half, 0, 0, 0, 0, 0, 1);
  return map;
}

ShadowPlan plan_of(std::vector<ShadowMap> maps) {
  ShadowPlan plan;
  plan.status = PlanStatus::ok;
  plan.selection = MapSelection::finest;
  plan.map_count = static_cast<int>(maps.size());
  for (std::size_t i = 0; i < maps.size(); ++i) plan.map[i] = maps[i];
  return plan;
}

TEST(Selection, a_point_takes_the_map_with_the_most_texels_whatever_their_order) {
  const ShadowMap small = map_from_above(1.0, 64), large = map_from_above(10.0, 512);
  for (const bool small_first : {true, false}) {
    const ShadowPlan plan = small_first ? plan_of({small, large}) : plan_of({large, small});
    EXPECT_EQ(map_serving(plan, {0.5, 0, 0.5}, 3.0), small_first ? 0 : 1) << "25.6 texels a unit against 32";
    EXPECT_EQ(map_serving(plan, {5.0, 0, 0.5}, 3.0), small_first ? 1 : 0);
    EXPECT_EQ(map_serving(plan, {11.0, 0, 0.5}, 3.0), -1);
    EXPECT_EQ(map_serving(plan, {0.5, 11, 0.5}, 3.0), -1) << "in front of the light's near plane";
  }
}

TEST(Selection, of_equal_maps_the_first_serves_and_none_of_no_maps) {
  const ShadowMap map = map_from_above(1.0, 64);
  EXPECT_EQ(map_serving(plan_of({map, map}), {0, 0, 0}, 0.0), 0);
  EXPECT_EQ(map_serving(plan_of({}), {0, 0, 0}, 0.0), -1);
}

TEST(Selection, a_map_without_texels_per_area_serves_where_no_other_holds_the_point) {
  ShadowMap flat = map_from_above(1.0, 64);
  flat.clip_from_world[0][0] = 0.0;
  EXPECT_EQ(map_serving(plan_of({flat}), {0, 0, 0}, 0.0), 0);
  EXPECT_EQ(map_serving(plan_of({flat, map_from_above(100.0, 4)}), {0, 0, 0}, 0.0), 1);
}

/// Four unwarped cascades in a box of 300 under a light within 20 degrees of the view.
struct LitAlongTheView {
  Camera camera = perspective_camera({0, 20, 140}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 1, 300, 960, 640);
  std::vector<Box> boxes = {{{-150, -5, -150}, {150, 60, 150}}};
  PlanOptions options;
  LitAlongTheView() {
    options.warp.warp = &warps::none;
    options.resolution.max_size = 1024;
    options.split.scheme = SplitScheme::logarithmic;
  }
  [[nodiscard]] ShadowPlan plan(MapSelection selection) const {
    PlanOptions with = options;
    with.split.selection = selection;
    return make_plan(camera, DirectionalLight{{0.15, -0.3, -1}}, {boxes, boxes}, with);
  }
};

TEST(Selection, under_a_light_along_the_view_points_behind_the_first_cascade_get_shorter_texels) {
  const LitAlongTheView scene;
  const ShadowPlan by_depth = scene.plan(MapSelection::view_depth), finest = scene.plan(MapSelection::finest);
  ASSERT_EQ(by_depth.map_count, 4);
  ASSERT_EQ(finest.map_count, 4);
  Random random(1);
  int behind = 0, nearer = 0;
  double before = 0.0, after = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double depth =
        by_depth.map[0].depth_end * std::pow(300.0 / by_depth.map[0].depth_end, random.unit());
    const glm::dvec3 point = point_at(scene.camera, random.between(-1, 1), random.between(-1, 1), depth);
    const Box& box = scene.boxes[0];
    if (glm::any(glm::lessThan(point, box.min)) || glm::any(glm::greaterThan(point, box.max))) continue;
    const int a = map_serving(by_depth, point, depth), b = map_serving(finest, point, depth);
    ASSERT_GE(a, 1);
    ASSERT_GE(b, 0);
    EXPECT_LE(b, a);
    ++behind;
    if (b == a) continue;
    ++nearer;
    before += measure_perspective(by_depth.map[static_cast<std::size_t>(a)], scene.camera, point).m_max;
    after += measure_perspective(finest.map[static_cast<std::size_t>(b)], scene.camera, point).m_max;
  }
  RecordProperty("share", std::to_string(static_cast<double>(nearer) / behind));
  RecordProperty("ratio", std::to_string(before / after));
  EXPECT_GT(nearer, behind / 5);
  EXPECT_GT(before, 3.0 * after);
}

TEST(Selection, cascades_keep_their_rectangles_and_widen_their_depths_and_planes) {
  const LitAlongTheView scene;
  const ShadowPlan by_depth = scene.plan(MapSelection::view_depth), finest = scene.plan(MapSelection::finest);
  EXPECT_EQ(finest.selection, MapSelection::finest);
  EXPECT_EQ(by_depth.selection, MapSelection::view_depth);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(finest.map[i].texel_world, by_depth.map[i].texel_world) << i;
    EXPECT_GE(finest.map[i].depth_range_world, by_depth.map[i].depth_range_world * (1 - 1e-12)) << i;
  }
  EXPECT_GT(finest.map[0].depth_range_world, 1.5 * by_depth.map[0].depth_range_world);
}

TEST(Selection, where_it_has_no_use_the_plan_says_so) {
  LitAlongTheView scene;
  scene.options.split.selection = MapSelection::finest;
  const auto ignored = [&](const ShadowPlan& plan, IgnoredOption option) {
    return std::ranges::any_of(plan.omitted(), [&](const Omission& o) {
      return o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(option);
    });
  };
  const SceneBounds bounds{scene.boxes, scene.boxes};
  EXPECT_TRUE(ignored(make_plan(scene.camera, PointLight{{0, 50, 0}, 200.0}, bounds, scene.options),
                      IgnoredOption::selection));
  scene.options.split.overlap = 0.2;
  const ShadowPlan plan = make_plan(scene.camera, DirectionalLight{{0, -1, -1}}, bounds, scene.options);
  EXPECT_TRUE(ignored(plan, IgnoredOption::split_overlap));
  EXPECT_FALSE(ignored(plan, IgnoredOption::selection));
  for (const ShadowMap& map : plan.maps()) EXPECT_EQ(map.overlap, 0.0);
  scene.options.split.partition = Partition::frustum_faces;
  EXPECT_TRUE(ignored(make_plan(scene.camera, DirectionalLight{{0, -1, -1}}, bounds, scene.options),
                      IgnoredOption::selection));
}

TEST(Selection, a_map_keeps_the_casters_over_the_quarter_texel_that_it_serves_beside_its_edge) {
  LitAlongTheView scene;
  scene.options.resolution.max_size = 16;
  scene.options.filter.texels = 0.0;
  const ShadowPlan plan = scene.plan(MapSelection::finest);
  ASSERT_EQ(plan.map_count, 4);
  Random random(1);
  int beside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double depth = 300.0 * random.unit();
    const glm::dvec3 point = point_at(scene.camera, random.between(-1, 1), random.between(-1, 1), depth);
    const Box& box = scene.boxes[0];
    if (depth < 1.0 || glm::any(glm::lessThan(point, box.min)) || glm::any(glm::greaterThan(point, box.max)))
      continue;
    const int serving = map_serving(plan, point, depth);
    ASSERT_GE(serving, 0);
    const ShadowMap& map = plan.map[static_cast<std::size_t>(serving)];
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(point, 1.0);
    if (std::max(std::abs(clip.x), std::abs(clip.y)) <= clip.w) continue;
    ++beside;
    const glm::dvec3 over = point + glm::dvec3(map.light_world) * 10.0;
    const Box caster{over - 1e-3, over + 1e-3};
    EXPECT_EQ(cull_casters(map, {&caster, 1}, {}), 1u) << i;
  }
  EXPECT_GT(beside, 50);
}

}  // namespace
}  // namespace gnomon::test
