// One scene made ready to be measured: on the GPU, for rays, and with its cameras.
#include "stage.hpp"

#include "gnomon/scene/load.hpp"

namespace gnomon::tool {
namespace {

constexpr double kFlightSeconds = 10.0, kViewerHz = 60.0;

}  // namespace

Stage::Stage(const Sweep& sweep, const std::string& scene)
    : sweep_(sweep),
      scene_(load_scene(scene)),
      path_(default_path(scene_)),
      light_(default_light(sweep.light, scene_.bounds_world)) {
  for (const Instance& instance : scene_.instances) boxes_.push_back(instance.bounds_world);
  tracer_ = std::make_unique<trace::Tracer>(scene_);
  renderer_ = std::make_unique<render::Renderer>(scene_);
}

ShadowPlan Stage::plan(const SweepEntry& entry, const Camera& camera) const noexcept {
  return make_plan(camera, light_, {boxes_, boxes_}, entry.plan);
}

double Stage::time_of(int frame) const noexcept {
  // In the middle of equal parts of the flight: its ends are often at rest.
  return (frame + 0.5) / sweep_.frames;
}

Camera Stage::camera(int frame) const noexcept {
  return path_.at(time_of(frame), sweep_.width, sweep_.height);
}

Camera Stage::camera_before(int frame) const noexcept {
  return path_.at(time_of(frame) - 1.0 / (kFlightSeconds * kViewerHz), sweep_.width, sweep_.height);
}

}  // namespace gnomon::tool
