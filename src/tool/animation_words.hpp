// How commands name a scene's animations.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "gnomon/scene/animation.hpp"

namespace gnomon::tool {

/// Why there is no animation of this name or number, and which there are.
[[nodiscard]] inline std::string no_animation_text(const SceneMotion& motion, const std::string& word) {
  if (motion.animations.empty()) return fmt::format("animation '{}': the scene has no animations", word);
  constexpr std::size_t kMaxNames = 20;
  std::string names;
  for (std::size_t i = 0; i < std::min(motion.animations.size(), kMaxNames); ++i) {
    const std::string& name = motion.animations[i].name;
    names += fmt::format("{}{}", i == 0 ? "" : ", ", name.empty() ? std::to_string(i) : name);
  }
  if (motion.animations.size() > kMaxNames) names += ", ...";
  return fmt::format("animation '{}': the scene has none of this name; it has {}", word, names);
}

/// The animation of this name or number. Throws std::runtime_error with the file where there is none.
[[nodiscard]] inline int animation_of(const std::string& file, const SceneMotion& motion,
                                      const std::string& word) {
  const int animation = find_animation(motion, word);
  if (animation < 0) throw std::runtime_error(fmt::format("{}: {}", file, no_animation_text(motion, word)));
  return animation;
}

}  // namespace gnomon::tool
