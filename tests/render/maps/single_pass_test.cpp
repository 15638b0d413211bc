// Do maps that one layered pass draws hold the bits of maps drawn one by one?
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <string>
#include <vector>

#include "gnomon/render/probe.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "maps/layered_maps.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

constexpr int kWidth = 160, kHeight = 90;

FrameOptions by(MapPasses passes, PruneRules rules = prune_rules_of(PruneSource::this_frame)) {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  options.prune = rules;
  options.map_passes = passes;
  return options;
}

/// A scene drawn by two renderers.
struct Pair {
  Scene scene;
  std::vector<Box> boxes;
  Renderer joined, each;
  explicit Pair(Scene of) : scene(std::move(of)), boxes(boxes_of(scene)), joined(scene), each(scene) {}
  [[nodiscard]] SceneBounds bounds() const noexcept { return {boxes, boxes}; }
};

std::size_t differing_texels(const Renderer& a, const Renderer& b, const ShadowPlan& plan) {
  std::size_t count = 0;
  for (int map = 0; map < plan.map_count; ++map) {
    const std::vector<float> one = a.depth_map(map).values, other = b.depth_map(map).values;
    EXPECT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i)
      count += std::bit_cast<std::uint32_t>(one[i]) != std::bit_cast<std::uint32_t>(other[i]) ? 1 : 0;
  }
  return count;
}

bool has_casters(const Renderer& renderer, int map) {
  for (const float depth : renderer.depth_map(map).values) {
    if (depth < 1.0f) return true;
  }
  return false;
}

/// Four maps of one size, under the sun.
ShadowPlan four_maps(const Scene& scene, const Camera& camera) {
  PlanOptions options;
  options.cascades = 4;
  options.resolution.max_size = 128;
  options.prune = kPruneNothing;
  return plan_for(scene, camera, {0.4, -0.8, -0.3}, options);
}

class SinglePass : public testing::Test {
 protected:
  void SetUp() override {
    // Without that there is no such pass to test; renderers then draw each map by itself.
    if (layer_extension().empty()) GTEST_SKIP() << "the driver does not write gl_Layer in vertex shaders";
  }
};

struct Case {
  const char* name;
  LightKind light;
  int cascades;
  int map_size;
  Fit fit = Fit::tight;
  double max_error = 0.0;  ///< 0: maps are as large as each other
};
constexpr Case kCases[] = {{"two cascades", LightKind::sun, 2, 200},
                           {"four cascades", LightKind::sun, 4, 512},
                           {"four cascades of their own sizes", LightKind::sun, 4, 512, Fit::tight, 3.0},
                           {"eight stable cascades", LightKind::sun, 8, 256, Fit::stable},
                           {"faces of a point light", LightKind::point, 1, 256}};

PlanOptions options_of(const Case& c) {
  PlanOptions options;
  options.cascades = c.cascades;
  options.resolution.max_size = c.map_size;
  options.fit = c.fit;
  options.resolution.max_error = c.max_error;
  return options;
}

TEST_F(SinglePass, every_bit_of_every_depth_is_that_of_one_pass_for_each_map) {
  int compared = 0, of_unequal_sizes = 0, masked = 0;
  for (const BuiltinScene& builtin : builtin_scenes()) {
    Pair pair(load_builtin(std::string(builtin.name)));
    for (const Material& material : pair.scene.materials)
      masked += material.alpha_mode != AlphaMode::opaque ? 1 : 0;
    const PreparedFilter joined = pair.joined.prepare(filters::hard), each = pair.each.prepare(filters::hard);
    for (const Case& c : kCases) {
      LightPlacement placement;
      placement.kind = c.light;
      const Camera camera = default_path(pair.scene).at(0.4, kWidth, kHeight);
      const ShadowPlan plan =
          make_plan(camera, default_light(placement, pair.scene.bounds_world), pair.bounds(), options_of(c));
      if (plan.map_count < 2) continue;
      for (const DepthLayer layer : {DepthLayer::front, DepthLayer::back}) {
        FrameOptions options = by(MapPasses::layered);
        options.depth_layer = layer;
        const FrameStats stats = pair.joined.draw(plan, camera, joined, options);
        if (c.max_error == 0.0) {
          EXPECT_EQ(stats.layered_maps, plan.map_count) << builtin.name << ", " << c.name;
        }
        options.map_passes = MapPasses::each;
        EXPECT_EQ(pair.each.draw(plan, camera, each, options).layered_maps, 0);
        EXPECT_EQ(differing_texels(pair.joined, pair.each, plan), 0u) << builtin.name << ", " << c.name;
        EXPECT_EQ(pair.joined.mask().values, pair.each.mask().values) << builtin.name << ", " << c.name;
      }
      ++compared;
      for (const ShadowMap& map : plan.maps())
        of_unequal_sizes += map.width != plan.map[0].width || map.height != plan.map[0].height ? 1 : 0;
    }
  }
  EXPECT_GE(compared, 20);
  EXPECT_GT(of_unequal_sizes, 0);
  EXPECT_GT(masked, 0);
}

