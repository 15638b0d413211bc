// Maps for parts of the receivers that depth does not divide.
#pragma once

#include "plan/cascades.hpp"

namespace gnomon {

/// Divides the receivers in view as the options ask, and fits a map for each part; needs a partition other
/// than view_depth and a fit other than stable.
void plan_parts(const PlanContext& c, const ParallelScene& scene, ShadowPlan& plan) noexcept;

}  // namespace gnomon
