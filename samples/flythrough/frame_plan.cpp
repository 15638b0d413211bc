// The plan of one frame of a flight, with what the options look at besides the camera.
#include "frame_plan.hpp"

namespace flythrough {
namespace {

/// The view depths of the frame last drawn.
gnomon::VisibleDepths depths_shown(const gnomon::render::Renderer& renderer) {
  const gnomon::FloatImage positions = renderer.positions();
  const auto channels = static_cast<std::size_t>(positions.channels);
  gnomon::VisibleDepths depths;
  // The last of the channels x, y, z, depth; 0 for the sky.
  for (std::size_t i = channels - 1; i < positions.values.size(); i += channels)
    depths.add(static_cast<double>(positions.values[i]));
  return depths;
}

}  // namespace

gnomon::PlanOptions frame_options(const Options& options, gnomon::render::Renderer& renderer,
                                  const gnomon::render::PreparedFilter& filter, const gnomon::Camera& camera,
                                  gnomon::VisibleDepths& depths) {
  gnomon::PlanOptions plan = options.plan;
  if (!options.visible_depths) return plan;
  gnomon::render::FrameOptions surfaces;
  surfaces.aliasing = surfaces.heat_map = surfaces.cascade_tint = surfaces.time_passes = false;
  renderer.draw(gnomon::ShadowPlan{}, camera, filter, surfaces);
  depths = depths_shown(renderer);
  plan.visible_depths = &depths;
  return plan;
}

gnomon::ShadowPlan plan_frame(const Options& options, const Flight& flight, const gnomon::Light& light,
                              const gnomon::Camera& camera, const gnomon::PlanOptions& plan,
                              gnomon::PlanHistory& history) {
  return options.history ? gnomon::make_plan(camera, light, flight.bounds(), plan, history)
                         : gnomon::make_plan(camera, light, flight.bounds(), plan);
}

}  // namespace flythrough
