// Reads the command line by a program's tables. CLI11, slow to compile, is seen by this file alone.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

#include "command.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "interrupt.hpp"
#include "option_words.hpp"
#include "output.hpp"
#include "shell_texts.hpp"

namespace gnomon::tool {
namespace {

constexpr int kBadInput = 2;
constexpr int kInternalFault = 1;

std::string_view g_program = "gnomon";

int complain(const std::string& what, int code) {
  std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(g_program.size()), g_program.data(), what.c_str());
  return code;
}

/// CLI::Range shows its ends with six digits behind the point, and lets not-a-number through.
template <class Number>
std::function<std::string(const std::string&)> number_check(const Option& option) {
  return [name = option.name, range = option.range](const std::string& text) {
    Number number{};
    const bool read = CLI::detail::lexical_cast(text, number);
    const bool fits =
        !range || (number >= static_cast<Number>((*range)[0]) && number <= static_cast<Number>((*range)[1]));
    if (read && fits && !std::isnan(static_cast<double>(number))) return std::string();
    const std::string kind = std::is_integral_v<Number> ? "a whole number" : "a number";
    const std::string ends =
        range ? " from " + number_word((*range)[0]) + " to " + number_word((*range)[1]) : std::string();
    throw std::runtime_error(name + " " + one_line(text, 80) + ": wants " + kind + ends);
  };
}

CLI::Option* bind_parsed(CLI::App& app, const Option& option, const ParsedWord& parsed) {
  const auto set = [option, parsed](const std::string& text) {
    if (!parsed.set(text)) refuse_name(option.name, text, option.names);
  };
  return app.add_option_function<std::string>(option.name, set, option.help)->default_str(parsed.shown);
}

CLI::Option* bind_parsed(CLI::App& app, const Option& option, const ParsedWords& parsed) {
  const auto set = [option, parsed](const std::vector<std::string>& words) {
    parsed.set(option.name, words);
  };
  return app.add_option_function<std::vector<std::string>>(option.name, set, option.help)
      ->default_str(parsed.shown);
}

/// Declares the option's target, with the checks that its type has.
CLI::Option* bind(CLI::App& app, const Option& option) {
  const auto to = [&]<class Value>(Value* value) -> CLI::Option* {
    if constexpr (std::is_same_v<Value, bool>) {
      return app.add_flag(option.name, *value, option.help);
    } else {
      CLI::Option* bound = app.add_option(option.name, *value, option.help);
      bool has_default = true;
      if constexpr (requires { value->empty(); }) has_default = !value->empty();
      if (has_default) bound->capture_default_str();
      if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, std::vector<int>>) {
        bound->check(number_check<int>(option));
      } else if constexpr (std::is_same_v<Value, std::uint64_t> || std::is_same_v<Value, double>) {
        bound->check(number_check<Value>(option));
      }
      return bound;
    }
  };
  return std::visit(
      [&](const auto& target) -> CLI::Option* {
        if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(target)>>) {
          return to(target);
        } else {
          return bind_parsed(app, option, target);
        }
      },
      option.target);
}

void declare_option(CLI::App& app, const Option& option) {
  CLI::Option* bound = bind(app, option);
  if (!option.word.empty()) bound->type_name(option.word);
  if (option.required) bound->required();
  if (option.delimiter != '\0') bound->delimiter(option.delimiter);
  if (option.words > 0) bound->expected(option.words);
  const bool checked = !option.names.empty() && option.only_names;
  const bool is_parsed =
      std::holds_alternative<ParsedWord>(option.target) || std::holds_alternative<ParsedWords>(option.target);
  if (checked && !is_parsed) {
    bound->check([option](const std::string& text) {
      if (std::find(option.names.begin(), option.names.end(), text) == option.names.end())
        refuse_name(option.name, text, option.names);
      return std::string();
    });
  }
}

