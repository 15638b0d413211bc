// Which part of the view does a light light, and which error would its maps have there?
#pragma once

#include <span>

#include "gnomon/extend/body.hpp"
#include "gnomon/lights.hpp"

namespace gnomon {

/// Working memory for one visible point.
struct LightPoint {
  float x, y, z;  ///< world space, from the eye, in a unit that all points share
  float pixel;    ///< 1 / the width of a pixel there, in the same unit
};

/// Everything that is the same for all lights.
struct LightView {
  const View& seen;  // far plane finite, without depths
  const SceneBounds& bounds;
  const PlanOptions& options;
  CameraAxes axes;
  const Polytope& body;  // the frustum, relative to the eye
  Box box;               // round it
  bool one_list;         // casters and receivers are the same boxes
  // Visible points relative to the eye in units of `unit`, a power of two; empty: unknown.
  std::span<const LightPoint> points;
  double unit;
  ShadowPlan* sun;  // where the plan of a sun is made: it is long
  int most_size;    // side of the largest maps, texels; `options` have that of the smallest
};
/// Fills `memory`, which holds as many as there are points, and `body`. `sun`: room for a plan. Refers to
/// `seen`.
[[nodiscard]] LightView light_view(const View& seen, const SceneBounds& bounds, const PlanOptions& options,
                                   std::span<LightPoint> memory, Polytope& body, ShadowPlan* sun,
                                   int most_size) noexcept;

/// The importance of one light.
struct LightImportance {
  LightOutcome outcome = LightOutcome::without_receiver;  // without maps, or mapped
  double share = 0.0;                                     // as LightMaps::share
  double demand = 0.0;  // texels along a side, border apart, for a mean m of 1
  int seen_maps = 0;    // that the view needs
  int all_maps = 0;     // that the light's whole range needs
};
[[nodiscard]] LightImportance importance_of(const LightView& view, const Light& light) noexcept;

}  // namespace gnomon
