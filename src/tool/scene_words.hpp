// The scene and its light on a command line: names, and the options that several commands have.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "sun_words.hpp"

namespace gnomon::tool {

/// "builtin:city" and so on.
[[nodiscard]] inline std::vector<std::string> builtin_scene_words() {
  std::vector<std::string> words;
  for (const BuiltinScene& scene : builtin_scenes()) words.push_back("builtin:" + std::string(scene.name));
  return words;
}

/// Throws std::runtime_error where `word` begins as a built-in scene and is none; files are left to the
/// loader.
inline void check_scene_word(std::string_view option, const std::string& word) {
  const std::vector<std::string> words = builtin_scene_words();
  if (word.starts_with("builtin:") && std::find(words.begin(), words.end(), word) == words.end())
    refuse_name(option, word, words);
}

/// The folder that a scene's file lies in, without those above it; half of all files are called scene.gltf.
[[nodiscard]] inline std::string scene_folder(const std::string& scene) {
  return std::filesystem::absolute(scene).lexically_normal().parent_path().filename().string();
}

/// A scene's name for people: the built-in's word, or the file's folder and name.
[[nodiscard]] inline std::string scene_title(const std::string& scene) {
  if (scene.starts_with("builtin:")) return scene;
  return scene_folder(scene) + "/" + std::filesystem::path(scene).filename().string();
}

/// A scene's name in names of files: the built-in's, or the file's folder and name without its ending.
[[nodiscard]] inline std::string scene_stem(const std::string& scene) {
  if (scene.starts_with("builtin:")) return scene.substr(scene.find(':') + 1);
  return scene_folder(scene) + "_" + std::filesystem::path(scene).stem().string();
}

/// What the loader repaired or omitted, a line each, on standard error.
inline void warn_of(const Scene& scene) {
  for (const std::string& warning : scene.warnings) warn(warning);
}

[[nodiscard]] inline std::string scene_help() {
  std::string text = "glTF file (.gltf, .glb) or one of";
  for (const std::string& word : builtin_scene_words()) text += " " + word;
  return text;
}

/// --light, --light-elevation-deg, --light-azimuth-deg, --sun.
[[nodiscard]] inline std::vector<Option> light_options(LightPlacement& light) {
  const std::vector<std::string> kinds{"sun", "spot", "point"};  // in the order of LightKind
  return {{.name = "--light",
           .target = enum_word(light.kind, kinds),
           .help = "sun, or a spot or point light in the middle of the scene",
           .names = kinds},
          {.name = "--light-elevation-deg",
           .target = &light.elevation_deg,
           .help = "elevation of the sun above the horizon, degrees",
           .range = {{0.1, 90.0}}},
          {.name = "--light-azimuth-deg",
           .target = &light.azimuth_deg,
           .help = "azimuth of the sun, degrees: 0 is -Z, 90 is +X",
           .range = {{-360.0, 360.0}}},
          sun_option(light)};
}

/// The word of --scene-light for all lights at once. A light of that name is still there by its number.
inline constexpr std::string_view kAllLights = "all";
/// --scene-light.
[[nodiscard]] inline Option scene_light_option(std::string& name) {
  return {
      .name = "--scene-light",
      .target = &name,
      .help = "light of the scene's file, by name or number, in place of --light; all: every light at once",
      .word = "NAME",
      .excludes = {"--sun"}};
}

[[nodiscard]] inline Option max_triangles_option(std::uint64_t& most) {
  return {.name = "--max-triangles",
          .target = &most,
          .help = "refuse scenes with more triangles, over all instances; each takes up to 100 bytes",
          .range = {{1, 1e9}}};
}

}  // namespace gnomon::tool
