// What a program's tables become: help, completion for shells, and manual pages.
#pragma once

#include <string>
#include <string_view>

#include "command.hpp"

namespace gnomon::tool {

/// A script for "bash", "zsh" or "fish". Throws std::runtime_error for another shell.
[[nodiscard]] std::string completion_script(const Program& program, const std::string& shell);

/// A page in man's format: of the program, or of one of its commands where `command` is not nullptr.
[[nodiscard]] std::string manual_page(const Program& program, const Command* command);

/// What --help prints: of the program, or of one of its commands where `command` is not nullptr. Lines have
/// at most 100 columns.
[[nodiscard]] std::string help_page(const Program& program, const Command* command);

}  // namespace gnomon::tool
