// Does any finite input make the core divide by zero, overflow, or compute something that is no number? Every
// such operation traps here, also one whose result is thrown away.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "gnomon/extend/shape.hpp"
#include "gnomon/study/bias.hpp"
#include "gnomon/study/expected_error.hpp"
#include "gnomon/study/log_perspective.hpp"
#include "support/float_traps.hpp"
#include "support/seeded_input.hpp"

namespace gnomon::test {
namespace {

/// Everything that a frame asks of the core, over memory that stands outside.
struct Frame {
  ShadowPlan plan;
  std::vector<std::uint32_t> list;
  double sink = 0.0;

  void work(const SeededInput& in, const glm::dvec3& normal) {
    plan = in.plan();
    if (plan.status == PlanStatus::invalid_input) return;
    const SceneBounds bounds = in.bounds();
    sink += measure(plan, in.camera, bounds, {6, 6, 6}).p95;
    if (const auto* light = std::get_if<DirectionalLight>(&in.light))
      sink += measure(log_perspective_map(in.camera, *light, bounds, 64), in.camera, bounds, {4, 4, 4}).p95;
    for (const ShadowMap& map : plan.maps()) {
      sink += static_cast<double>(cull_casters(map, in.casters, list));
      for (const Box& box : in.receivers) {
        if (box.empty()) continue;
        const glm::dvec3 p = 0.5 * box.min + 0.5 * box.max;
        sink += map_holds(plan, map, p) ? 1.0 : 0.0;
        // From a light with a position, rays go their own way at each point.
        const glm::dvec3 away = p * map.light_world.w - glm::dvec3(map.light_world);
        const double distance = std::sqrt(glm::dot(away, away));
        if (!(distance > 0.0)) continue;
        const Receiver receiver{map.clip_from_world, map.texels(), away / distance, p, normal};
        const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
        // What the map holds is what shaders ask about.
        if (!map_holds(plan, map, p) || !(clip.w > 0.0)) continue;
        sink += plane_bias_ndc(in.options.bias, receiver, 1.0) +
                plane_bias_world(in.options.bias, receiver, 1.0) + adaptive_bias_ndc(receiver, 1e-4) +
                normal_offset_world(in.options.bias, receiver, 1.0).x +
                measure_point(map, in.camera, p, normal).m_max;
      }
    }
    sink += pack_atlas(plan).efficiency + wrong_pixels(in);
  }

 private:
  /// A picture of eight by eight pixels: one of the receivers' depths in each, or none, and any shadow.
  [[nodiscard]] double wrong_pixels(const SeededInput& in) const {
    if (in.receivers.empty()) return 0.0;
    std::array<float, 64> mask, depths, distances;
    Camera camera = in.camera;
    camera.width = camera.height = 8;
    const CameraAxes axes = camera_axes(camera);
    for (std::size_t i = 0; i < mask.size(); ++i) {
      mask[i] = static_cast<float>(i * i % 7 < 3);
      const Box& box = in.receivers[i / 3 % in.receivers.size()];
      const double depth =
          box.empty() ? 0.0 : glm::dot(0.5 * box.min + 0.5 * box.max - camera.position, axes.forward);
      depths[i] = std::abs(depth) < 1e37 ? static_cast<float>(depth) : 0.0f;
      distances[i] = static_cast<float>(i * i % 5) - 1.0f;
    }
    std::array<glm::dvec3, 8> edges;
    return expected_error(plan, {camera, mask, depths}).wrong_pixels +
           expected_error(plan, {camera, mask, depths, distances}, 1.5).wrong_pixels +
           static_cast<double>(shadow_edge_points({camera, mask, depths}, edges));
  }
};

void expect_quiet(Extremes extremes, int cases) {
  Frame frame;
  frame.list.resize(64);
  SeededInput input;
  int planned = 0, shown = 0;
  for (int i = 0; i < cases; ++i) {
    seed_input(static_cast<std::uint64_t>(i) + 1, extremes, input);
    choose_picture(i, input);
    SeededNumbers random(static_cast<std::uint64_t>(i));
    const glm::dvec3 v = random.vector() + glm::dvec3(0, 1.5, 0);
    const glm::dvec3 normal = v / std::sqrt(glm::dot(v, v));
    if (!runs_without_trap([&] { frame.work(input, normal); })) {
      ADD_FAILURE() << "a floating-point trap in case " << i + 1;
      if (++shown == 20) return;
    }
    planned += frame.plan.status == PlanStatus::ok ? 1 : 0;
  }
  EXPECT_GT(planned, cases / 4);
}

TEST(FloatingPoint, the_traps_of_this_test_spring) {
  volatile double zero = 0.0, sink = 1.0;
  EXPECT_FALSE(runs_without_trap([&] { sink = 1.0 / zero; }));
  EXPECT_FALSE(runs_without_trap([&] { sink = zero / zero; }));
  EXPECT_FALSE(runs_without_trap([&] {
    sink = 1e300;
    sink = sink * sink;
  }));
  EXPECT_TRUE(runs_without_trap([&] { sink = 1.0 / 3.0; }));
}

TEST(FloatingPoint, no_ordinary_input_traps) {
  expect_quiet(Extremes::ordinary, 1500);
}

TEST(FloatingPoint, no_extreme_input_traps) {
  expect_quiet(Extremes::stiff, 3500);
}

}  // namespace
}  // namespace gnomon::test
