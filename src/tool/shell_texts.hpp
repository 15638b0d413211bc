// What a program's tables become besides --help: completion for shells, and manual pages.
#pragma once

#include <string>
#include <string_view>

#include "command.hpp"

namespace gnomon::tool {

/// A script for "bash", "zsh" or "fish". Throws std::runtime_error for another shell.
[[nodiscard]] std::string completion_script(const Program& program, const std::string& shell);

/// A page in man's format: of the program, or of one of its commands where `command` is not nullptr.
[[nodiscard]] std::string manual_page(const Program& program, const Command* command);

}  // namespace gnomon::tool
