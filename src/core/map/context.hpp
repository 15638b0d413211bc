// What the stages that make maps read and return: const input, plain results.
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <new>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/plan.hpp"
#include "resolve/resolve.hpp"

namespace gnomon {

struct HeldDepths;

/// One of several cameras that share the maps.
struct SharedView {
  Camera camera;
  CameraAxes axes;
  glm::dvec3 eye;  // relative to the plan's origin, as the body
  Polytope body;   // the receivers in its view

  [[nodiscard]] double depth(const glm::dvec3& point) const noexcept {
    return glm::dot(axes.forward, point - eye);
  }
};

/// A point of a body and its view depth, for the camera that sees it.
struct ViewedPoint {
  glm::dvec3 position;
  double depth;
};

/// The input of make_plan, as it was resolved, with what all maps derive from it.
struct PlanContext {
  const Camera& camera;
  const SceneBounds& bounds;
  const PlanOptions& options;  // of Resolved
  CameraAxes axes;
  Conduct how = {};
  const VisibleDepths* visible_depths = nullptr;    // where they are usable; nullptr: unknown
  std::span<const glm::dvec3> visible_points = {};  // world space; empty: unknown
  std::span<const glm::dvec3> seen = {};  // of Objective::picture, relative to the camera; empty: unknown
  const HeldDepths* held = nullptr;       // of Objective::p95 and max, as WarpInput::held
  double caster_reach = 0.0;              // of casters from the camera along any axis, for Objective::picture
  double nearest_receiver = 0.0;  // no receiver in view has a smaller view depth, for the other objectives
  Box receivers = {};             // of Fit::stable: bounds of all, in view or not, world space
  bool same_light = false;        // as in the last frame, to the last bit
  std::span<const SharedView> views = {};  // cameras that share the maps; empty: `camera` alone
  const PlanHistory* history = nullptr;    // its camera is the last frame's until the plan is made
};

/// What is decided of a map before it is fitted.
struct MapSlot {
  int cascade = 0, width = 0, height = 0;
  double depth_begin = 0.0, depth_end = 0.0, overlap = 0.0;
  std::array<Plane, kMaxSelectPlanes> select{};  // relative to the camera
  int select_count = 0;
};

/// Where a local light's frustum begins, and how many boxes of receivers reach nearer.
struct NearCut {
  double distance = 0.0;
  int boxes = 0;
};
[[nodiscard]] constexpr Omission near_receivers(const NearCut& cut, int map) noexcept {
  return {OmissionKind::receiver_near_light, map, cut.distance, static_cast<double>(cut.boxes), 0};
}

/// One map to be fitted round `body`: the visible receivers of one slice, face or cone, relative to the
/// camera, not empty, and in front of a local light.
struct MapRequest {
  MapSlot slot;
  const Polytope& body;
  LightSpace space;
  const Warp& warp;
  double begin, end;                       // view depths of the slice, blend band included
  WarpChoice unwarped;                     // the map to make without a warp
  double centre = 0.0;                     // as WarpInput::centre
  double slope = 0.0;                      // local light: the frustum is |x| <= slope, |y| <= slope
  double range = 0.0;                      // local light: beyond it nothing is lit
  bool without_casters = false;            // make the map even where no caster can reach the body
  const PlanHistory::Map* last = nullptr;  // of the last frame and the same light
  // Receivers of all maps, of which this one serves what it holds (MapSelection::finest); nullptr: `body`
  // alone.
  const Polytope* all_receivers = nullptr;
  double room = 0.0;  // of the body round the slice's frustum, world units: the map is cached over frames
  const Plane* receiver = nullptr;  // as WarpInput::receiver, relative to the camera and in world axes
  std::span<const ViewedPoint> viewed = {};  // of several views, for the body's vertices; empty: one view
  NearCut near_cut = {};                     // local light: in front of the body
  glm::dvec3 apex_world{0.0};                // local light: its position, with the bits of the input
};

/// One map, and what happened while it was fitted. The map's record is made where it will stay: records are
/// long to copy.
struct MapResult {
  ShadowMap& map;
  bool drawn = false;  // false: no caster can reach the body
  glm::dmat4 gl_from_world{1.0};
  PlanHistory::SearchedWarp searched;
  std::array<Omission, 5> omission;
  int omission_count = 0;
  bool has_event = false;
  PlanEvent event;

  explicit MapResult(ShadowMap& at) noexcept : map(*::new (static_cast<void*>(&at)) ShadowMap) {}
  MapResult(const MapResult&) = delete;
  MapResult& operator=(const MapResult&) = delete;
  [[nodiscard]] std::span<const Omission> omissions() const noexcept {
    return {omission.data(), static_cast<std::size_t>(omission_count)};
  }
  void omit(const Omission& o) noexcept {
    if (omission_count < static_cast<int>(omission.size()))
      omission[static_cast<std::size_t>(omission_count++)] = o;
  }
  void report(PlanEventKind kind, double ratio) noexcept {
    has_event = true;
    event = {kind, map.cascade, ratio};
  }
};

/// The smallest map round the body, warped where that gains; with a history the steady way there.
void focused_map(const PlanContext& c, const MapRequest& request, MapResult& result) noexcept;
/// Parallel light: a map whose texel grid does not move with the camera.
void stable_map(const PlanContext& c, const MapRequest& request, MapResult& result) noexcept;
/// Whether a stable map of both slices has the very texels that a map of each of them alone has: where its
/// sides span the bounds, not the slices. For one view without room.
[[nodiscard]] bool stable_map_serves_both(const PlanContext& c, const LightFrame& frame, double begin,
                                          double middle, double end) noexcept;

}  // namespace gnomon
