// What --help prints, written from a program's tables in lines of at most 100 columns.
#include <algorithm>

#include "option_words.hpp"
#include "shell_texts.hpp"

namespace gnomon::tool {
namespace {

constexpr std::size_t kColumns = 100, kIndent = 28;

/// `text` broken between words; what follows a break begins `indent` columns in.
std::string wrapped(std::string_view text, std::size_t begin, std::size_t indent) {
  std::string out;
  while (begin + text.size() > kColumns) {
    const std::size_t end = text.rfind(' ', kColumns - begin);
    if (end == std::string_view::npos || end == 0) break;
    out += std::string(text.substr(0, end)) + "\n" + std::string(indent, ' ');
    text.remove_prefix(end + 1);
    begin = indent;
  }
  return out + std::string(text);
}

/// A name in the left column and its text beside it, or below where the name is too long for that.
std::string entry(const std::string& name, const std::string& text) {
  std::string out = "  " + name;
  if (out.size() + 2 > kIndent) {
    out += "\n" + std::string(kIndent, ' ');
  } else {
    out += std::string(kIndent - out.size(), ' ');
  }
  return out + wrapped(text, kIndent, kIndent) + "\n";
}

/// " (1 to 8; default: 4)": what the option's help leaves to the table.
std::string limits_of(const Option& option, std::string_view footer) {
  std::string limits;
  const auto add = [&limits](const std::string& text) { limits += (limits.empty() ? "" : "; ") + text; };
  if (const std::string values = values_word(option, footer); !values.empty()) add(values);
  if (option.range) add(number_word((*option.range)[0]) + " to " + number_word((*option.range)[1]));
  if (const std::string value = default_word(option); !value.empty()) add("default: " + value);
  if (!option.needs.empty()) add("needs " + option.needs);
  if (!option.excludes.empty()) add("not with " + any_of_text(option.excludes));
  return limits.empty() ? limits : " (" + limits + ")";
}

std::string option_name(const Option& option) {
  std::string name = option.name;
  if (const std::string word = value_word(option); !word.empty()) name += " " + word;
  return takes_list(option) && option.words == 0 ? name + "..." : name;
}

std::string command_page(const std::string& words, const std::string& summary, const Command& command) {
  Arguments arguments;
  const std::function<int()> run = command.declare(arguments);  // the options look into what it keeps
  std::string usage = "Usage: " + words + " [OPTION]...", positionals, options;
  for (const Option& option : arguments.options) {
    if (is_positional(option)) {
      const std::string word = positional_word(option);
      usage += " " + word;
      const std::size_t bracket = word.starts_with('[') ? 1 : 0;
      positionals += entry(word.substr(bracket, word.size() - 2 * bracket),
                           option.help + limits_of(option, arguments.footer));
    } else {
      options += entry(option_name(option), option.help + limits_of(option, arguments.footer));
    }
  }
  std::string out = wrapped(words + ": " + summary, 0, 0) + "\n" + usage + "\n";
  if (!positionals.empty()) out += "\nArguments:\n" + positionals;
  out +=
      "\nOptions:\n" + options + entry("--help", "print this text") + entry("--version", "print the version");
  std::string_view footer = arguments.footer;
  if (!footer.empty()) out += "\n";
  while (!footer.empty()) {
    const std::size_t end = std::min(footer.find('\n'), footer.size());
    out += wrapped(footer.substr(0, end), 0, 0) + "\n";
    footer.remove_prefix(std::min(end + 1, footer.size()));
  }
  return out;
}

}  // namespace

std::string help_page(const Program& program, const Command* command) {
  const std::string name(program.name), summary(program.summary);
  const std::string texts = entry("--completion SHELL", "print a completion script for bash, zsh or fish");
  if (program.single) {
    return command_page(name, summary, program.commands.front()) + "\nAlso, alone:\n" + texts +
           entry("--manual", "print the manual page");
  }
  if (command != nullptr)
    return command_page(name + " " + std::string(command->name), std::string(command->summary), *command);
  std::string out = wrapped(summary, 0, 0) + "\nUsage: " + name + " COMMAND [OPTION]...\n\nCommands:\n";
  for (const Command& one : program.commands) {
    const std::string missing =
        one.declare == nullptr ? " (not in this build: " + std::string(one.missing) + ")" : "";
    out += entry(std::string(one.name), std::string(one.summary) + missing);
  }
  return out + "\nOptions:\n" +
         entry("--help", "print this text; of a command: " + name + " COMMAND --help") +
         entry("--version", "print the version") + texts +
         entry("--manual [COMMAND]", "print the manual page, of a command where one is named");
}

}  // namespace gnomon::tool
