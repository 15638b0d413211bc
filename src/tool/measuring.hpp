// What do the commands that measure have in common: scenes, light, frames, and where results go?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "camera_words.hpp"
#include "command.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/edit.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::tool {

/// What is measured on which frames, and where the results go.
struct Measuring {
  std::vector<std::string> scenes;  ///< builtin:NAME or files
  LightPlacement light;
  CameraWords camera;
  SceneEdits edits;               ///< of the scenes, as they are loaded
  std::string animation;          ///< that scenes play, by name or number; empty: at rest
  int width = 480, height = 270;  ///< of a frame, pixels
  int frames = 4;                 ///< along the scene's camera path
  int rounds = 5;                 ///< timings of each technique per timed frame
  std::uint64_t max_triangles = LoadLimits{}.triangles;  ///< scenes of more are refused
  render::ContextKind context = render::ContextKind::automatic;
  std::string out;    ///< folder; empty: no files
  bool json = false;  ///< rows are printed as lines of JSON
};

/// SCENE of a command that takes several; a name that is no built-in scene is refused.
[[nodiscard]] Option scenes_option(Measuring& measuring, const std::string& help, bool required);

/// All options of a command that prints rows: SCENE, its own, then --light, --path, --ground and so on,
/// --size,
/// --out, --json and --context.
[[nodiscard]] std::vector<Option> measuring_options(Measuring& measuring, Option scenes,
                                                    std::vector<Option> own, const std::string& out_help);

}  // namespace gnomon::tool
