// Manual pages, written from a program's tables.
#include <algorithm>
#include <cctype>
#include <type_traits>

#include "shell_texts.hpp"

namespace gnomon::tool {
namespace {

/// Text that man takes for nothing else: no request at the start of a line, no escapes, hyphens that can be
/// copied.
std::string roff(std::string_view text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    line_start = c == '\n';
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// What the option is without being given; empty where that is nothing.
std::string default_of(const Option& option) {
  return std::visit(
      [](const auto& target) -> std::string {
        using Type = std::remove_cvref_t<decltype(target)>;
        if constexpr (std::is_same_v<Type, bool*>) {
          return {};
        } else if constexpr (std::is_same_v<Type, ParsedWord>) {
          return target.shown;
        } else if constexpr (std::is_same_v<Type, std::string*>) {
          return *target;
        } else if constexpr (std::is_same_v<Type, std::vector<std::string>*>) {
          std::string all;
          for (const std::string& word : *target) all += (all.empty() ? "" : ",") + word;
          return all;
        } else if constexpr (std::is_same_v<Type, std::vector<int>*>) {
          std::string all;
          for (const int word : *target) all += (all.empty() ? "" : ",") + std::to_string(word);
          return all;
        } else {
          return number(static_cast<double>(*target));
        }
      },
      option.target);
}

std::string value_word(const Option& option) {
  if (std::holds_alternative<bool*>(option.target)) return {};
  if (!option.word.empty()) return option.word;
  if (!option.names.empty()) return "NAME";
  switch (option.completion) {
    case Completion::files:
      return "FILE";
    case Completion::folders:
      return "DIR";
    case Completion::names:
      break;
  }
  const bool text = std::holds_alternative<std::string*>(option.target);
  return text ? "TEXT" : "NUMBER";
}

std::string option_entry(const Option& option) {
  std::string out = ".TP\n.B " + roff(option.name);
  if (const std::string word = value_word(option); !word.empty() && option.name.starts_with('-'))
    out += " \\fI" + roff(word) + "\\fR";
  out += "\n" + roff(option.help) + ".";
  if (option.range)
    out += " From " + roff(number((*option.range)[0])) + " to " + roff(number((*option.range)[1])) + ".";
  if (const std::string value = default_of(option); !value.empty()) out += " Default: " + roff(value) + ".";
  return out + "\n";
}

std::string synopsis_of(const Arguments& arguments) {
  std::string out = " [\\fIOPTION\\fR]...";
  for (const Option& option : arguments.options) {
    if (option.name.starts_with('-')) continue;
    const bool list = std::holds_alternative<std::vector<std::string>*>(option.target);
    const std::string word = "\\fI" + roff(upper(option.name)) + "\\fR" + (list ? "..." : "");
    out += option.required ? " " + word : " [" + word + "]";
  }
  return out;
}

std::string exit_status(const Arguments& arguments) {
  const std::string own =
      arguments.footer.find("Exit: ") == std::string::npos
          ? "0 on success; 2 for bad input, with one line that names what is wrong and where; "
            "130 where interrupted; 1 for a fault of the program."
          : "See DESCRIPTION; 130 where interrupted.";
  return ".SH EXIT STATUS\n" + roff(own) + "\n";
}

std::string page_head(const std::string& title, const std::string& summary) {
  return ".TH " + upper(title) + " 1 \"\" \"gnomon " GNOMON_VERSION "\" \"gnomon\"\n.SH NAME\n" +
         roff(title) + " \\- " + roff(summary) + "\n";
}

std::string command_page(const std::string& title, const std::string& words, const std::string& summary,
                         const Command& command) {
  Arguments arguments;
  const std::function<int()> run = command.declare(arguments);  // the options look into what it keeps
  std::string out = page_head(title, summary) + ".SH SYNOPSIS\n.B " + roff(words) + "\n" +
                    synopsis_of(arguments).substr(1) + "\n";
  if (!arguments.footer.empty()) out += ".SH DESCRIPTION\n.nf\n" + roff(arguments.footer) + "\n.fi\n";
  out += ".SH OPTIONS\n";
  for (const Option& option : arguments.options) out += option_entry(option);
  return out + ".TP\n.B \\-\\-help\nPrint help.\n.TP\n.B \\-\\-version\nPrint the version.\n" +
         exit_status(arguments);
}

}  // namespace

std::string manual_page(const Program& program, const Command* command) {
  const std::string name(program.name), summary(program.summary);
  if (program.single) return command_page(name, name, summary, program.commands.front());
  if (command != nullptr) {
    return command_page(name + "-" + std::string(command->name), name + " " + std::string(command->name),
                        std::string(command->summary), *command);
  }
  std::string out = page_head(name, summary) + ".SH SYNOPSIS\n.B " + name +
                    "\n\\fICOMMAND\\fR [\\fIOPTION\\fR]...\n" + ".SH COMMANDS\n";
  for (const Command& one : program.commands) {
    if (one.declare == nullptr) continue;
    out += ".TP\n.BR " + name + "\\-" + std::string(one.name) + " (1)\n" + roff(one.summary) + "\n";
  }
  return out +
         ".SH OPTIONS\n.TP\n.B \\-\\-completion \\fISHELL\\fR\nPrint a completion script for bash, zsh or "
         "fish.\n" +
         ".TP\n.B \\-\\-manual \\fR[\\fICOMMAND\\fR]\nPrint this page, or that of a command, in man's "
         "format.\n" +
         exit_status({});
}

}  // namespace gnomon::tool
