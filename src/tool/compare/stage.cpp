// One scene made ready to be measured: on the GPU, for rays, and with its cameras.
#include "stage.hpp"

namespace gnomon::tool {

Stage::Stage(const Sweep& sweep, const std::string& scene)
    : sweep_(sweep), view_(scene, sweep.light, limits_of_triangles(sweep.max_triangles)) {
  tracer_ = std::make_unique<trace::Tracer>(view_.scene());
  renderer_ = std::make_unique<render::Renderer>(view_.scene());
}

ShadowPlan Stage::plan(const SweepEntry& entry, const Camera& camera) const noexcept {
  return make_plan(camera, view_.light(), view_.bounds(), entry.plan);
}

Camera Stage::camera(int frame) const noexcept {
  return view_.camera(frame, sweep_.frames, sweep_.width, sweep_.height);
}

Camera Stage::camera_before(int frame) const noexcept {
  return view_.camera_before(frame, sweep_.frames, sweep_.width, sweep_.height);
}

}  // namespace gnomon::tool
