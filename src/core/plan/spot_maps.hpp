// One map of a spot's whole cone, or one for each face of a cube round it?
#pragma once

#include "map/context.hpp"
#include "plan/budget.hpp"

namespace gnomon {

/// True where the faces of a cube show a spot's cone without a budget, false where one map does. The view has
/// no say: what a camera sees must not switch maps of a fixed size, and plan_lights shares budgets by it.
[[nodiscard]] bool shown_by_faces(const SpotLight& spot, const PlanOptions& options) noexcept;

/// How the directions of a local light are divided among its maps.
enum class LocalMaps : std::uint8_t { cone, cube, tetrahedron };

/// Those that the light's angle and the options lead to, whatever is in view.
[[nodiscard]] LocalMaps maps_by_angle(const Light& light, const Resolved& resolved) noexcept;

/// True where the spot may have the other maps as well, if these have fewer misclassified pixels: it has a
/// budget that makes both cost the same texels, no history that they would have to be steady for, an angle
/// at which either may be better, and enough seen points in its light.
[[nodiscard]] bool weighs_both(const PlanContext& c, const SpotLight& spot,
                               const Resolved& resolved) noexcept;

/// The sum of m over the seen points that the spot lights, were the maps of `fitted` as large as `sizes`:
/// misclassified pixels go by it.
[[nodiscard]] double seen_error(const PlanContext& c, const SpotLight& spot, const ShadowPlan& fitted,
                                const MapSizes& sizes) noexcept;

}  // namespace gnomon
