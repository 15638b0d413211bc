// Which contexts may --context name in this program, which opens no window?
#pragma once

#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/render/context.hpp"

namespace gnomon::tool {

/// Throws std::runtime_error for any other name.
[[nodiscard]] inline render::ContextKind offscreen_context(const std::string& name) {
  render::ContextKind kind{};
  if (!render::context_kind_from_name(name, kind) || kind == render::ContextKind::glfw)
    refuse_name("--context", name, std::vector<std::string>{"auto", "osmesa", "egl"});
  return kind;
}

}  // namespace gnomon::tool
