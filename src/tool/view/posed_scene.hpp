// The scene as its animation poses it: for the renderer, for plans and for rays.
#pragma once

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/pose.hpp"
#include "gnomon/scene/shadow_boxes.hpp"
#include "gnomon/trace/tracer.hpp"
#include "state.hpp"

namespace gnomon::tool::view {

class PosedScene {
 public:
  /// Begins to sort the triangles for rays in the background. `boxes`: of the scene's instances at rest, and
  /// of things beside it that cast.
  PosedScene(std::shared_ptr<const Scene> scene, ShadowBoxes boxes);

  /// Poses the scene and the renderer that holds it as the state says. Returns what is wrong with that, or an
  /// empty text. `moved`: whether anything stands elsewhere than before.
  std::string follow(const Playing& playing, render::Renderer& renderer, bool& moved);
  /// Boxes of the instances as posed.
  [[nodiscard]] const std::vector<Box>& boxes() const noexcept { return boxes_.all(); }
  /// Those that cast, and those that receive.
  [[nodiscard]] SceneBounds bounds() const noexcept { return boxes_.bounds(); }

  /// Begins to sort the triangles of the present pose, where that is not done or going on.
  void begin_tracer();
  /// Takes what the background has finished; `wait`: and finishes the present pose.
  void take_tracer(bool wait);
  /// Rays against the present pose; nullptr until its triangles are sorted.
  [[nodiscard]] const std::shared_ptr<const trace::Tracer>& tracer() const noexcept { return tracer_; }

 private:
  std::shared_ptr<const Scene> scene_;
  Pose pose_;  ///< the present one
  int animation_ = kRestPose;
  double time_s_ = 0.0;
  ShadowBoxes boxes_;
  int poses_ = 0;         ///< so far
  int sorting_pose_ = 0;  ///< that `sorting_` is of
  std::future<std::shared_ptr<const trace::Tracer>> sorting_;
  std::shared_ptr<const trace::Tracer> tracer_;
};

}  // namespace gnomon::tool::view
