// The maps of a spot or point light.
#pragma once

#include "map/context.hpp"

namespace gnomon {

/// Plans a spot or point light; the input is valid. Writes status, maps and omissions. `history` may be
/// nullptr.
void plan_local(const PlanContext& c, const Light& light, const Resolved& resolved, PlanHistory* history,
                ShadowPlan& plan) noexcept;

}  // namespace gnomon
