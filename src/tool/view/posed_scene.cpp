// The scene as its animation poses it: for the renderer, for plans and for rays.
#include "posed_scene.hpp"

#include <fmt/core.h>

#include <chrono>

#include "animation_words.hpp"

namespace gnomon::tool::view {

PosedScene::PosedScene(std::shared_ptr<const Scene> scene, ShadowBoxes boxes)
    : scene_(std::move(scene)), boxes_(std::move(boxes)) {
  begin_tracer();
}

std::string PosedScene::follow(const Playing& playing, render::Renderer& renderer, bool& moved) {
  moved = false;
  const SceneMotion& motion = scene_->motion;
  int animation = kRestPose;
  double time_s = 0.0;
  if (!playing.animation.empty()) {
    animation = find_animation(motion, playing.animation);
    if (animation < 0) return no_animation_text(motion, playing.animation);
    time_s = looped_time(motion.animations[static_cast<std::size_t>(animation)], playing.time_s);
  }
  if (animation == animation_ && time_s == time_s_) return {};
  (void)pose(*scene_, animation, time_s, pose_);
  if (!renderer.apply_pose(pose_)) return "the animation's pose does not fit the scene";
  for (const PosedInstance& posed : pose_.instances) boxes_.place(posed.instance, posed.bounds_world);
  animation_ = animation;
  time_s_ = time_s;
  tracer_.reset();
  ++poses_;
  moved = true;
  return {};
}

void PosedScene::begin_tracer() {
  if (tracer_ != nullptr || sorting_.valid()) return;
  sorting_pose_ = poses_;
  const bool rests = animation_ == kRestPose;
  sorting_ = std::async(std::launch::async, [scene = scene_, rests, pose = rests ? Pose{} : pose_] {
    if (rests) return std::make_shared<const trace::Tracer>(*scene);
    Scene posed = *scene;
    apply_pose(pose, posed);
    return std::make_shared<const trace::Tracer>(posed);
  });
}

void PosedScene::take_tracer(bool wait) {
  while (tracer_ == nullptr) {
    if (wait) begin_tracer();
    if (!sorting_.valid()) return;
    if (!wait && sorting_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    auto sorted = sorting_.get();
    // The scene may have moved on since.
    if (sorting_pose_ == poses_) tracer_ = std::move(sorted);
  }
}

}  // namespace gnomon::tool::view
