// Manual pages, written from a program's tables.
#include <algorithm>

#include "option_words.hpp"
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

std::string option_entry(const Option& option, std::string_view footer) {
  std::string out = ".TP\n.B " + roff(option.name);
  if (const std::string word = value_word(option); !word.empty() && option.name.starts_with('-'))
    out += " \\fI" + roff(word) + "\\fR";
  out += "\n" + roff(option.help) + ".";
  if (const std::string values = values_word(option, footer); !values.empty())
    out += " One of " + roff(values) + ".";
  if (option.range)
    out += " From " + roff(number_word((*option.range)[0])) + " to " + roff(number_word((*option.range)[1])) +
           ".";
  if (const std::string value = default_word(option); !value.empty()) out += " Default: " + roff(value) + ".";
  return out + "\n";
}

std::string synopsis_of(const Arguments& arguments) {
  std::string out = " [\\fIOPTION\\fR]...";
  for (const Option& option : arguments.options) {
    if (!is_positional(option)) continue;
    const std::string word = "\\fI" + roff(upper(option.name)) + "\\fR" + (takes_list(option) ? "..." : "");
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
  for (const Option& option : arguments.options) out += option_entry(option, arguments.footer);
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
