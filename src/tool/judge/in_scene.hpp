// How many pixels do an engine's maps get wrong in a scene, and how many does gnomon's plan?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/scene/edit.hpp"
#include "judge/judge.hpp"

namespace gnomon::tool {

/// Shares of the pixels that a light decides.
struct DrawnErrors {
  double wrong = 0.0, false_light = 0.0, false_shadow = 0.0;
  double expected = 0.0;  ///< without drawing
};

/// One light of the first frame, drawn with hard comparison and the default bias: maps alone differ.
struct DrawnLightErrors {
  std::uint64_t pixels = 0;
  DrawnErrors captured;
  std::optional<DrawnErrors> planned;
  std::string picture, planned_picture;  ///< PNG: grey where right, coloured where wrong
};

struct SceneJudgement {
  judge::Judgement judgement;
  std::vector<DrawnLightErrors> drawn;  ///< by light; empty without a scene
  [[nodiscard]] const DrawnLightErrors* drawn_of(const judge::LightFigures& light) const {
    return drawn.empty() ? nullptr : &drawn[static_cast<std::size_t>(light.light)];
  }
};

/// The scene that a capture is of, and what draws it.
struct JudgedScene {
  std::string file, context = "auto";  ///< builtin:NAME or a file; by its name
  SceneEdits edits;
};
/// Fills in what the capture does not know: boxes, and visible points with their normals.
/// Then judges, and draws the first frame. Throws std::runtime_error where the scene or a context cannot be
/// had.
[[nodiscard]] SceneJudgement judge_in_scene(judge::Capture& capture, const JudgedScene& scene);
/// --context, --ground and so on, beside SCENE.
[[nodiscard]] std::vector<Option> judged_scene_options(JudgedScene& scene);

}  // namespace gnomon::tool
