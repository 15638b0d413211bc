// The maps of parallel light along the view: edges, bodies, requests.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "map/context.hpp"
#include "plan/budget.hpp"
#include "plan/merge.hpp"
#include "split/visible_depths.hpp"

namespace gnomon {

struct PlaneMaps;

/// Parallel light and the receivers in view.
struct ParallelScene {
  const Polytope& body;  // everything in view that receives, relative to the camera
  DepthRange depths;     // of the body
  LightSpace space;
  const Warp& warp;                   // the one asked for, or the default
  const PlaneMaps* planes = nullptr;  // maps that serve receivers before any cascade; nullptr: there are none
};

/// The view depths of a body.
[[nodiscard]] DepthRange depths_of(const Polytope& body, const glm::dvec3& forward) noexcept;

/// True where receivers up to the view depth `end` are better cut from their own part of the frustum than
/// from one that goes on to `far`.
[[nodiscard]] bool cut_from_afar(const PlanContext& c, double far, double end) noexcept;

/// The edges between the cascades, with the depths that no cascade covers.
struct CascadeEdges {
  std::array<double, kMaxMaps + 1> depth{};
  int count = 0;                   // of edges: one more than cascades
  std::uint32_t left_to_next = 0;  // bit i: cascade i has no map, and the next one begins where it did
  std::array<Omission, 4> omission;
  int omission_count = 0;
  [[nodiscard]] std::span<const double> edges() const noexcept {
    return {depth.data(), static_cast<std::size_t>(count)};
  }
};
/// With a history from the last frame's on, in small steps; nullptr: there is none.
[[nodiscard]] CascadeEdges cascade_edges(const PlanContext& c, const ParallelScene& scene, int cascades,
                                         PlanHistory* history) noexcept;

/// The visible depths, where they say something about this camera and these receivers; nullptr: unknown.
[[nodiscard]] const VisibleDepths* usable_depths(const PlanContext& c, const DepthRange& body,
                                                 const VisibleDepths* visible) noexcept;

/// Cuts `body`, relative to the camera, across the light to the bounds of the visible points between two view
/// depths, with room on every side (kPointSafety). Leaves it as it is where there are none, or none in it.
void clip_to_points(const PlanContext& c, const LightFrame& frame, double begin, double end,
                    Polytope& body) noexcept;

/// Replaces the plan's maps by so many cascades.
void plan_cascades(const PlanContext& c, const ParallelScene& scene, int cascades, const MapSizes& sizes,
                   PlanHistory* history, ShadowPlan& plan) noexcept;

/// As many cascades, as large, as resolution.max_error or the texel budget asks for. `square`: sides that
/// share a budget are equal.
void plan_within(const PlanContext& c, const ParallelScene& scene, bool square, PlanHistory* history,
                 ShadowPlan& plan) noexcept;

/// A request without a map of the last frame, for comparing warps and partitions.
[[nodiscard]] MapRequest request_for(const ParallelScene& scene, const Polytope& body, double begin,
                                     double end) noexcept;

}  // namespace gnomon
