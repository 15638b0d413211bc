// The program's command line: help, version, and what it says to words it does not know.
#include <gtest/gtest.h>

#include <algorithm>

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

TEST(CommandLine, help_lists_the_subcommands) {
  const Finished finished = run_gnomon({"--help"});
  EXPECT_EQ(finished.exit_code, 0);
  for (const char* word : {"plan", "scenes", "compare", "merge", "report", "doctor", "filters", "calibrate",
                           "stress", "--version"})
    EXPECT_NE(finished.out.find(word), std::string::npos) << word;
  for (const char* subcommand :
       {"plan", "scenes", "compare", "merge", "report", "doctor", "filters", "calibrate", "stress"}) {
    EXPECT_EQ(run_gnomon({subcommand, "--help"}).exit_code, 0);
    EXPECT_NE(run_gnomon({subcommand, "--help"}).out.find("--json"), std::string::npos);
    EXPECT_EQ(run_gnomon({subcommand, "--version"}).out, run_gnomon({"--version"}).out);
  }
}

TEST(CommandLine, version_is_one_line) {
  const Finished finished = spawn_gnomon({"--version"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_EQ(finished.out.find("gnomon "), 0u);
  EXPECT_EQ(finished.lines().size(), 1u);
}

TEST(CommandLine, refuses_what_it_does_not_know) {
  const std::string file = case_files().front().string();
  expect_usage_error({});
  expect_usage_error({"plant"});
  EXPECT_NE(spawn_gnomon({"plant", "--help"}).err.find("no command 'plant'"), std::string::npos);
  expect_usage_error({"plan"});
  expect_usage_error({"plan", file, "--prety"});
  expect_usage_error({"plan", file, "--repeat"});
  expect_usage_error({"plan", file, "--repeat", "0"});
  expect_usage_error({"plan", file, "--repeat", "-3"});
  expect_usage_error({"plan", file, "--repeat", "many"});
  expect_usage_error({"plan", file, "--repeat", "99999999999999999999"});
  expect_usage_error({"stress", "--seed", "-1"});
  expect_usage_error({"stress", "--seed", "99999999999999999999"});
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

}  // namespace
}  // namespace gnomon::test
