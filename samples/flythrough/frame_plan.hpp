// The plan of one frame of a flight, with what the options look at besides the camera.
#pragma once

#include "flight.hpp"
#include "gnomon/history.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/visible_depths.hpp"

namespace flythrough {

/// PlanOptions of this frame: where the options ask for visible depths, those that the camera sees, found by
/// drawing its surfaces and no map. `depths` must outlive what is answered.
[[nodiscard]] gnomon::PlanOptions frame_options(const Options& options, gnomon::render::Renderer& renderer,
                                                const gnomon::render::PreparedFilter& filter,
                                                const gnomon::Camera& camera, gnomon::VisibleDepths& depths);

/// By the history where the options ask for one, which is taken one frame further.
[[nodiscard]] gnomon::ShadowPlan plan_frame(const Options& options, const Flight& flight,
                                            const gnomon::Light& light, const gnomon::Camera& camera,
                                            const gnomon::PlanOptions& plan, gnomon::PlanHistory& history);

}  // namespace flythrough
