// The page of a judgement: figures, findings and the picture that they are about.
#pragma once

#include <string>
#include <vector>

#include "judge/in_scene.hpp"
#include "judge/judge.hpp"

namespace gnomon::tool {

/// One file of HTML that needs nothing else.
[[nodiscard]] std::string judge_page(const judge::Capture& capture, const SceneJudgement& result);

}  // namespace gnomon::tool
