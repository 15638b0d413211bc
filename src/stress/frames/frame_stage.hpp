// Everything that a random frame is drawn from: its scene as it stands at a step, its plan, its renderers.
#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "frame_setting.hpp"
#include "gnomon/lights.hpp"
#include "gnomon/scene/pose.hpp"
#include "gnomon/scene/shadow_boxes.hpp"
#include "gnomon/scene/translucent.hpp"

namespace gnomon::stress {

class FrameStage {
 public:
  /// Loads the scene. The context must be current. Throws CaseError and render::RenderError.
  explicit FrameStage(const nlohmann::ordered_json& frame);

  /// Takes the scene and the camera to the next step; the first call takes them to the first, which is at
  /// rest.
  void advance();
  /// Plans for the scene as it stands; false where the plan refuses it.
  bool plan();
  /// Draws the plan.
  render::FrameStats draw(render::Renderer& renderer, const render::FrameOptions& options) const;
  /// A renderer of the scene as it stands.
  [[nodiscard]] std::unique_ptr<render::Renderer> anew() const;

  [[nodiscard]] const FrameSetting& setting() const noexcept { return setting_; }
  [[nodiscard]] const Camera& camera() const noexcept { return camera_; }
  /// As it stands, without the panes that tint light.
  [[nodiscard]] const Scene& opaque() const noexcept { return parts_.opaque; }
  [[nodiscard]] const Scene& panes() const noexcept { return parts_.panes; }
  /// Keeps from step to step what the frame's rules let it keep.
  [[nodiscard]] render::Renderer& keeping() noexcept { return *keeping_; }
  /// Follows as well, and is used for frames that keep nothing.
  [[nodiscard]] render::Renderer& redrawing() noexcept { return *redrawing_; }
  /// The maps that the mask's channel "map" counts; of pages none.
  [[nodiscard]] const ShadowPlan& maps() const noexcept { return maps_; }
  [[nodiscard]] const PagePlan& pages() const noexcept { return pages_; }
  [[nodiscard]] bool by_pages() const noexcept { return setting_.source.kind == render::SourceKind::pages; }
  [[nodiscard]] std::string_view refused() const noexcept { return refused_; }
  /// Whether the scene's diagonal is within the same power of two as at rest.
  [[nodiscard]] bool same_scale() const noexcept;

 private:
  void move_instances();
  void pose_all();
  [[nodiscard]] std::vector<glm::dvec3> seen_points();
  bool plan_one_light(const View& view, const SceneBounds& bounds);
  bool plan_by_pages(const View& view, const SceneBounds& bounds);

  FrameSetting setting_;
  Scene rest_;
  TranslucentParts parts_;
  std::vector<char> moves_by_itself_;  ///< by instance of the opaque part
  std::unique_ptr<render::Renderer> keeping_, redrawing_;
  Camera camera_;
  ShadowBoxes boxes_;
  ShadowPlan maps_;
  PagePlan pages_;
  LightPlan lights_;
  std::vector<std::byte> memory_;
  std::string_view refused_;
  int step_ = -1;
};

}  // namespace gnomon::stress
