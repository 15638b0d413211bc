// A scene with the boxes, the light and the cameras that it is planned for.
#pragma once

#include <string>
#include <vector>

#include "camera_words.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/edit.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/scene/pose.hpp"
#include "gnomon/scene/scene.hpp"
#include "gnomon/scene/shadow_boxes.hpp"
#include "gnomon/study/technique.hpp"

namespace gnomon::tool {

class SceneView {
 public:
  /// Throws SceneError, and std::runtime_error where the camera's words do not go together.
  SceneView(const std::string& scene, const LightPlacement& light, const CameraWords& camera = {},
            const LoadLimits& limits = {}, const SceneEdits& edits = {});

  [[nodiscard]] const Scene& scene() const noexcept { return scene_; }
  [[nodiscard]] const Light& light() const noexcept { return light_; }
  /// Takes another light in place of the one placed.
  void set_light(const Light& light) noexcept { light_ = light; }
  [[nodiscard]] SceneBounds bounds() const noexcept { return boxes_.bounds(); }
  /// Places what a pose of this scene moves, but the light, which stays. bounds() follow in place.
  void take(const Pose& pose);
  /// Of each instance, as bounds() has them.
  [[nodiscard]] const std::vector<CasterWork>& work() const noexcept { return work_; }
  /// The frame's place is the middle of one of `frames` equal parts of the flight: its ends are often at
  /// rest.
  [[nodiscard]] Camera camera(int frame, int frames, int width, int height) const noexcept;
  /// Where a viewer at 60 Hz stood one frame earlier, in a flight of ten seconds.
  [[nodiscard]] Camera camera_before(int frame, int frames, int width, int height) const noexcept;

 private:
  Scene scene_;
  CameraPath path_;
  std::vector<CasterWork> work_;
  ShadowBoxes boxes_;
  Light light_;
};

}  // namespace gnomon::tool
