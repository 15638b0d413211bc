// The plan of checked input, for one camera or for several that share it.
#pragma once

#include "map/shared_views.hpp"

namespace gnomon {

/// The plan that `views` share, all of which see receivers. `mean`: a camera in their middle, at the plan's
/// origin. No input is checked.
[[nodiscard]] ShadowPlan plan_shared(std::span<const SharedView> views, const Camera& mean,
                                     const Light& light, const SceneBounds& bounds,
                                     const PlanOptions& options) noexcept;

}  // namespace gnomon
