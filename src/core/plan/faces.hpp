// Maps for the faces of the camera's frustum.
#pragma once

#include "plan/part.hpp"

namespace gnomon {

/// Divides the body, whose view depths lie in [begin, end], among the faces that the light enters a
/// perspective camera's frustum by, or leaves it by, whichever set has the lower objective, and each side
/// face into at most SplitOptions::face_slices.
[[nodiscard]] Parts frustum_faces(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                                  double begin, double end) noexcept;

}  // namespace gnomon
