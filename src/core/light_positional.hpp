// What the maps of a light with a position share.
#pragma once

#include "gnomon/plan.hpp"
#include "plan_budget.hpp"
#include "slope_error.hpp"

namespace gnomon {

/// A light with a position and the receivers that it can light and the camera sees, relative to the camera.
struct PositionalLight {
  glm::dvec3 apex;
  double range;
  Polytope lit;          // receivers in view within range, before any frustum of the light cuts them
  const Camera& camera;  // with its position at the origin
  CameraAxes axes;
  glm::dvec3 eye_world;  // what all positions are relative to
  const SceneBounds& bounds;
  const PlanOptions& options;
  MapSizes sizes;
  double prune_m = 0.0;  // maps become as small as this bound of m lets them; 0: they keep their size
};

/// Lays one map round `body`, the part of light.lit inside `frustum` (not empty, in front of the light), and
/// fills in the record. A cube's faces must meet, and so are not turned along the view. False where no caster
/// can reach the body; of a cube, only where PruneRule::casterless_faces is on.
[[nodiscard]] bool lay_positional_map(const PositionalLight& light, const LightFrustum& frustum,
                                      const Polytope& body, bool in_cube, ShadowPlan& plan,
                                      ShadowMap& map) noexcept;

/// Plans a spot or point light; the input is valid. Writes status, maps and omissions. `prune_m`: as
/// PositionalLight's.
void plan_positional(const Camera& camera, const Light& light, const SceneBounds& bounds,
                     const PlanOptions& options, double prune_m, ShadowPlan& plan) noexcept;

/// Nearest distance from a positional light that its maps show, over the farthest: less, and depth loses its
/// precision to the first step away from the light.
inline constexpr double kNearestShare = 1e-4;

}  // namespace gnomon
