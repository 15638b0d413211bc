// Many lights from frame to frame: what plan_lights keeps of them, and the plan of each light's maps.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gnomon/lights.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/shadows.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon::render {

/// One light of a pool: how it is planned, and how it shines.
struct PooledLight {
  LightRequest request;         ///< how it is planned
  glm::vec3 color{1.0f};        ///< as DrawnLight has it
  bool inverse_square = false;  ///< the same
  std::string name = {};        ///< for messages
};

/// The lights of the scene's file (KHR_lights_punctual) that shine, in its order: those whose colour or
/// intensity is 0 are not among them. Colors are the file's, times intensity over the largest intensity, so
/// that lux and candela keep their proportion; exposure_of() makes them fit a picture. All weigh 1.
[[nodiscard]] std::vector<PooledLight> lights_of(const Scene& scene);

/// Lights whose shadow maps share one pool. Holds all memory that plan_lights writes to.
class LightPool {
 public:
  /// No maps are planned yet. `options`: of every frame's plan.
  LightPool(std::vector<PooledLight> lights, const LightOptions& options);
  LightPool(const LightPool&) = delete;
  LightPool& operator=(const LightPool&) = delete;

  /// Plans one frame: sizes and places of all maps by plan_lights, and by make_plan each light that is due.
  /// The last frame's plan is gone. For PlanStatus::invalid_input no light is planned.
  const LightPlan& plan(const View& view, const SceneBounds& bounds);

  /// The lights, in the order of every list here.
  [[nodiscard]] const std::vector<PooledLight>& lights() const noexcept { return lights_; }
  /// The plan of the last frame.
  [[nodiscard]] const LightPlan& last() const noexcept { return plan_; }
  /// The plan that each light's maps were drawn by last.
  [[nodiscard]] const std::vector<ShadowPlan>& plans() const noexcept { return plans_; }
  /// The lights for Renderer::draw, with `exposure` times their colors. They point to plans().
  [[nodiscard]] std::vector<DrawnLight> drawn(double exposure = 1.0) const;

 private:
  std::vector<PooledLight> lights_;
  LightOptions options_;
  std::vector<LightRequest> requests_;
  std::vector<ShadowPlan> plans_;
  std::vector<std::byte> memory_;
  std::vector<LightState> states_;
  LightHistory history_;
  LightPlan plan_;
};

/// The factor for the colors of all lights that makes their picture neither dark nor clipped. All but a
/// hundredth of the pixels that have light are then no brighter than a white surface in the sun of other
/// frames. `light_sum`: Renderer::light_sum() of a frame. 0 where no pixel has light.
[[nodiscard]] double exposure_of(const FloatImage& light_sum);

}  // namespace gnomon::render
