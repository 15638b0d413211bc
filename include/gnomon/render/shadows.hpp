// The plan that a frame is drawn from, of any kind.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <variant>

#include "gnomon/light.hpp"
#include "gnomon/lights.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"

namespace gnomon::render {

/// One light of a frame of many lights.
struct DrawnLight {
  Light light;  ///< the picture fades out at its cone and range
  /// The plan its maps were drawn by last: this frame's where they are due. nullptr, or no maps: no shadow.
  const ShadowPlan* plan = nullptr;
  glm::vec3 color{1.0f};  ///< brightness by channel, >= 0; 1: as bright as the sun of other frames
  /// For a local light. True: it has `color` at a distance of one world unit, and less by the square of the
  /// distance, as KHR_lights_punctual recommends. False: it has `color` at its place, and fades out towards
  /// its range.
  bool inverse_square = false;
};

/// The plan that Renderer::draw draws: it points to it, and owns nothing.
class Shadows {
 public:
  /// The maps of one light.
  Shadows(const ShadowPlan& plan) noexcept : plan_(&plan) {}
  /// The pages of one light.
  Shadows(const PagePlan& plan) noexcept : plan_(&plan) {}
  /// Many lights: `lights` has one for each light of the plan; fewer are drawn as far as they go.
  Shadows(const LightPlan& plan, std::span<const DrawnLight> lights) noexcept
      : plan_(&plan), lights_(lights) {}

  /// The maps of one light, nullptr where the plan is another.
  [[nodiscard]] const ShadowPlan* maps() const noexcept { return of<ShadowPlan>(); }
  /// The pages of one light, else nullptr.
  [[nodiscard]] const PagePlan* pages() const noexcept { return of<PagePlan>(); }
  /// Many lights, else nullptr.
  [[nodiscard]] const LightPlan* light_plan() const noexcept { return of<LightPlan>(); }
  /// The lights of a LightPlan, else none.
  [[nodiscard]] std::span<const DrawnLight> lights() const noexcept { return lights_; }

 private:
  template <class Plan>
  [[nodiscard]] const Plan* of() const noexcept {
    const Plan* const* plan = std::get_if<const Plan*>(&plan_);
    return plan != nullptr ? *plan : nullptr;
  }
  std::variant<const ShadowPlan*, const PagePlan*, const LightPlan*> plan_;
  std::span<const DrawnLight> lights_;
};

}  // namespace gnomon::render
