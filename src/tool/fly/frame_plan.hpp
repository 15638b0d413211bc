// The plan of one frame of a flight, with what the options look at besides the camera.
#pragma once

#include "flight.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/view.hpp"

namespace gnomon::tool::fly {

/// The view depths that the camera sees, found by drawing its surfaces and no map, or by a coarse pass; empty
/// where the options do not ask for them, which plans take for unknown.
[[nodiscard]] VisibleDepths frame_depths(const Options& options, const Flight& flight,
                                         render::Renderer& renderer, const render::PreparedFilter& filter,
                                         const Camera& camera);

/// By the history where the options ask for one, which is taken one frame further.
[[nodiscard]] ShadowPlan plan_frame(const Options& options, const Flight& flight, const Light& light,
                                    const Camera& camera, const VisibleDepths& depths, PlanHistory& history);

}  // namespace gnomon::tool::fly
