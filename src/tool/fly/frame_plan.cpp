// The plan of one frame of a flight, with what the options look at besides the camera.
#include "frame_plan.hpp"

#include "gnomon/scene/coarse_view.hpp"
#include "plan_option.hpp"

namespace gnomon::tool::fly {
namespace {

/// The view depths of the frame last drawn.
VisibleDepths depths_shown(const render::Renderer& renderer) {
  const FloatImage positions = renderer.positions();
  const auto channels = static_cast<std::size_t>(positions.channels);
  VisibleDepths depths;
  // The last of the channels x, y, z, depth; 0 for the sky.
  for (std::size_t i = channels - 1; i < positions.values.size(); i += channels)
    depths.add(static_cast<double>(positions.values[i]));
  return depths;
}

}  // namespace

VisibleDepths frame_depths(const Options& options, const Flight& flight, render::Renderer& renderer,
                           const render::PreparedFilter& filter, const Camera& camera) {
  if (options.coarse_depths) return CoarseView().depths(flight.scene, camera);
  if (!options.visible_depths) return {};
  render::FrameOptions surfaces;
  surfaces.aliasing = surfaces.heat_map = surfaces.cascade_tint = surfaces.time_passes = false;
  renderer.draw(ShadowPlan{}, camera, filter, surfaces);
  return depths_shown(renderer);
}

ShadowPlan plan_frame(const Options& options, const Flight& flight, const Light& light, const Camera& camera,
                      const VisibleDepths& depths, PlanHistory& history) {
  const bool keeps = options.history || needs_history(options.plan.fit);
  return make_plan({camera, &depths}, light, flight.bounds(), options.plan, keeps ? &history : nullptr);
}

}  // namespace gnomon::tool::fly
