// Which contexts may --context name in this program, which opens no window?
#pragma once

#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/render/context.hpp"

namespace gnomon::tool {

[[nodiscard]] inline std::vector<std::string> offscreen_context_names() {
  return {"auto", "osmesa", "egl"};
}

/// --context; `whose` says what the context is for.
[[nodiscard]] inline Option context_option(std::string& name, const std::string& whose = "") {
  return {.name = "--context",
          .target = &name,
          .help = "OpenGL context" + whose + ": auto, osmesa or egl",
          .names = offscreen_context_names()};
}

/// Throws std::runtime_error for any other name.
[[nodiscard]] inline render::ContextKind offscreen_context(const std::string& name) {
  render::ContextKind kind{};
  if (!render::context_kind_from_name(name, kind) || kind == render::ContextKind::glfw)
    refuse_name("--context", name, offscreen_context_names());
  return kind;
}

}  // namespace gnomon::tool
