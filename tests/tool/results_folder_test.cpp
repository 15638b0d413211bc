// Nothing that was measured is lost: two processes in one folder, kills, full disks, folders that take
// nothing.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

/// A sweep that nobody waits for. `user`: who runs it, unless -1.
pid_t start(const std::vector<std::string>& arguments, const fs::path& err = "/dev/null", int user = -1) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int nowhere = ::open("/dev/null", O_WRONLY), to = ::open(err.c_str(), O_WRONLY | O_CREAT, 0666);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(to, STDERR_FILENO);
  if (user >= 0 && ::setuid(static_cast<uid_t>(user)) != 0) ::_exit(126);
  std::vector<char*> argv{const_cast<char*>(GNOMON_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execv(GNOMON_PROGRAM, argv.data());
  ::_exit(127);
}

int exit_code_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Processor time that a sweep takes from its beginning to its end.
std::chrono::nanoseconds time_of_sweep() {
  const TemporaryFolder folder;
  int status = 0;
  rusage usage{};
  EXPECT_GT(::wait4(start(small_sweep(folder.path())), &status, 0, &usage), 0);
  return std::chrono::seconds(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         std::chrono::microseconds(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// Kills a process once it has taken so much of the processor; false where it ended before.
bool kill_after(std::chrono::nanoseconds taken, pid_t child) {
  while (::waitpid(child, nullptr, WNOHANG) == 0) {
    if (processor_time(child) >= taken) {
      ::kill(child, SIGKILL);
      return exit_code_of(child) == 128 + SIGKILL;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

void expect_one_line(const std::string& err, const std::string& part) {
  EXPECT_NE(err.find(part), std::string::npos) << err;
  EXPECT_EQ(message_lines(err), 1) << err;
}

/// The messages but for a warning that an exact result was not kept: it only spares work, and a run warns of
/// the first one alone.
std::string without_warning_of_exact(const std::string& err) {
  std::istringstream lines(err);
  std::string others;
  int warnings = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool warning =
        line.starts_with("gnomon: warning: ") && line.find(".exact: is not written") != line.npos;
    warnings += warning ? 1 : 0;
    if (!warning) others += line + '\n';
  }
  EXPECT_LE(warnings, 1) << err;
  return others;
}

/// Rows that were left whole are the first of all, as they were.
void expect_beginning_of_whole(const fs::path& folder) {
  if (!fs::exists(folder / report::kRowsFile)) return;
  const std::vector<std::string> all = lasting(whole()), some = lasting(folder);
  ASSERT_LE(some.size(), all.size());
  EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin()));
}

TEST(ResultsFolder, takes_one_process_at_a_time_and_names_it_to_the_other) {
  const TemporaryFolder folder;
  {
    const report::ResultsLock mine(folder.path());
    for (const std::vector<std::string>& arguments :
         {small_sweep(folder.path()),
          small_sweep(folder.path(), {"--resume"}),
          {"merge", whole().string(), "--out", folder.path().string()}}) {
      const Finished refused = run_gnomon(arguments);
      EXPECT_EQ(refused.exit_code, 2);
      expect_one_line(refused.err, "in use by process " + std::to_string(::getpid()));
      EXPECT_FALSE(fs::exists(folder.path() / report::kRowsFile));
    }
  }
  const pid_t two[] = {start(small_sweep(folder.path())), start(small_sweep(folder.path()))};
  const int codes[] = {exit_code_of(two[0]), exit_code_of(two[1])};
  EXPECT_EQ(std::min(codes[0], codes[1]), 0);
  EXPECT_EQ(std::max(codes[0], codes[1]), 2);
  EXPECT_EQ(lasting(folder.path()), lasting(whole()));
  EXPECT_FALSE(fs::exists(folder.path() / "results.lock"));
}

TEST(ResultsFolder, loses_no_row_to_kills_at_any_moment_and_byte) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / report::kRowsFile;
  std::mt19937 random(7);
  constexpr int kTries = 5, kParts = 1000;
  std::chrono::nanoseconds all_of_it = time_of_sweep();
  int kills = 0;
  for (int kill = 0; kill < kTries; ++kill) {
    const bool resumes = fs::exists(file);
    const std::size_t before = resumes ? report::read_rows(file).size() : 0;
    std::vector<std::string> more;
    if (resumes) more.emplace_back("--resume");
    const pid_t child = start(small_sweep(folder.path(), more));
    if (!kill_after(all_of_it * (random() % kParts) / kParts, child)) {
      // It took less than the first one, as drivers keep what they compiled. The next one begins anew.
      EXPECT_EQ(lasting(folder.path()), lasting(whole()));
      fs::remove(file);
      all_of_it /= 2;
      continue;
    }
    ++kills;
    if (!fs::exists(file)) continue;
    EXPECT_GE(report::read_rows(file).size(), before) << kill;
    expect_beginning_of_whole(folder.path());
    // The system writes a row at once: what a kill between two of its pages would leave is made by hand.
    std::ofstream(file, std::ios::app) << report::to_json_line({}).substr(0, 1 + random() % 600);
  }
  EXPECT_GT(kills, 0);
  std::vector<std::string> more;
  if (fs::exists(file)) more.emplace_back("--resume");
  const Finished resumed = run_gnomon(small_sweep(folder.path(), more));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  if (!more.empty()) expect_one_line(resumed.err, "not whole and was skipped; it is measured again");
  EXPECT_EQ(lasting(folder.path()), lasting(whole()));
}

TEST(ResultsFolder, a_torn_row_within_the_file_is_measured_again) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / report::kRowsFile;
  expect_success(small_sweep(folder.path()));
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t second = text.find('\n') + 1;
  std::ofstream(file, std::ios::binary) << text.replace(second + 40, 200, 200, '\0');
  const Finished shown = run_gnomon({"report", folder.path().string()});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_NE(shown.err.find("results.jsonl:2: a row is not whole and was skipped"), std::string::npos);
  EXPECT_NE(shown.err.find("builtin:fence: 1 of 4 techniques lacks frames"), std::string::npos);
  EXPECT_EQ(message_lines(shown.err), 2) << shown.err;
  expect_success(small_sweep(folder.path(), {"--resume"}));
  std::vector<std::string> again = lasting(folder.path()), all = lasting(whole());
  std::sort(again.begin(), again.end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(again, all);
  // A merge leaves it out for good.
  const Finished merged =
      run_gnomon({"merge", folder.path().string(), "--out", (folder.path() / "merged").string()});
  EXPECT_EQ(merged.exit_code, 0);
  EXPECT_EQ(lasting(folder.path() / "merged"), lasting(whole()));
}

TEST(ResultsFolder, a_disk_that_is_full_costs_what_did_not_fit_and_no_more) {
  (void)whole();
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t room : {0, 700, 1500, 6000, 12000, 40000}) {
    const TemporaryFolder folder;
    const rlimit less{room, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &less);
    const Finished full = run_gnomon(small_sweep(folder.path()));
    ::setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(full.exit_code, 2) << room;
    // Where not even the message fits, there is none.
    if (room >= 700) expect_one_line(without_warning_of_exact(full.err), "File too large");
    expect_beginning_of_whole(folder.path());
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      EXPECT_TRUE(entry.is_directory() || entry.path().extension() != "." + std::to_string(::getpid()));
    std::vector<std::string> more;
    if (fs::exists(folder.path() / report::kRowsFile)) more.emplace_back("--resume");
    EXPECT_EQ(run_gnomon(small_sweep(folder.path(), more)).exit_code, 0) << room;
    EXPECT_EQ(lasting(folder.path()), lasting(whole())) << room;
  }
}

TEST(ResultsFolder, one_that_is_read_only_is_refused_in_one_line_and_stays_as_it_is) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", err = folder.path() / "err";
  fs::copy(whole(), out, fs::copy_options::recursive);
  fs::remove(out / "report.html");
  std::ofstream(err) << "";
  fs::permissions(err, fs::perms::all);
  fs::permissions(out, fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write,
                  fs::perm_options::remove);
  // Permissions do not hold root back.
  constexpr int kNobody = 65534;
  const int user = ::geteuid() == 0 ? kNobody : -1;
  if (user >= 0) fs::permissions(folder.path(), fs::perms::others_all, fs::perm_options::add);
  for (const std::vector<std::string>& arguments : {small_sweep(out, {"--resume"}),
                                                    {"merge", out.string(), "--out", out.string()},
                                                    {"report", out.string()},
                                                    small_sweep(out / "deeper")}) {
    fs::resize_file(err, 0);
    const int code = exit_code_of(start(arguments, err, user));
    if (code == 127) GTEST_SKIP() << "another user cannot run the program here";
    EXPECT_EQ(code, 2) << arguments[0];
    std::ifstream in(err);
    const std::string said{std::istreambuf_iterator<char>(in), {}};
    expect_one_line(said, "Permission denied");
    EXPECT_NE(said.find(out.string()), std::string::npos) << said;
  }
  EXPECT_EQ(lasting(out), lasting(whole()));
  EXPECT_FALSE(fs::exists(out / "report.html"));
  fs::permissions(out, fs::perms::owner_all, fs::perm_options::add);
}

#ifdef GNOMON_LOST_OSMESA
/// While it lives, programs that are started find an OSMesa whose driver is reset after so many questions.
class LostDriver {
 public:
  explicit LostDriver(int after) {
    ::setenv("LD_LIBRARY_PATH", GNOMON_LOST_OSMESA, 1);
    ::setenv("GNOMON_TEST_RESET_AFTER", std::to_string(after).c_str(), 1);
  }
  ~LostDriver() {
    ::unsetenv("LD_LIBRARY_PATH");
    ::unsetenv("GNOMON_TEST_RESET_AFTER");
  }
  LostDriver(const LostDriver&) = delete;
  LostDriver& operator=(const LostDriver&) = delete;
};

TEST(LostContext, ends_a_sweep_with_one_line_and_keeps_the_rows_before) {
  std::size_t fewest = kSmallRows, most = 0;
  for (const int after : {0, 10, 30}) {  // of 45 questions or so
    SCOPED_TRACE("after " + std::to_string(after));
    const TemporaryFolder folder;
    {
      const LostDriver lost(after);
      const Finished finished = spawn_gnomon(small_sweep(folder.path()));
      EXPECT_EQ(finished.exit_code, 2) << finished.err;
      expect_one_line(finished.err, "the OpenGL context was lost");
    }
    expect_beginning_of_whole(folder.path());
    const std::size_t rows = report::read_rows(folder.path()).size();
    fewest = std::min(fewest, rows);
    most = std::max(most, rows);
    const Finished resumed = spawn_gnomon(small_sweep(folder.path(), {"--resume"}));
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(lasting(folder.path()), lasting(whole()));
  }
  EXPECT_EQ(fewest, 0u) << "lost in the first frame";
  EXPECT_GT(most, 0u) << "lost in a later one";
}
#endif

}  // namespace
}  // namespace gnomon::test
