// What words does a command take? One table for each command, read by the parser, --help, completion and
// manual pages alike.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/nearest_name.hpp"

namespace gnomon::tool {

/// A value that is more than text: `set` returns false for a word that it does not know.
struct ParsedWord {
  std::function<bool(const std::string&)> set;
  std::string shown;  ///< the default, as help shows it
};
/// A list of such values: `set` throws std::runtime_error with `option` in front for words that it does not
/// know.
struct ParsedWords {
  std::function<void(const std::string& option, const std::vector<std::string>& words)> set;
  std::string shown;  ///< the default, as help shows it
};
/// Where an option's words go. A bool makes a flag.
using Target = std::variant<bool*, int*, double*, std::uint64_t*, std::string*, std::vector<int>*,
                            std::vector<std::string>*, ParsedWord, ParsedWords>;

/// What a shell completes an option's value with, besides its names.
enum class Completion { names, files, folders };

/// One option, or one word without a name.
struct Option {
  std::string name;  ///< "--out"; without dashes: a positional word
  Target target;
  std::string help;
  std::string word = {};  ///< stands for the value in help; empty: by its type
  bool required = false;
  std::optional<std::array<double, 2>> range = {};  ///< of numbers, both ends included
  std::vector<std::string> names = {};              ///< words that the option takes
  bool only_names = true;                           ///< any other word is refused
  Completion completion = Completion::names;
  char delimiter = '\0';                   ///< that a list's words may have between them as well
  int words = 0;                           ///< exactly so many; 0: as the target takes
  std::string needs = {};                  ///< another option that must stand beside this one
  std::vector<std::string> excludes = {};  ///< other options that must not
  bool* given = nullptr;                   ///< set to whether it stands on the command line
};

/// What a command declares.
struct Arguments {
  std::vector<Option> options;
  std::string footer;  ///< of its help
};

/// One command of a program.
struct Command {
  std::string_view name, summary;
  std::string_view missing;  ///< what this build lacks for it; empty: nothing
  /// Declares the command's options, and returns what runs it with them: the exit code.
  std::function<int()> (*declare)(Arguments& arguments);
};

/// A program: commands by name, or a single one that is the program itself.
struct Program {
  std::string_view name, summary;
  std::span<const Command> commands;
  bool single = false;
};

/// Reads the command line and runs what it asks for. Errors go to standard error as one line that begins with
/// the program's name. Returns the exit code: 2 for bad input, 130 where interrupted, 1 for a fault of ours.
int run_program(const Program& program, int argc, char** argv);

/// Name of the running program, for messages.
[[nodiscard]] std::string_view program_name() noexcept;
/// Prints "NAME: warning: ..." on standard error.
void warn(const std::string& what);

/// "a, b or c".
[[nodiscard]] std::string any_of_text(std::span<const std::string> names);
/// Throws std::runtime_error "OPTION VALUE: wants a, b or c", with the nearest name where there is one.
[[noreturn]] void refuse_name(std::string_view option, const std::string& value,
                              std::span<const std::string> names);
/// An enumerator by its place among `names`, which has one for each that may be chosen.
template <class Enum>
[[nodiscard]] ParsedWord enum_word(Enum& value, const std::vector<std::string>& names) {
  const auto set = [&value, names](const std::string& word) {
    const auto at = std::find(names.begin(), names.end(), word);
    if (at == names.end()) return false;
    value = static_cast<Enum>(at - names.begin());
    return true;
  };
  return {set, names.at(static_cast<std::size_t>(value))};
}
/// The names of a registry of pointers, such as all_warps().
template <class Entries>
[[nodiscard]] std::vector<std::string> names_in(const Entries& entries,
                                                std::vector<std::string> before = {}) {
  for (const auto* entry : entries) {
    if constexpr (requires { entry->info; }) {
      before.emplace_back(entry->info.name);
    } else {
      before.emplace_back(entry->name);
    }
  }
  return before;
}

}  // namespace gnomon::tool