void declare_options(CLI::App& app, const Arguments& arguments) {
  for (const Option& option : arguments.options) declare_option(app, option);
  for (const Option& option : arguments.options) {
    if (!option.needs.empty()) app.get_option(option.name)->needs(app.get_option(option.needs));
    for (const std::string& other : option.excludes)
      app.get_option(option.name)->excludes(app.get_option(other));
  }
}

void note_given(const CLI::App& app, const Arguments& arguments) {
  for (const Option& option : arguments.options) {
    if (option.given != nullptr) *option.given = app.count(option.name) > 0;
  }
}

std::vector<std::string> option_names(const Arguments& arguments) {
  std::vector<std::string> names{"--help", "--version"};
  for (const Option& option : arguments.options) {
    if (option.name.starts_with('-')) names.push_back(option.name);
  }
  return names;
}

std::string bad_usage(const CLI::App& app, const Arguments& arguments, const CLI::ParseError& error) {
  for (const std::string& extra : app.remaining(true)) {
    const std::string word = extra.substr(0, extra.find('='));
    const std::string near = word.starts_with("--") ? nearest_name(word, option_names(arguments)) : "";
    if (!near.empty())
      return "there is no option '" + one_line(word, 80) + "'; did you mean '" + near + "'? (see --help)";
  }
  std::string what = error.what();
  return one_line(what.substr(0, what.find('\n')), 400) + " (see --help)";
}

void print_text(std::string text) {
  if (text.ends_with('\n')) text.pop_back();  // print_line() adds it
  print_line(text);
  flush_output();
}

/// False where the command line asked for help or the version, which is printed.
bool parse(CLI::App& app, const CLI::App& command, const Arguments& arguments, const std::string& help,
           int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print_text(help);
    return false;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success))
      throw std::runtime_error(bad_usage(command, arguments, error));
    print_text(error.what());
    return false;
  }
  note_given(command, arguments);
  return true;
}

std::string version_of(const Program& program) {
  return std::string(program.name) + " " + GNOMON_VERSION;
}

/// Read before the parser sees them; declared for its list of what there is.
void declare_texts(CLI::App& app) {
  app.add_option("--completion");
  app.add_option("--manual");
}

int run_single(const Program& program, int argc, char** argv) {
  CLI::App app(std::string(program.summary), std::string(program.name));
  app.set_version_flag("--version", version_of(program));
  Arguments arguments;
  const std::function<int()> run = program.commands.front().declare(arguments);
  declare_options(app, arguments);
  declare_texts(app);
  return parse(app, app, arguments, help_page(program, nullptr), argc, argv) ? run() : 0;
}

const Command* find_command(const Program& program, std::string_view name) {
  const auto at = std::find_if(program.commands.begin(), program.commands.end(),
                               [&](const Command& command) { return command.name == name; });
  return at == program.commands.end() ? nullptr : &*at;
}

/// The commands that have the option.
std::vector<std::string> commands_with(const Program& program, const std::string& option) {
  std::vector<std::string> commands;
  for (const Command& command : program.commands) {
    if (command.declare == nullptr) continue;
    Arguments arguments;
    const std::function<int()> run = command.declare(arguments);  // the options look into what it keeps
    const std::vector<std::string> names = option_names(arguments);
    if (std::find(names.begin(), names.end(), option) != names.end()) commands.emplace_back(command.name);
  }
  return commands;
}

/// What was meant by a word that is no command: a command, an option without its dashes, or a scene to look
/// at.
std::string meant_by(const Program& program, const std::string& word) {
  if (word.ends_with(".gltf") || word.ends_with(".glb") || word.starts_with("builtin:"))
    return "; " + std::string(program.name) + " view " + one_line(word, 80) + " shows it";
  std::vector<std::string> commands, options;
  for (const Command& command : program.commands) {
    commands.emplace_back(command.name);
    if (command.declare == nullptr) continue;
    Arguments arguments;
    const std::function<int()> run = command.declare(arguments);
    for (const std::string& name : option_names(arguments)) options.push_back(name.substr(2));
  }
  const bool is_option = std::find(options.begin(), options.end(), word) != options.end();
  if (const std::string near = meant(word, commands); !is_option && !near.empty()) return near;
  const std::string option = is_option ? word : nearest_name(word, options);
  if (option.empty()) return {};
  return "; --" + option + " is an option of " + any_of_text(commands_with(program, "--" + option));
}

