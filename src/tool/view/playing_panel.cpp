// The panel's part that plays the scene's animations.
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app.hpp"
#include "gnomon/scene/animation.hpp"
#include "widgets.hpp"

namespace gnomon::tool::view {

void toggle_playing(State& state, const Stage* stage) {
  if (stage == nullptr || stage->loaded().scene.motion.animations.empty()) return;
  Playing& playing = state.playing;
  if (playing.animation.empty()) playing.animation = "0";
  playing.on = !playing.on;
}

void playing_part(State& state, const Stage* stage) {
  if (stage == nullptr) return;
  const SceneMotion& motion = stage->loaded().scene.motion;
  if (motion.animations.empty()) return;
  Playing& playing = state.playing;
  int chosen = playing.animation.empty() ? 0 : find_animation(motion, playing.animation) + 1;
  std::vector<std::string> names{"at rest"};
  for (std::size_t i = 0; i < motion.animations.size(); ++i) {
    const std::string& name = motion.animations[i].name;
    names.push_back(name.empty() ? fmt::format("animation {}", i) : name);
  }
  if (choose("animation", chosen, names)) {
    const auto index = static_cast<std::size_t>(chosen) - 1;
    playing.time_s = 0.0;
    playing.animation.clear();
    // By number where the name is shared, is none, or is the number of another.
    if (chosen > 0) {
      const std::string& name = motion.animations[index].name;
      playing.animation =
          !name.empty() && find_animation(motion, name) == chosen - 1 ? name : std::to_string(index);
    }
  }
  tooltip("the animation that moves the scene; figures, plans and exact shadows are those of its pose");
  if (chosen <= 0) return;
  bool on = playing.on;
  if (ImGui::Checkbox("play", &on)) toggle_playing(state, stage);
  tooltip("Space");
  ImGui::SameLine();
  constexpr double kMaxSpeed = 100.0;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.5f);
  ImGui::DragScalar("speed", ImGuiDataType_Double, &playing.speed, 0.02f, nullptr, nullptr, "%.3g");
  playing.speed = std::isfinite(playing.speed) ? std::clamp(playing.speed, -kMaxSpeed, kMaxSpeed) : 1.0;
  tooltip("seconds of the animation in a second; below 0: backwards");
  const Animation& animation = motion.animations[static_cast<std::size_t>(chosen) - 1];
  double time = looped_time(animation, playing.time_s);
  const double begin = 0.0, end = animation.duration_s;
  if (ImGui::SliderScalar("time", ImGuiDataType_Double, &time, &begin, &end, "%.2f s",
                          ImGuiSliderFlags_AlwaysClamp))
    playing.time_s = std::min(time, std::nextafter(end, begin));
}

bool play_animation(State& state, const Stage* stage, double seconds) {
  Playing& playing = state.playing;
  if (!playing.on || playing.animation.empty() || stage == nullptr) return false;
  const SceneMotion& motion = stage->loaded().scene.motion;
  const int index = find_animation(motion, playing.animation);
  if (index < 0) return false;
  playing.time_s = looped_time(motion.animations[static_cast<std::size_t>(index)],
                               playing.time_s + seconds * playing.speed);
  return true;
}

}  // namespace gnomon::tool::view
