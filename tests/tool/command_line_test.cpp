// The program's command line: help, version, and what it says to words it does not know.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <new>

#include "command.hpp"
#include "plan/cases.hpp"
#include "process.hpp"

namespace gnomon::test {
namespace {

void expect_usage_error(const std::vector<std::string>& arguments) {
  const Finished finished = run_gnomon(arguments);
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.out, "");
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  EXPECT_EQ(finished.err.find("gnomon: "), 0u) << finished.err;
}

TEST(CommandLine, says_in_one_line_that_memory_ran_out) {
  const auto run = [](std::vector<char*>& argv) {
    const tool::Command commands[] = {{"plan", "", "", [](tool::Arguments&) -> std::function<int()> {
                                         return []() -> int { throw std::bad_alloc(); };
                                       }}};
    return tool::run_program({"gnomon", "", commands}, static_cast<int>(argv.size()) - 1, argv.data());
  };
  const Finished finished = run_process({"plan"}, "", {}, run);
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.err.find("gnomon: out of memory: "), 0u) << finished.err;
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
}

TEST(CommandLine, help_lists_the_subcommands) {
  const Finished finished = run_gnomon({"--help"});
  EXPECT_EQ(finished.exit_code, 0);
  for (const char* word : {"plan", "scenes", "compare", "merge", "report", "doctor", "filters", "calibrate",
                           "bench", "stress", "--version"})
    EXPECT_NE(finished.out.find(word), std::string::npos) << word;
  for (const char* subcommand : {"plan", "scenes", "compare", "merge", "report", "doctor", "filters",
                                 "calibrate", "stress", "bench"}) {
    EXPECT_EQ(run_gnomon({subcommand, "--help"}).exit_code, 0);
    EXPECT_NE(run_gnomon({subcommand, "--help"}).out.find("--json"), std::string::npos);
    EXPECT_EQ(run_gnomon({subcommand, "--version"}).out, run_gnomon({"--version"}).out);
  }
}

TEST(CommandLine, help_and_manual_list_the_values_of_every_option) {
  const auto find = [](const std::vector<std::string>& arguments, const std::string& option,
                       const std::string& end) {
    const std::string text = run_gnomon(arguments).out;
    const auto at = text.find(option);
    return at == std::string::npos ? "" : text.substr(at, text.find(end, at) - at);
  };
  const std::string warp = find({"view", "--help"}, "--warp NAME", "--shape");
  for (const char* name : {"lispsm04", "plane_optimal", "optimal_thorough", "default: auto"})
    EXPECT_NE(warp.find(name), std::string::npos) << warp;
  const std::string objective = find({"fly", "--help"}, "--objective NAME", "--map-size");
  for (const char* name : {"storage", "max", "p95", "picture"})
    EXPECT_NE(objective.find(name), std::string::npos) << objective;
  for (const auto& [option, value] : {std::pair{"--split NAME", "pseudo_near"},
                                      {"--partition NAME", "receiver_clusters"},
                                      {"--fit NAME", "warped_stable"}})
    EXPECT_NE(find({"view", "--help"}, option, "default:").find(value), std::string::npos) << option;
  EXPECT_NE(find({"--manual", "view"}, "\\-\\-transition", ".TP").find("One of cut, blend or dither."),
            std::string::npos);
  // Once: compare has its words in the text below the options.
  const std::string layers = find({"compare", "--help"}, "--layers", "--map-sizes");
  EXPECT_EQ(layers.find("midpoint"), std::string::npos) << layers;
}

TEST(CommandLine, alone_prints_what_one_can_do) {
  const Finished finished = run_gnomon({});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.out, run_gnomon({"--help"}).out);
}

