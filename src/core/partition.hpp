// Lays maps for parts of the receivers that depth does not divide.
#pragma once

#include "plan_context.hpp"

namespace gnomon {

/// Divides what of `in_view` (relative to the camera) is between the view depths `begin` and `end` as the
/// options ask, and lays a map for each part; needs a partition other than view_depth and a fit other than
/// stable.
void plan_parts(const PlanContext& c, const Polytope& in_view, double begin, double end) noexcept;

}  // namespace gnomon
