// Names of built-in scenes on a command line.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::tool {

/// "builtin:city" and so on.
[[nodiscard]] inline std::vector<std::string> builtin_scene_words() {
  std::vector<std::string> words;
  for (const BuiltinScene& scene : builtin_scenes()) words.push_back("builtin:" + std::string(scene.name));
  return words;
}

/// Throws std::runtime_error where `word` begins as a built-in scene and is none; files are left to the
/// loader.
inline void check_scene_word(const char* option, const std::string& word) {
  const std::vector<std::string> words = builtin_scene_words();
  if (word.starts_with("builtin:") && std::find(words.begin(), words.end(), word) == words.end())
    refuse_name(option, word, words);
}

}  // namespace gnomon::tool
