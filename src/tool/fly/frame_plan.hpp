// The plan of one frame of a flight, with what the options look at besides the camera.
#pragma once

#include "flight.hpp"
#include "gnomon/history.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/visible_depths.hpp"

namespace gnomon::tool::fly {

/// PlanOptions of this frame: where the options ask for visible depths, those that the camera sees, found by
/// drawing its surfaces and no map. `depths` must outlive what is answered.
[[nodiscard]] PlanOptions frame_options(const Options& options, render::Renderer& renderer,
                                        const render::PreparedFilter& filter, const Camera& camera,
                                        VisibleDepths& depths);

/// By the history where the options ask for one, which is taken one frame further.
[[nodiscard]] ShadowPlan plan_frame(const Options& options, const Flight& flight, const Light& light,
                                    const Camera& camera, const PlanOptions& plan, PlanHistory& history);

}  // namespace gnomon::tool::fly