TEST(CommandLine, version_is_one_line) {
  const Finished finished = spawn_gnomon({"--version"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_EQ(finished.out.find("gnomon "), 0u);
  EXPECT_EQ(finished.lines().size(), 1u);
}

TEST(CommandLine, refuses_what_it_does_not_know) {
  const std::string file = case_files().front().string();
  expect_usage_error({"plant"});
  EXPECT_NE(spawn_gnomon({"plant", "--help"}).err.find("no command 'plant'"), std::string::npos);
  expect_usage_error({"plan"});
  expect_usage_error({"plan", file, "--prety"});
  expect_usage_error({"plan", file, "--repeat"});
  expect_usage_error({"plan", file, "--repeat", "0"});
  expect_usage_error({"plan", file, "--repeat", "-3"});
  expect_usage_error({"plan", file, "--repeat", "many"});
  expect_usage_error({"plan", file, "--repeat", "99999999999999999999"});
  expect_usage_error({"stress", "--random", "1", "--out", "/dev/null"});
  expect_usage_error({"stress", "--seed", "-1"});
  expect_usage_error({"stress", "--seed", "99999999999999999999"});
}

TEST(CommandLine, names_the_range_of_a_number_as_help_does) {
  const auto error_of = [](const std::vector<std::string>& arguments) {
    expect_usage_error(arguments);
    return run_gnomon(arguments).err;
  };
  EXPECT_EQ(error_of({"view", "--near", "-1"}), "gnomon: --near -1: wants a number from 0 to 1e+30\n");
  EXPECT_EQ(error_of({"view", "--near", "nan"}), "gnomon: --near nan: wants a number from 0 to 1e+30\n");
  EXPECT_EQ(error_of({"view", "--map-size", "1.5"}),
            "gnomon: --map-size 1.5: wants a whole number from 4 to 16384\n");
  EXPECT_EQ(error_of({"stress", "--random", "0"}),
            "gnomon: --random 0: wants a whole number from 1 to 1000000000000\n");
}

TEST(CommandLine, refuses_options_that_would_have_no_effect) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"view", "--out", "a.png", "--screenshot", "b.png"},
        {"view", "--out", "a.png", "--tour", "tour"},
        {"view", "--out", "a.png", "--exit-after", "3"},
        {"stress", "--random", "1", "--cases"},
        {"stress", "--random", "1", "--axis", "gap"},
        {"fly", "--stable", "--fit", "tight"}}) {
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_NE(finished.err.find(" excludes "), std::string::npos) << finished.err;
  }
}

TEST(CommandLine, overwrites_no_file_that_it_reads) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "as it was"), link = folder.path() / "link";
  std::filesystem::create_symlink(file, link);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"view", file, "--out", file},
        {"view", file, "--out", link},
        {"view", link, "--screenshot", file},
        {"view", "--path", file, "--out", folder.path() / "." / "file"},
        {"view", "--proxies", file, "--out", file},
        {"view", file, "--benchmark", file}}) {
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_NE(finished.err.find(": would overwrite " + folder.path().string()), std::string::npos)
        << finished.err;
    EXPECT_EQ(content_of(file), "as it was");
  }
}

TEST(CommandLine, suggests_what_was_meant) {
  const std::string file = case_files().front().string();
  const auto error_of = [](const std::vector<std::string>& arguments) {
    const Finished finished = run_gnomon(arguments);
    EXPECT_EQ(finished.exit_code, 2);
    return finished.err;
  };
  EXPECT_NE(error_of({"plna", file}).find("did you mean 'plan'?"), std::string::npos);
  EXPECT_NE(error_of({"plan", file, "--prety"}).find("did you mean '--pretty'?"), std::string::npos);
  EXPECT_NE(error_of({"stress", "--axis", "gpa"}).find("did you mean 'gap'?"), std::string::npos);
  // What is like no name is no name's mistake.
  EXPECT_EQ(error_of({"elephants"}).find("did you mean"), std::string::npos);
  EXPECT_EQ(error_of({"plan", file, "--elephants"}).find("did you mean"), std::string::npos);
}