[[noreturn]] void refuse_command(const Program& program, const std::string& word) {
  // CLI11 would only say that a command is missing.
  throw std::runtime_error("there is no command '" + one_line(word, 80) + "'" + meant_by(program, word) +
                           " (see --help)");
}

// An option where a command should stand. CLI11 would only say that one is missing.
[[noreturn]] void refuse_option(const Program& program, const std::string& word) {
  const std::string option = word.substr(0, word.find('='));
  const std::vector<std::string> commands = commands_with(program, option);
  const std::vector<std::string> alone{"--help", "--version", "--completion", "--manual"};
  throw std::runtime_error(
      "no command stands before '" + one_line(word, 80) + "'" +
      (commands.empty() ? meant(option, alone) : "; it is an option of " + any_of_text(commands)) +
      " (see --help)");
}

int run_command(const Program& program, int argc, char** argv) {
  if (argc <= 1) {
    print_text(help_page(program, nullptr));
    return 0;
  }
  CLI::App app(std::string(program.summary), std::string(program.name));
  app.set_version_flag("--version", version_of(program));
  declare_texts(app);
  app.require_subcommand(1);
  const std::string word = argc > 1 ? argv[1] : "";
  const Command* chosen = find_command(program, word);
  if (chosen == nullptr && !word.empty() && !word.starts_with('-')) refuse_command(program, word);
  if (word.starts_with('-') && word != "-h" && word != "--help" && word != "--version")
    refuse_option(program, word);
  if (chosen != nullptr && chosen->declare == nullptr)
    throw std::runtime_error(word + ": this program was built without " + std::string(chosen->missing));
  Arguments arguments;
  std::function<int()> run;
  CLI::App* parsed = &app;
  for (const Command& command : program.commands) {
    CLI::App* added = app.add_subcommand(std::string(command.name));
    if (&command != chosen) continue;
    added->set_version_flag("--version", version_of(program));
    run = command.declare(arguments);
    declare_options(*added, arguments);
    parsed = added;
  }
  return parse(app, *parsed, arguments, help_page(program, chosen), argc, argv) ? run() : 0;
}

/// True where the command line asks for completion or a manual page, which is then printed.
bool prints_text(const Program& program, int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "", of = argc > 2 ? argv[2] : "";
  std::string text;
  if (what == "--completion") {
    text = completion_script(program, of);
  } else if (what == "--manual") {
    const Command* command = of.empty() ? nullptr : find_command(program, of);
    if (!of.empty() && (command == nullptr || command->declare == nullptr)) refuse_command(program, of);
    text = manual_page(program, command);
  } else {
    return false;
  }
  print_text(text);
  return true;
}

}  // namespace

std::string_view program_name() noexcept {
  return g_program;
}

void warn(const std::string& what) {
  std::fprintf(stderr, "%.*s: warning: %s\n", static_cast<int>(g_program.size()), g_program.data(),
               what.c_str());
}

int run_program(const Program& program, int argc, char** argv) {
  g_program = program.name;
  // A reader that leaves early, and a file that may not grow, are errors to report, not signals to die of.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    if (prints_text(program, argc, argv)) return 0;
    return program.single ? run_single(program, argc, argv) : run_command(program, argc, argv);
  } catch (const Interrupted&) {
    return complain("interrupted", kInterrupted);
  } catch (const std::runtime_error& error) {  // the world outside: files, cases, pipes
    return complain(error.what(), kBadInput);
  } catch (const std::bad_alloc&) {
    return complain("out of memory: a picture, a map or the scene is too large for this machine", kBadInput);
  } catch (const std::exception& error) {
    return complain(std::string("internal fault: ") + error.what(), kInternalFault);
  }
}

}  // namespace gnomon::tool
