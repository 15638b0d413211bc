// Scenes of panes over a box, plans for them, and what rays through the panes say of the light behind.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "gnomon/trace/transmittance.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {

class Panes : public testing::Test {
 protected:
  void SetUp() override { (void)shared_context(); }
};

inline Material glass(const glm::vec3& color, float transmission) {
  Material material;
  material.base_color = glm::vec4(color, 1.0f);
  material.transmission = transmission;
  return material;
}

inline Material smoke(float alpha) {
  Material material;
  material.alpha_mode = AlphaMode::blend;
  material.base_color = glm::vec4(1.0f, 1.0f, 1.0f, alpha);
  return material;
}

/// Level panes over the ground of box_on_ground, some above the others.
inline Scene panes_over_ground(int count) {
  Scene scene = empty_scene();
  const glm::vec3 tints[] = {{0.9f, 0.2f, 0.1f}, {0.2f, 0.8f, 0.3f}, {0.3f, 0.4f, 1.0f}, {0.9f, 0.8f, 0.3f}};
  for (int i = 0; i < count; ++i) {
    const int material =
        i == 3 ? add_material(scene, smoke(0.4f)) : add_material(scene, glass(tints[i], 0.8f));
    const float x = -3.0f + static_cast<float>(i), y = 3.0f + 0.7f * static_cast<float>(i);
    add_quad(scene, {x, y, 3.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, material);
  }
  return scene;
}

struct Judged {
  double mean = 0.0, worst_inside = 0.0;
  std::size_t coloured = 0;
};

/// Boxes of both parts, which plans take as casters.
inline std::vector<Box> all_boxes(const Scene& opaque, const Scene& panes) {
  std::vector<Box> boxes = boxes_of(opaque);
  for (const Box& box : boxes_of(panes)) boxes.push_back(box);
  return boxes;
}

inline FrameOptions plain_options() {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  return options;
}

/// The last frame's image against rays. Pixels whose neighbours, as far as a texel is wide, differ in truth
/// are edges, and count in the mean alone.
inline Judged judged(const Renderer& renderer, const Camera& camera, const Scene& opaque, const Scene& panes,
                     const Light& light) {
  const FloatImage image = renderer.transmittance();
  const trace::Tracer tracer(opaque);
  const trace::SurfacePoints points =
      trace::surface_points(tracer, camera, light, renderer.positions(), renderer.normals());
  const trace::PaneReference truth = trace::pane_reference(trace::PaneTracer(panes), points, light);
  Judged result;
  std::size_t counted = 0;
  for (int y = 2; y + 2 < kSize; ++y)
    for (int x = 2; x + 2 < kSize; ++x) {
      const auto i = static_cast<std::size_t>(y * kSize + x);
      if (points.pixels[i].state != trace::PixelState::facing) continue;
      const glm::dvec3 found(image.values[3 * i], image.values[3 * i + 1], image.values[3 * i + 2]);
      const glm::dvec3 off = glm::abs(found - truth.pixels[i]);
      const double error = (off.x + off.y + off.z) / 3.0;
      result.mean += error;
      ++counted;
      result.coloured += truth.pixels[i] != glm::dvec3(1.0) ? 1 : 0;
      bool edge = false;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
          const auto j = static_cast<std::size_t>((y + dy) * kSize + x + dx);
          edge = edge || points.pixels[j].state != trace::PixelState::facing ||
                 truth.pixels[j] != truth.pixels[i];
        }
      if (!edge) result.worst_inside = std::max(result.worst_inside, error);
    }
  result.mean /= static_cast<double>(counted);
  return result;
}

inline Judged judged(const Scene& opaque, const Scene& panes, const Light& light, const PlanOptions& options,
                     bool panes_are_casters = true) {
  const Camera camera = camera_on_box(kSize, kSize);
  const std::vector<Box> boxes = panes_are_casters ? all_boxes(opaque, panes) : boxes_of(opaque);
  Renderer renderer(opaque);
  renderer.add_panes(panes);
  const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, options);
  EXPECT_EQ(plan.status, PlanStatus::ok);
  (void)draw(renderer, camera, plan, filters::hard);
  return judged(renderer, camera, opaque, panes, light);
}

inline PlanOptions plan_options(const char* warp, int cascades) {
  PlanOptions options;
  options.resolution.max_size = 512;
  options.cascades = cascades;
  options.warp.warp = find_warp(warp);
  set_margin(default_settings(filters::hard), options);
  return options;
}

/// A weak sun, a spot and point lights over a box, some of them where no pane is.
struct ManyLights {
  Scene opaque = box_on_ground(), panes = panes_over_ground(3);
  Camera camera = camera_on_box(kSize, kSize);
  std::vector<Box> boxes = all_boxes(opaque, panes);
  std::vector<LightRequest> requests{{DirectionalLight{kSlant}},
                                     {SpotLight{{-2, 8, 3}, {0.3, -1, -0.3}, 0.6, 20.0}},
                                     {PointLight{{1.0, 7.5, 0.5}, 12.0}},
                                     {PointLight{{4.0, 1.0, 2.0}, 2.0}},
                                     {PointLight{{-6.0, 1.5, 2.0}, 2.5}}};
  std::vector<std::byte> memory = std::vector<std::byte>(light_memory(requests.size(), 0));
  LightPlan plan;
  std::vector<ShadowPlan> own;

  ManyLights() {
    LightOptions pool;
    pool.plan = plan_options("none", 1);
    pool.pool_width = pool.pool_height = 2048;
    pool.most_size = 512;
    pool.least_size = 256;
    plan = plan_lights(camera, requests, {boxes, boxes}, pool, memory);
    for (std::size_t i = 0; i < requests.size(); ++i)
      own.push_back(
          make_plan(camera, requests[i].light, {boxes, boxes}, light_options(pool, plan.lights[i])));
  }
  /// The sum of all lights, or of one alone.
  FloatImage sum(Renderer& renderer, int only, const ClusterOptions& clusters, FrameStats* stats = nullptr) {
    std::vector<DrawnLight> lights;
    for (std::size_t i = 0; i < requests.size(); ++i)
      lights.push_back(
          {requests[i].light, &own[i], glm::vec3(only < 0 || only == static_cast<int>(i) ? 0.5f : 0.0f)});
    FrameOptions frame = plain_options();
    frame.light_clusters = clusters;
    const FrameStats drawn =
        renderer.draw({plan, lights}, camera, renderer.prepare(filters::hard, Source::lights), frame);
    if (stats != nullptr) *stats = drawn;
    return renderer.light_sum();
  }
};

}  // namespace gnomon::render
