// A scene with the boxes, the light and the cameras that it is planned for.
#include "scene_view.hpp"

#include "edit_words.hpp"
#include "gnomon/scene/caster_work.hpp"

namespace gnomon::tool {
namespace {

constexpr double kFlightSeconds = 10.0, kViewerHz = 60.0;

double time_of(int frame, int frames) noexcept {
  return (frame + 0.5) / frames;
}

}  // namespace

SceneView::SceneView(const std::string& scene, const LightPlacement& light, const CameraWords& camera,
                     const LoadLimits& limits, const SceneEdits& edits)
    : scene_(load_edited(scene, limits, edits)),
      path_(camera_path(camera, scene_)),
      work_(caster_work(scene_)),
      boxes_(scene_),
      light_(default_light(light, scene_.bounds_world)) {}

void SceneView::take(const Pose& pose) {
  apply_pose(pose, scene_);
  for (const PosedInstance& posed : pose.instances) boxes_.place(posed.instance, posed.bounds_world);
}

Camera SceneView::camera(int frame, int frames, int width, int height) const noexcept {
  return path_.at(time_of(frame, frames), width, height);
}

Camera SceneView::camera_before(int frame, int frames, int width, int height) const noexcept {
  return path_.at(time_of(frame, frames) - 1.0 / (kFlightSeconds * kViewerHz), width, height);
}

}  // namespace gnomon::tool
