// Do biases in an engine's units suffice at every angle, and leave no gap?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "captures.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/study/engine_bias.hpp"

namespace gnomon::judge::test {
namespace {

struct Street {
  Camera camera = perspective_camera({0, 4, 10}, {0, -0.05, -1}, {0, 1, 0}, 1.0, 1.7, 0.5, 250.0, 960, 540);
  std::vector<Box> boxes{{{-40, -1, -200}, {40, 0, 20}}};
  Street() {
    for (int i = 0; i < 40; ++i) {
      const double x = i % 2 == 0 ? -12.0 : 8.0;
      boxes.push_back({{x, 0, -5.0 * i - 3.0}, {x + 4.0, 2.0 + i % 7, -5.0 * i}});
    }
  }
  [[nodiscard]] ShadowPlan plan(const Light& light, const Warp& warp) const {
    PlanOptions options;
    options.warp.warp = &warp;
    return make_plan(camera, light, {boxes, boxes}, options);
  }
  /// The plan as an engine would hand it in, with biases of one kind.
  [[nodiscard]] Json capture(const ShadowPlan& plan, const glm::dvec3& sun, BiasWay way,
                             double radius) const {
    Json maps = Json::array(), list = Json::array();
    for (const ShadowMap& map : plan.maps()) {
      const EngineBias bias = engine_bias(map, {}, way, radius);
      maps.push_back({{"clip_from_world", numbers(map.clip_from_world)},
                      {"width", map.width},
                      {"height", map.height},
                      {"depths", {map.depth_begin, map.depth_end}},
                      {"filter_texels", radius},
                      {"bias",
                       {{"depth", bias.depth},
                        {"slope_factor", bias.slope_factor},
                        {"normal_world", bias.normal_world}}}});
    }
    for (const Box& box : boxes)
      list.push_back(
          {{"min", {box.min.x, box.min.y, box.min.z}}, {"max", {box.max.x, box.max.y, box.max.z}}});
    return {{"format", "gnomon-capture/1"},
            {"camera",
             {{"view_from_world", numbers(view_from_world(camera))},
              {"clip_from_view", numbers(clip_from_view(camera))},
              {"width", camera.width},
              {"height", camera.height}}},
            {"lights", {{{"type", "directional"}, {"direction", {sun.x, sun.y, sun.z}}}}},
            {"maps", maps},
            {"receivers", list},
            {"casters", list}};
  }
};

TEST(EngineBias, suffices_at_every_angle_and_leaves_no_gap) {
  const Street street;
  for (const glm::dvec3& sun : {glm::dvec3{0.5, -1, -0.35}, glm::dvec3{0.8, -0.3, 0.45},
                                glm::dvec3{-0.1, -1, 0.1}, glm::dvec3{0.2, -0.5, -1.0}}) {
    const ShadowPlan plan = street.plan(DirectionalLight{sun}, warps::none);
    for (const BiasWay way : {BiasWay::rasterizer, BiasWay::normal_offset}) {
      for (const double radius : {0.0, 1.0, 3.0}) {
        const auto found = kinds(judged(street.capture(plan, sun, way, radius)));
        EXPECT_THAT(found, testing::Not(testing::Contains("bias_small"))) << sun.x << " " << radius;
        EXPECT_THAT(found, testing::Not(testing::Contains("bias_large"))) << sun.x << " " << radius;
      }
    }
  }
}

TEST(EngineBias, halved_is_too_small) {
  const Street street;
  const glm::dvec3 sun{0.5, -1, -0.35};
  const ShadowPlan plan = street.plan(DirectionalLight{sun}, warps::none);
  for (const BiasWay way : {BiasWay::rasterizer, BiasWay::normal_offset}) {
    Json capture = street.capture(plan, sun, way, 1.0);
    for_each_map(capture, [](Json& map, std::size_t) {
      for (Json& value : map["bias"]) value = 0.4 * value.get<double>();
    });
    EXPECT_THAT(kinds(judged(capture)), testing::Contains("bias_small"));
  }
}

TEST(EngineBias, counts_a_rasterizers_steps) {
  EXPECT_DOUBLE_EQ(rasterizer_units(1.0 / 65536.0, 16), 1.0);
  EXPECT_DOUBLE_EQ(rasterizer_units(3.0 / (1 << 24), 24), 3.0);
  EXPECT_DOUBLE_EQ(rasterizer_units(1.0 / (1 << 24), 0), 1.0);
}

TEST(EngineBias, of_a_map_without_depths_is_nothing) {
  const EngineBias bias = engine_bias(ShadowMap{}, {}, BiasWay::normal_offset, 1.0);
  EXPECT_EQ(bias.depth, 0.0);
  EXPECT_EQ(bias.normal_world, 0.0);
}

}  // namespace
}  // namespace gnomon::judge::test
