// The shadow of one frame looked up at the points of the next.
#pragma once

#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"

namespace gnomon::tool {

/// The plan of the camera `before` as a renderer may draw it with the camera `after`: the same maps over the
/// same parts of the world, their depths moved along with the eye. That the view turns in between is
/// neglected for the depths at which one map ends and the next begins.
[[nodiscard]] ShadowPlan moved_eye(ShadowPlan plan, const Camera& before, const Camera& after) noexcept;

}  // namespace gnomon::tool