TEST_F(SinglePass, one_command_draws_a_primitive_into_all_its_maps) {
  // A row of pillars of one primitive, each into every cascade, and a ground of another.
  Scene scene = box_on_ground();
  const Instance first = scene.instances.back();
  for (int i = 1; i < 6; ++i) {
    Instance other = first;
    const glm::dvec3 shift(2.5 * i, 0.0, -2.0 * i);
    other.world_from_object[3] += glm::dvec4(shift, 0.0);
    other.bounds_world.min += shift;
    other.bounds_world.max += shift;
    scene.instances.push_back(other);
    scene.bounds_world.extend(other.bounds_world);
  }
  const Camera camera = camera_on_box(kWidth, kHeight);
  const ShadowPlan plan = four_maps(scene, camera);
  ASSERT_EQ(plan.map_count, 4);
  Renderer renderer(scene);
  const FrameStats stats =
      renderer.draw(plan, camera, renderer.prepare(filters::hard), by(MapPasses::layered, kPruneNothing));
  EXPECT_EQ(stats.layered_maps, 4);
  EXPECT_EQ(stats.layered_draws, 2u);
  for (int map = 0; map < 4; ++map) {
    EXPECT_EQ(stats.map[static_cast<std::size_t>(map)].draws, 2u);
    EXPECT_EQ(stats.map[static_cast<std::size_t>(map)].instances, 7u);
    EXPECT_TRUE(has_casters(renderer, map));
  }
}

TEST_F(SinglePass, kept_and_scrolled_maps_are_left_to_passes_of_their_own) {
  int layered = 0, held = 0, scrolled = 0;
  for (const char* name : {"hangar", "fence"}) {
    Pair pair(load_builtin(name));
    const PreparedFilter joined = pair.joined.prepare(filters::hard), each = pair.each.prepare(filters::hard);
    const CameraPath path = default_path(pair.scene);
    for (int frame = 0; frame < 10; ++frame) {
      // The camera rests, moves a little, jumps.
      const double t = frame < 3 ? 0.3 : frame < 8 ? 0.3 + frame / 600.0 : 0.7;
      const Camera camera = path.at(t, kWidth, kHeight);
      const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.5, -0.8, 0.4}}, pair.bounds(),
                                        options_of({"", LightKind::sun, 4, 256, Fit::stable}));
      const PruneRules rules = exact_prune_rules().with(PruneRule::scrolled_maps);
      const FrameStats stats = pair.joined.draw(plan, camera, joined, by(MapPasses::layered, rules));
      pair.each.draw(plan, camera, each, by(MapPasses::each, rules));
      EXPECT_EQ(differing_texels(pair.joined, pair.each, plan), 0u) << name << ", frame " << frame;
      layered += stats.layered_maps;
      for (int map = 0; map < stats.map_count; ++map) {
        held += stats.map[static_cast<std::size_t>(map)].held ? 1 : 0;
        scrolled += stats.map[static_cast<std::size_t>(map)].scrolled ? 1 : 0;
      }
    }
  }
  EXPECT_GE(layered, 4);
  EXPECT_GT(held, 0);
  EXPECT_GT(scrolled, 0);
}

