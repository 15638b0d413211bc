// Which casters does a map draw: by hand, where one can see it?
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

/// A camera that looks along -z at a ground ten units ahead, under a noon sun.
struct NoonScene {
  Camera camera = perspective_camera({0, 2, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.0, 1.0, 20.0, 256, 256);
  Box ground{{-3, 0, -12}, {3, 0.1, -8}};
  std::vector<Box> casters;
  [[nodiscard]] ShadowPlan plan() const {
    PlanOptions options;
    options.cascades = 1;
    return make_plan(camera, DirectionalLight{{0, -1, 0}}, {casters, {&ground, 1}}, options);
  }
};

std::vector<std::uint32_t> drawn(const ShadowMap& map, const std::vector<Box>& casters) {
  std::vector<std::uint32_t> list(casters.size());
  list.resize(cull_casters(map, casters, list));
  return list;
}

TEST(Cull, only_boxes_above_the_visible_ground_are_drawn_even_high_over_the_picture) {
  NoonScene scene;
  scene.casters = {
      {{-1, 500, -11}, {1, 501, -9}},      // far above, outside of the view: shadows the ground
      {{-1, -5, -11}, {1, -4, -9}},        // below the ground
      {{-1, 1, -30}, {1, 2, -25}},         // behind it
      {{20, 1, -11}, {21, 2, -9}},         // beside it
      {{-1, 1, 1}, {1, 2, 5}},             // behind the camera, ground there is not seen
      Box{},                               // empty
      {{-100, 50, -100}, {100, 60, 100}},  // a roof over everything
  };
  const ShadowPlan plan = scene.plan();
  ASSERT_EQ(plan.map_count, 1);
  EXPECT_EQ(drawn(plan.map[0], scene.casters), (std::vector<std::uint32_t>{0, 6}));
  // The one half a kilometre up is inside the depth range.
  const glm::dvec4 top = plan.map[0].clip_from_world * glm::dvec4(0, 501, -10, 1);
  EXPECT_GE(top.z, -top.w);
}

TEST(Cull, a_caster_that_touches_the_receiver_from_above_is_drawn) {
  NoonScene scene;
  scene.casters = {{{-1, 0.1, -11}, {1, 0.1, -9}}, {{-1, 0.05, -11}, {1, 0.05, -9}}};  // flat
  const ShadowPlan plan = scene.plan();
  ASSERT_EQ(plan.map_count, 1);
  EXPECT_EQ(drawn(plan.map[0], scene.casters).size(), 2u);
}

TEST(Cull, a_map_without_planes_draws_everything_that_is_not_empty) {
  const std::vector<Box> casters = {{{0, 0, 0}, {1, 1, 1}}, Box{}, {{5, 5, 5}, {6, 6, 6}}};
  const ShadowMap map{};
  EXPECT_EQ(drawn(map, casters), (std::vector<std::uint32_t>{0, 2}));
}

}  // namespace
}  // namespace gnomon::test
