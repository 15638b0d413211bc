// What the stages of a plan share.
#pragma once

#include <cstdint>

#include "gnomon/history.hpp"
#include "gnomon/plan.hpp"
#include "light_frame.hpp"
#include "light_map.hpp"

namespace gnomon {

/// The input of make_plan with what all cascades derive from it, and the plan being written.
struct PlanContext {
  const Camera& camera;
  const SceneBounds& bounds;
  const PlanOptions& options;
  CameraAxes axes;
  glm::dvec3 light_direction;  // unit
  LightFrame frame;
  bool stable;
  const Warp& warp;  // the one asked for, or the default
  double sin_gamma, cos_gamma;
  ShadowPlan& plan;
  PlanHistory* history;                 // nullptr: every frame stands for itself
  const VisibleDepths* seen = nullptr;  // of the options, where they say something; nullptr: unknown
  double prune_m = 0.0;  // maps become as small as this bound of m lets them; 0: they keep their size
};

void omit(ShadowPlan& plan, const Omission& omission) noexcept;

/// Lays one map round `body`, the receivers in view of one slice (relative to the camera, not empty), and
/// fills in the record; false where no caster can reach the body. `begin` and `end` are the slice's view
/// depths.
[[nodiscard]] bool lay_tight_map(const PlanContext& c, const Polytope& body, double begin, double end,
                                 ShadowMap& map) noexcept;
[[nodiscard]] bool lay_stable_map(const PlanContext& c, const Polytope& body, double begin, double end,
                                  ShadowMap& map) noexcept;

/// The plan's objective over that body under the warp that lay_tight_map would take, up to a factor that is
/// the same for all bodies.
[[nodiscard]] double tight_objective(const PlanContext& c, const Polytope& body, double begin,
                                     double end) noexcept;
/// The light plane under that warp.
[[nodiscard]] PlaneMap tight_plane(const PlanContext& c, const Polytope& body, double begin,
                                   double end) noexcept;

}  // namespace gnomon
