// Which contexts may --context name in this program, which opens no window?
#pragma once

#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/render/context.hpp"

namespace gnomon::tool {

/// In the order of render::ContextKind.
[[nodiscard]] inline std::vector<std::string> offscreen_context_names() {
  return {"auto", "osmesa", "egl"};
}

/// --context; `whose` says what the context is for.
[[nodiscard]] inline Option context_option(render::ContextKind& kind, const std::string& whose = "") {
  return {.name = "--context",
          .target = enum_word(kind, offscreen_context_names()),
          .help = "OpenGL context" + whose + ": auto, osmesa or egl",
          .names = offscreen_context_names()};
}

}  // namespace gnomon::tool
