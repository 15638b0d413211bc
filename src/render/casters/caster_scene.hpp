// The scene that a renderer draws: what is on the GPU, what moves, and what each view of a frame draws of it.
#pragma once

#include <span>

#include "casters/draw_list.hpp"
#include "casters/moving_casters.hpp"
#include "casters/scene_buffers.hpp"
#include "gnomon/scene/pose.hpp"

namespace gnomon::render {

class PanePass;

struct CasterScene {
  explicit CasterScene(const Scene& scene) : buffers(scene), lists(buffers), movers(buffers) {}
  /// Places one instance elsewhere.
  void move(std::size_t instance, const Instance& to);
  /// Adds what the caller says has moved; casters are culled by where they are now.
  void take_moved(std::span<const Box> moved_world);
  /// Positions near the camera and near the origin of the plan's maps; matrices of these maps from there.
  [[nodiscard]] DrawnMaps place(const ShadowPlan& plan, const glm::dvec3& camera_world);

  SceneBuffers buffers;
  DrawLists lists;
  MovingCasters movers;
  Pose posed;  ///< the last one applied; empty: none, or instances moved since
};

/// As Renderer::apply_pose.
[[nodiscard]] bool apply_pose(const Pose& pose, CasterScene& casters);
/// As Renderer::apply_pane_pose; `last`: the pose before, which becomes this one.
[[nodiscard]] bool apply_pose(const Pose& pose, Pose& last, PanePass& panes);

}  // namespace gnomon::render
