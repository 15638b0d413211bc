// One plan for several cameras that look at one scene: both eyes of a headset, split screen, probes.
#pragma once

#include <span>

#include "gnomon/plan.hpp"

namespace gnomon {

inline constexpr int kMaxViews =
    8;  ///< cameras of one plan: the two eyes, four players, or a probe's six faces

/// Chooses the shadow maps that all cameras share. A cascade holds the receivers that any camera sees between
/// its depths, each by its own view depth. Errors count for the camera that sees them largest: m_s_max,
/// m_t_max, m_max and storage of a map are the largest over the cameras.
///
/// Points find their map by what the maps hold (ShadowPlan::select_by_map and select_finest are set), so that
/// all cameras read the same texels for one point. clip_from_camera_relative is relative to
/// ShadowPlan::origin_world, the mean of the eyes: shaders take points relative to it, or each camera takes
/// rebased(map, its position).
///
/// Cameras that see no receiver are omitted, and listed as OmissionKind::view_without_receiver. One camera:
/// the plan of make_plan with MapSelection::finest. SplitScheme::optimal is logarithmic, pseudo_near and the
/// warp's axis are those of the mean view, and Partition::view_depth is the only one. Fit::stable serves
/// directional lights only where the cameras keep their places to each other.
/// Pure, allocates nothing, never throws. More than kMaxViews cameras, none, perspective mixed with
/// orthographic ones, or a broken one: PlanStatus::invalid_input with the field `cameras`, or as make_plan.
[[nodiscard]] ShadowPlan plan_views(std::span<const Camera> cameras, const Light& light,
                                    const SceneBounds& bounds, const PlanOptions& options = {}) noexcept;

}  // namespace gnomon
