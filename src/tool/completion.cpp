// Completion for shells, written from a program's tables.
#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vector>

#include "option_words.hpp"
#include "shell_texts.hpp"

namespace gnomon::tool {
namespace {

/// A command with what it declares.
struct Declared {
  std::string name, summary;
  Arguments arguments;
  std::function<int()> run = {};  ///< keeps what the options look into
};

std::vector<Declared> declared_by(const Program& program) {
  std::vector<Declared> all;
  for (const Command& command : program.commands) {
    if (command.declare == nullptr) continue;
    Declared& one = all.emplace_back(Declared{std::string(command.name), std::string(command.summary), {}});
    one.run = command.declare(one.arguments);
    one.arguments.options.push_back(
        {.name = "--help", .target = static_cast<bool*>(nullptr), .help = "print help"});
    one.arguments.options.push_back(
        {.name = "--version", .target = static_cast<bool*>(nullptr), .help = "print the version"});
  }
  return all;
}

bool is_flag(const Option& option) {
  return std::holds_alternative<bool*>(option.target);
}

const Option* positional_of(const Arguments& arguments) {
  const auto at = std::find_if(arguments.options.begin(), arguments.options.end(), is_positional);
  return at == arguments.options.end() ? nullptr : &*at;
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
  return all;
}

/// Half a line: the help up to its first full stop or semicolon, without what a shell would take for its own.
std::string short_help(const std::string& help) {
  constexpr std::size_t kLongest = 72;
  std::string text = help.substr(0, help.find_first_of(";\n"));
  text = text.substr(0, text.find(". "));
  if (text.size() > kLongest) text = text.substr(0, text.rfind(' ', kLongest)) + " ...";
  std::erase_if(text, [](char c) { return c == '\'' || c == '"' || c == '`' || c == '\\' || c == '$'; });
  return text;
}

/// The bash command that lists what may stand for the option's value.
std::string bash_words(const Option& option) {
  std::string words = option.names.empty() ? "true" : "compgen -W '" + joined(option.names) + "' -- \"$cur\"";
  if (option.completion == Completion::files) words += "; compgen -f -- \"$cur\"";
  if (option.completion == Completion::folders) words += "; compgen -d -- \"$cur\"";
  return words;
}

std::string bash_command(const Declared& command) {
  std::string options, values;
  for (const Option& option : command.arguments.options) {
    if (is_positional(option)) continue;
    options += (options.empty() ? "" : " ") + option.name;
    if (!is_flag(option)) values += "        " + option.name + ") words=$(" + bash_words(option) + ") ;;\n";
  }
  const Option* word = positional_of(command.arguments);
  return "      case \"$prev\" in\n" + values +
         "        *)\n          if [[ $cur == -* ]]; then words=$(compgen -W '" + options +
         "' -- \"$cur\")\n          else words=$(" + (word == nullptr ? "true" : bash_words(*word)) +
         "); fi ;;\n      esac ;;\n";
}

std::string bash_script(const Program& program, const std::vector<Declared>& commands) {
  const std::string name(program.name);
  std::string names = "--help --version --completion --manual", cases;
  for (const Declared& command : commands) {
    names += " " + command.name;
    cases += "    " + (program.single ? "*" : command.name) + ")\n" + bash_command(command);
  }
  if (!program.single) cases += "    *) words=$(compgen -W '" + names + "' -- \"$cur\") ;;\n";
  return "# bash completion for " + name + ", written by " + name + " --completion bash\n_" + name +
         "() {\n  local cur prev words command=''\n"
         "  # A colon in a word, as in builtin:city, is no border between words.\n"
         "  cur=\"${COMP_LINE:0:COMP_POINT}\"; cur=\"${cur##*[[:space:]]}\"\n"
         "  prev=\"${COMP_LINE:0:COMP_POINT}\"; prev=\"${prev%\"$cur\"}\"\n"
         "  prev=\"${prev%\"${prev##*[![:space:]]}\"}\"; prev=\"${prev##*[[:space:]]}\"\n"
         "  ((COMP_CWORD > 1)) && command=\"${COMP_WORDS[1]}\"\n  case \"$command\" in\n" +
         cases +
         "  esac\n  mapfile -t COMPREPLY <<<\"$words\"\n  [[ -n $words ]] || COMPREPLY=()\n"
         "  # bash replaces only what follows the last colon.\n"
         "  if [[ $cur == *:* && $COMP_WORDBREAKS == *:* ]]; then\n"
         "    COMPREPLY=(\"${COMPREPLY[@]#\"${cur%\"${cur##*:}\"}\"}\")\n  fi\n}\ncomplete -o filenames -F "
         "_" +
         name + " " + name + "\n";
}

/// Text within a spec of zsh's _arguments.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_action(const Option& option) {
  const bool files = option.completion == Completion::files;
  std::string colons_quoted;
  for (const char c : joined(option.names))
    colons_quoted += c == ':' ? std::string("\\:") : std::string(1, c);
  if (!option.names.empty())
    return files ? "{ compadd " + colons_quoted + "; _files }" : "(" + colons_quoted + ")";
  if (option.completion == Completion::names) return " ";
  return files ? "_files" : "_files -/";
}

std::string zsh_arguments(const Declared& command) {
  std::string out = "_arguments";
  for (const Option& option : command.arguments.options) {
    const std::string help = zsh_text(short_help(option.help));
    out += " \\\n        ";
    if (is_positional(option)) {
      out += "'*:" + help + ":" + zsh_action(option) + "'";
    } else {
      out += "'" + option.name + "[" + help + "]" + (is_flag(option) ? "" : ":value:" + zsh_action(option)) +
             "'";
    }
  }
  return out;
}

std::string zsh_script(const Program& program, const std::vector<Declared>& commands) {
  const std::string name(program.name);
  std::string out = "#compdef " + name + "\n# written by " + name + " --completion zsh\n_" + name + "() {\n";
  if (program.single) {
    out += "  " + zsh_arguments(commands.front()) + "\n}\n";
  } else {
    out += "  if ((CURRENT == 2)); then\n    local -a commands=(\n";
    for (const Declared& command : commands)
      out += "      '" + command.name + ":" + zsh_text(short_help(command.summary)) + "'\n";
    out +=
        "    )\n    _describe command commands\n    return\n  fi\n  local command=$words[2]\n"
        "  shift words\n  ((CURRENT--))\n  case $command in\n";
    for (const Declared& command : commands)
      out += "    " + command.name + ")\n      " + zsh_arguments(command) + " ;;\n";
    out += "  esac\n}\n";
  }
  return out + "_" + name + " \"$@\"\n";
}

std::string fish_values(const Option& option) {
  std::string values = option.completion == Completion::files ? " -r -F" : " -x";
  if (option.completion == Completion::folders) values += " -a '(__fish_complete_directories)'";
  if (!option.names.empty()) values += " -a '" + joined(option.names) + "'";
  return values;
}

std::string fish_script(const Program& program, const std::vector<Declared>& commands) {
  const std::string name(program.name), complete = "complete -c " + name;
  std::string out = "# fish completion for " + name + ", written by " + name + " --completion fish\n";
  for (const Declared& command : commands) {
    std::string when;
    if (!program.single) {
      out += complete + " -f -n __fish_use_subcommand -a " + command.name + " -d '" +
             short_help(command.summary) + "'\n";
      when = " -n '__fish_seen_subcommand_from " + command.name + "'";
    }
    for (const Option& option : command.arguments.options) {
      const std::string help = " -d '" + short_help(option.help) + "'";
      if (is_positional(option)) {
        out += complete + when + fish_values(option) + "\n";
      } else {
        out += complete + when + " -l " + option.name.substr(2) +
               (is_flag(option) ? " -f" : fish_values(option)) + help + "\n";
      }
    }
  }
  return out;
}

}  // namespace

std::string completion_script(const Program& program, const std::string& shell) {
  const std::vector<Declared> commands = declared_by(program);
  if (shell == "bash") return bash_script(program, commands);
  if (shell == "zsh") return zsh_script(program, commands);
  if (shell == "fish") return fish_script(program, commands);
  refuse_name("--completion", shell, std::vector<std::string>{"bash", "zsh", "fish"});
}

}  // namespace gnomon::tool
