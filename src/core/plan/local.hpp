// The maps of a spot or point light.
#pragma once

#include "map/context.hpp"

namespace gnomon {

/// True where the faces of a cube show a spot's cone without a budget, false where one map does. The view has
/// no say: what a camera sees must not switch maps of a fixed size, and plan_lights shares budgets by it.
[[nodiscard]] bool shown_by_faces(const SpotLight& spot, const PlanOptions& options) noexcept;

/// Plans a spot or point light; the input is valid. Writes status, maps and omissions. `history` may be
/// nullptr.
void plan_local(const PlanContext& c, const Light& light, const Resolved& resolved, PlanHistory* history,
                ShadowPlan& plan) noexcept;

}  // namespace gnomon
