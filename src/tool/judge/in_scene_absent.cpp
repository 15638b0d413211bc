// Judging in a scene where this build has no renderer, no rays or no scenes.
#include <stdexcept>

#include "judge/in_scene.hpp"

namespace gnomon::tool {

SceneJudgement judge_in_scene(judge::Capture&, const JudgedScene&) {
  throw std::runtime_error(
      "SCENE: this build draws no scenes (GNOMON_SCENE, GNOMON_RENDER and GNOMON_TRACE are needed)");
}

std::vector<Option> judged_scene_options(JudgedScene&) {
  return {};
}

}  // namespace gnomon::tool
