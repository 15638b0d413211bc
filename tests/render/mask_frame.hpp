// A frame with its shadow mask, drawn and read back: what the mask's tests look at.
#pragma once

#include <glm/geometric.hpp>

#include "gnomon/render/renderer.hpp"
#include "test_scene.hpp"

namespace gnomon::render {

inline constexpr int kSize = 160;
/// The weights of up to 100 texels, added in float, make up 1 to this.
inline constexpr float kWeightRounding = 100.0f * 6e-8f;
inline const glm::dvec3 kSlant = glm::normalize(glm::dvec3(0.5, -1.0, -0.3));

struct Frame {
  Camera camera;
  ShadowPlan plan;
  FloatImage mask, positions, normals;
  [[nodiscard]] std::size_t pixels() const { return mask.values.size() / 2; }
  [[nodiscard]] float lit(std::size_t i) const { return mask.values[2 * i]; }
  [[nodiscard]] int map(std::size_t i) const { return static_cast<int>(mask.values[2 * i + 1]); }
  [[nodiscard]] bool surface(std::size_t i) const { return normals.values[4 * i + 3] > 0.0f; }
  [[nodiscard]] glm::dvec3 point(std::size_t i) const {
    return camera.position +
           glm::dvec3(positions.values[4 * i], positions.values[4 * i + 1], positions.values[4 * i + 2]);
  }
  [[nodiscard]] glm::dvec3 normal(std::size_t i) const {
    return {normals.values[4 * i], normals.values[4 * i + 1], normals.values[4 * i + 2]};
  }
};

inline Frame draw(Renderer& renderer, const Camera& camera, const ShadowPlan& plan,
                  const FilterSettings& filter, FrameOptions options = {}) {
  options.aliasing = options.cascade_tint = options.time_passes = false;
  renderer.draw(plan, camera, renderer.prepare(filter), options);
  return {camera, plan, renderer.mask(), renderer.positions(), renderer.normals()};
}
inline Frame draw(Renderer& renderer, const Camera& camera, const ShadowPlan& plan, const Filter& filter) {
  return draw(renderer, camera, plan, default_settings(filter));
}

inline Frame draw_scene(const Scene& scene, const Camera& camera, const glm::dvec3& light,
                        const Filter& filter = filters::hard, PlanOptions options = {}) {
  options.resolution.max_size = 512;
  set_margin(default_settings(filter), options);
  Renderer renderer(scene);
  return draw(renderer, camera, plan_for(scene, camera, light, options), filter);
}

}  // namespace gnomon::render