TEST(CommandLine, names_the_commands_of_an_option_that_stands_before_one) {
  expect_usage_error({"--eye", "0,0,0"});
  const std::string eye = run_gnomon({"--eye=0,0,0", "--target", "1,0,0"}).err;
  EXPECT_NE(eye.find("no command stands before '--eye=0,0,0'; it is an option of fly, view"),
            std::string::npos)
      << eye;
  EXPECT_NE(run_gnomon({"--verion"}).err.find("did you mean '--version'?"), std::string::npos);
}

TEST(CommandLine, names_the_option_that_was_taken_for_a_command) {
  const auto error_of = [](const char* word) { return run_gnomon({word}).err; };
  // One letter away from the command `panes`, and an option by its full name.
  EXPECT_NE(error_of("pages").find("--pages is an option of fly, view"), std::string::npos)
      << error_of("pages");
  EXPECT_NE(error_of("page").find("--pages is an option of"), std::string::npos) << error_of("page");
  EXPECT_NE(error_of("repeat").find("--repeat is an option of plan"), std::string::npos)
      << error_of("repeat");
  EXPECT_NE(error_of("hall/room.glb").find("gnomon view hall/room.glb shows it"), std::string::npos);
}

TEST(CommandLine, takes_json_where_json_is_all_there_is) {
  const std::string file = case_files().front().string();
  EXPECT_EQ(run_gnomon({"plan", file, "--json"}).out, run_gnomon({"plan", file}).out);
}

TEST(CommandLine, output_that_cannot_be_written_is_an_error) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"plan", case_files().front().string()}, std::vector<std::string>{"--help"},
        std::vector<std::string>{"stress", "--axis", "gap", "--samples", "2"}}) {
    const Finished finished = spawn_gnomon(arguments, "", "/dev/full");
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_NE(finished.err.find("standard output"), std::string::npos) << finished.err;
  }
}

// A state read /dev/zero until the memory was full.
TEST(CommandLine, refuses_devices_folders_and_idle_pipes_in_the_place_of_every_file_it_reads) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // Where pipes are taken, an idle one is given up after kPipePatience: BoundedFile has that.
  struct Reader {
    bool takes_pipes;
    std::vector<std::string> before, after;
  };
  const std::string out = folder.path() / "out";
  const Reader readers[] = {
      {true, {"plan"}, {}},
      {true, {"stress", "--replay"}, {}},
      {true, {"view", "--state"}, {}},
      {true, {"view", "builtin:fence", "--path"}, {}},
      {true, {"fly", "builtin:fence", "--out", out, "--path"}, {}},
      {false, {"view"}, {}},
      {false, {"view", "builtin:fence", "--results"}, {}},
      {false, {"fly", "builtin:fence", "--target-error", "1", "--out", out, "--cost-model"}, {}},
      {false, {"fly", "--out", out}, {}},
      {false, {"bias", "--out", out}, {}},
      {false, {"compare"}, {"--out", out}},
      {false, {"merge", "--out", out}, {}},
      {false, {"report", "--gpu"}, {}},
      {false, {"calibrate", "--check", "--out", folder.path(), "--model"}, {}},
      {false, {"diff"}, {case_files().front().string()}},
      {false, {"diff", case_files().front().string()}, {}},
  };
  for (const Reader& reader : readers) {
    for (const std::string& name : {std::string("/dev/zero"), folder.path().string(), pipe}) {
      if (name == pipe && reader.takes_pipes) continue;
      std::vector<std::string> arguments = reader.before;
      arguments.push_back(name);
      arguments.insert(arguments.end(), reader.after.begin(), reader.after.end());
      const Finished finished = run_gnomon(arguments);
      std::string line;
      for (const std::string& word : arguments) line += word + ' ';
      EXPECT_EQ(finished.exit_code, 2) << line << finished.err;
      EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << line << finished.err;
    }
  }
}

}  // namespace
}  // namespace gnomon::test
