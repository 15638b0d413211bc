// Completion scripts and manual pages hold what --help holds, and the shells and man take them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "process.hpp"

namespace gnomon::test {
namespace {

/// Words that begin a line of the help after two spaces: options, and in the program's own help its commands.
std::set<std::string> words_of_help(const std::vector<std::string>& arguments, const std::string& pattern) {
  const Finished help = run_gnomon(arguments);
  EXPECT_EQ(help.exit_code, 0);
  std::set<std::string> words;
  const std::regex word("^  (?:-h,)?(" + pattern + ")\\b");
  for (const std::string& line : help.lines()) {
    std::smatch match;
    if (std::regex_search(line, match, word)) words.insert(match[1]);
  }
  return words;
}

std::set<std::string> commands() {
  std::set<std::string> names;
  bool among_commands = false;
  for (const std::string& line : run_gnomon({"--help"}).lines()) {
    std::istringstream words(line);
    std::string name;
    if (among_commands && line.empty()) break;
    if (among_commands && !line.starts_with("   ") && words >> name) names.insert(name);
    among_commands = among_commands || line.starts_with("Commands:");
  }
  return names;
}

int shell(const std::string& command) {
  const int status = std::system(("bash -c '" + command + "' > /dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool is_installed(const std::string& program) {
  return shell("command -v " + program) == 0;
}

TEST(ShellTexts, name_every_command_and_option_of_help) {
  ASSERT_GE(commands().size(), 4u);
  const std::string bash = run_gnomon({"--completion", "bash"}).out,
                    zsh = run_gnomon({"--completion", "zsh"}).out,
                    fish = run_gnomon({"--completion", "fish"}).out, program = run_gnomon({"--manual"}).out;
  std::size_t options = 0;
  for (const std::string& command : commands()) {
    EXPECT_NE(bash.find("    " + command + ")\n"), std::string::npos) << command;
    EXPECT_NE(zsh.find("'" + command + ":"), std::string::npos) << command;
    EXPECT_NE(fish.find(" -a " + command + " "), std::string::npos) << command;
    EXPECT_NE(program.find(command + " (1)"), std::string::npos) << command;
    const std::string page = run_gnomon({"--manual", command}).out;
    for (const std::string& option : words_of_help({command, "--help"}, "--[a-z-]+")) {
      ++options;
      EXPECT_NE(bash.find(option), std::string::npos) << option;
      EXPECT_NE(zsh.find("'" + option + "["), std::string::npos) << option;
      EXPECT_NE(fish.find(" -l " + option.substr(2)), std::string::npos) << option;
      EXPECT_NE(page.find(std::regex_replace(option, std::regex("-"), "\\-")), std::string::npos) << option;
    }
  }
  EXPECT_GE(options, 30u);
}

TEST(ShellTexts, keep_help_to_a_hundred_columns) {
  std::vector<std::vector<std::string>> texts{{"--help"}, {"filters"}};
  for (const std::string& command : commands()) texts.push_back({command, "--help"});
  if (commands().contains("filters")) {
    for (const std::string& line : run_gnomon({"filters"}).lines()) {
      const std::size_t colon = line.find(": ");
      if (colon != std::string::npos) texts.push_back({"filters", line.substr(0, colon)});
    }
  }
  for (const std::vector<std::string>& text : texts) {
    const std::vector<std::string> lines = run_gnomon(text).lines();
    EXPECT_GE(lines.size(), 2u) << text.back();
    for (const std::string& line : lines) EXPECT_LE(line.size(), 100u) << text.front() << ": " << line;
  }
}

TEST(ShellTexts, name_where_the_options_of_filters_are_printed) {
  if (!commands().contains("fly")) return;
  const std::string help = run_gnomon({"fly", "--help"}).out;
  EXPECT_NE(help.find("gnomon filters NAME"), std::string::npos);
  EXPECT_EQ(help.find("light_radius"), std::string::npos) << "an option of pcss";
}

TEST(ShellTexts, are_refused_for_what_there_is_not) {
  const Finished shell_name = run_gnomon({"--completion", "bsh"});
  EXPECT_EQ(shell_name.exit_code, 2);
  EXPECT_NE(shell_name.err.find("did you mean 'bash'?"), std::string::npos) << shell_name.err;
  EXPECT_EQ(run_gnomon({"--completion"}).exit_code, 2);
  EXPECT_EQ(run_gnomon({"--manual", "plant"}).exit_code, 2);
}

TEST(ShellTexts, are_taken_by_the_shells_and_by_groff) {
  const TemporaryFolder folder;
  const std::string bash = folder.write("gnomon.bash", run_gnomon({"--completion", "bash"}).out);
  EXPECT_EQ(shell("bash -n " + bash), 0);
  const std::string zsh = folder.write("_gnomon", run_gnomon({"--completion", "zsh"}).out);
  if (is_installed("zsh")) {
    EXPECT_EQ(shell("zsh -n " + zsh), 0);
  }
  const std::string fish = folder.write("gnomon.fish", run_gnomon({"--completion", "fish"}).out);
  if (is_installed("fish")) {
    EXPECT_EQ(shell("fish --no-execute " + fish), 0);
  }
  if (!is_installed("groff")) return;
  for (const std::string& command : commands()) {
    const std::string page = folder.write("page.1", run_gnomon({"--manual", command}).out);
    // groff says nothing where nothing is wrong.
    EXPECT_EQ(shell("test -z \"$(groff -man -ww -z " + page + " 2>&1)\""), 0) << command;
  }
}

/// What bash offers for a line that ends where the cursor stands.
std::string completed(const std::string& script, const std::string& line) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  std::string words;
  int count = 0;
  std::istringstream in(line);
  for (std::string word; in >> word; ++count) words += " \"" + word + "\"";
  if (line.ends_with(' ')) {
    words += " \"\"";
    ++count;
  }
  const std::string runner =
      folder.write("run.bash", "source " + script + "\nCOMP_LINE=\"" + line +
                                   "\"\nCOMP_POINT=${#COMP_LINE}\nCOMP_WORDS=(" + words +
                                   " )\nCOMP_CWORD=" + std::to_string(count - 1) +
                                   "\n_gnomon\necho \"${COMPREPLY[*]}\" > " + out + "\n");
  EXPECT_EQ(shell("bash " + runner), 0) << line;
  std::ifstream file(out);
  std::string text;
  std::getline(file, text);
  return text;
}

TEST(ShellTexts, let_bash_complete_commands_options_and_names) {
  const TemporaryFolder folder;
  const std::string script = folder.write("gnomon.bash", run_gnomon({"--completion", "bash"}).out);
  EXPECT_EQ(completed(script, "gnomon pl"), "plan");
  EXPECT_EQ(completed(script, "gnomon plan --pr"), "--pretty");
  EXPECT_EQ(completed(script, "gnomon stress --axis g"), "gap");
  EXPECT_NE(completed(script, "gnomon stress --axis ").find("light_angle"), std::string::npos);
  EXPECT_EQ(completed(script, "gnomon nothing --o"), "");
}

}  // namespace
}  // namespace gnomon::test
