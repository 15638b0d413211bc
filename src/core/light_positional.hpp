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
};

/// Lays one map round `body`, the part of light.lit inside `frustum` (not empty, in front of the light), and
/// fills in the record. `whole` is what the frustum shows at most, as slopes. False where no caster can reach
/// the body.
[[nodiscard]] bool lay_positional_map(const PositionalLight& light, const LightFrustum& frustum,
                                      const Polytope& body, bool along_view, ShadowPlan& plan,
                                      ShadowMap& map) noexcept;

/// Plans a spot or point light; the input is valid. Writes status, maps and omissions.
void plan_positional(const Camera& camera, const Light& light, const SceneBounds& bounds,
                     const PlanOptions& options, ShadowPlan& plan) noexcept;

/// Nearest distance from a positional light that its maps show, over the farthest: less, and depth loses its
/// precision to the first step away from the light.
inline constexpr double kNearestShare = 1e-4;

}  // namespace gnomon
