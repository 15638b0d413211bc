// Groups of receivers that get maps of their own.
#pragma once

#include "plan/part.hpp"

namespace gnomon {

/// Divides the body, whose view depths lie in [begin, end], into at most PlanOptions::cascades clusters; one
/// where no division lowers the objective of unwarped maps.
[[nodiscard]] Parts receiver_clusters(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                                      double begin, double end) noexcept;

}  // namespace gnomon
