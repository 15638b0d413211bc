// Judging in a scene where this build has no renderer, no rays or no scenes.
#include <stdexcept>

#include "judge/in_scene.hpp"

namespace gnomon::tool {

SceneJudgement judge_in_scene(judge::Capture&, const std::string&, const std::string&) {
  throw std::runtime_error(
      "SCENE: this build draws no scenes (GNOMON_SCENE, GNOMON_RENDER and GNOMON_TRACE are needed)");
}

std::vector<std::string> judge_context_names() {
  return {"auto"};
}

}  // namespace gnomon::tool