TEST_F(SinglePass, maps_beside_kept_ones_are_cleared_and_kept_ones_are_not) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kWidth, kHeight);
  ShadowPlan plan = four_maps(scene, camera);
  ASSERT_EQ(plan.map_count, 4);
  Renderer joined(scene), each(scene);
  const auto draw = [&] {
    const FrameStats stats =
        joined.draw(plan, camera, joined.prepare(filters::hard), by(MapPasses::layered, exact_prune_rules()));
    each.draw(plan, camera, each.prepare(filters::hard), by(MapPasses::each, exact_prune_rules()));
    EXPECT_EQ(differing_texels(joined, each, plan), 0u);
    return stats;
  };
  EXPECT_EQ(draw().layered_maps, 4);
  // Two maps look elsewhere: one at nothing at all.
  plan.map[1].clip_from_world[3] += glm::dvec4(0.2, 0.1, 0.0, 0.0);
  plan.map[1].clip_from_camera_relative[3] += glm::vec4(0.2f, 0.1f, 0.0f, 0.0f);
  plan.map[3].clip_from_world[3] += glm::dvec4(30.0, 0.0, 0.0, 0.0);
  const FrameStats stats = draw();
  EXPECT_EQ(stats.layered_maps, 2);
  EXPECT_TRUE(stats.map[0].held && stats.map[2].held);
  EXPECT_TRUE(has_casters(joined, 0));
  EXPECT_FALSE(has_casters(joined, 3));
  // All maps at nothing.
  for (int map = 0; map < 3; ++map)
    plan.map[static_cast<std::size_t>(map)].clip_from_world[3] += glm::dvec4(40.0, 0.0, 0.0, 0.0);
  EXPECT_GE(draw().layered_maps, 2);
  for (int map = 0; map < 4; ++map) EXPECT_FALSE(has_casters(joined, map));
}

TEST_F(SinglePass, peeled_maps_bent_maps_and_single_maps_have_passes_of_their_own) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kWidth, kHeight);
  Renderer renderer(scene);
  const PreparedFilter filter = renderer.prepare(filters::hard);
  PlanOptions options;
  options.cascades = 3;
  options.resolution.max_size = 128;
  const glm::dvec3 light{0.4, -0.8, -0.3};
  const ShadowPlan three = plan_for(scene, camera, light, options);
  ASSERT_EQ(three.map_count, 3);
  FrameOptions frame = by(MapPasses::layered);
  EXPECT_EQ(renderer.draw(three, camera, filter, frame).layered_maps, 3);
  frame.depth_layer = DepthLayer::midpoint;
  EXPECT_EQ(renderer.draw(three, camera, filter, frame).layered_maps, 0);
  frame.depth_layer = DepthLayer::front;
  options.cascades = 1;
  EXPECT_EQ(renderer.draw(plan_for(scene, camera, light, options), camera, filter, frame).layered_maps, 0);
  EXPECT_EQ(renderer.draw(ShadowPlan{}, camera, filter, frame).layered_maps, 0);
  options.warp.shape = find_shape("paraboloid");
  options.split.partition = Partition::tetrahedron;
  const std::vector<Box> boxes = boxes_of(scene);
  const ShadowPlan bent = make_plan(camera, PointLight{{2.0, 4.0, 2.0}, 60.0}, {boxes, boxes}, options);
  int straight = 0;
  for (const ShadowMap& map : bent.maps()) straight += map.shape->affine ? 1 : 0;
  ASSERT_LT(straight, bent.map_count);
  EXPECT_EQ(renderer.draw(bent, camera, filter, frame).layered_maps, straight > 1 ? straight : 0);
}

TEST_F(SinglePass, maps_of_the_most_frequent_size_are_joined) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kWidth, kHeight);
  ShadowPlan plan = four_maps(scene, camera);
  ASSERT_EQ(plan.map_count, 4);
  Renderer joined(scene), each(scene);
  const auto draw = [&] {
    each.draw(plan, camera, each.prepare(filters::hard), by(MapPasses::each));
    const int maps =
        joined.draw(plan, camera, joined.prepare(filters::hard), by(MapPasses::layered)).layered_maps;
    EXPECT_EQ(differing_texels(joined, each, plan), 0u);
    return maps;
  };
  plan.map[0].width = 200;
  EXPECT_EQ(draw(), 3);
  plan.map[1].height = 72;
  EXPECT_EQ(draw(), 2);
  plan.map[3].width = 96;
  EXPECT_EQ(draw(), 0);
}

TEST(SinglePassRule, software_never_joins_and_hardware_joins_where_commands_become_fewer) {
  EXPECT_FALSE(one_pass_is_faster(1000, 10, true));
  EXPECT_TRUE(one_pass_is_faster(40, 20, false));
  EXPECT_TRUE(one_pass_is_faster(4, 3, false));
  EXPECT_FALSE(one_pass_is_faster(40, 39, false));
}

}  // namespace
}  // namespace gnomon::render
