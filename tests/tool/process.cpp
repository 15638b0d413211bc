// Runs the `gnomon` program as a user would, without a shell between.
#include "process.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace gnomon::test {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

std::ptrdiff_t message_lines(const std::string& err) {
  std::ptrdiff_t count = 0;
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) count += line.ends_with(" left") ? 0 : 1;
  return count;
}

std::chrono::nanoseconds processor_time(pid_t process) {
  clockid_t clock{};
  timespec taken{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &taken) != 0) return {};
  return std::chrono::seconds(taken.tv_sec) + std::chrono::nanoseconds(taken.tv_nsec);
}

namespace {

// A run hangs that takes more of the processor than any does under the sanitizers, or nothing of it for so
// long: other programs on the machine make it late, but do neither.
constexpr std::chrono::seconds kMaxTime{240}, kMaxRest{120};

/// Name, state and times of each of a process's threads, and where in the kernel it waits.
std::string threads_of(pid_t process) {
  std::ostringstream threads;
  std::error_code ended;
  const std::filesystem::path tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks, ended))
    threads << content_of(task.path() / "stat") << "  waits in " << content_of(task.path() / "wchan") << "\n";
  return threads.str();
}

/// The status that a process ends with. One that hangs is killed, and `hung` says what its threads did.
int status_of(pid_t process, std::string& hung) {
  constexpr std::chrono::milliseconds kPause{2};
  auto moved = std::chrono::steady_clock::now();
  std::chrono::nanoseconds before{};
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(process, &status, WNOHANG)) == 0) {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::nanoseconds taken = processor_time(process);
    if (taken != before) moved = now;
    before = taken;
    if (taken > kMaxTime || now - moved > kMaxRest) {
      hung = "does not end; its threads:\n" + threads_of(process);
      kill(process, SIGKILL);
      ended = waitpid(process, &status, 0);
      break;
    }
    std::this_thread::sleep_for(kPause);
  }
  if (ended != process) throw std::runtime_error("cannot wait for " GNOMON_PROGRAM);
  return status;
}

}  // namespace

Finished run_process(const std::vector<std::string>& arguments, const std::string& input,
                     const std::filesystem::path& out_file, int (*run)(std::vector<char*>& argv)) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in", input);
  const std::string out = out_file.empty() ? folder.write("out", "") : out_file.string();
  const std::string err = folder.write("err", "");
  std::vector<std::string> words{GNOMON_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  std::fflush(nullptr);
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("cannot start " GNOMON_PROGRAM);
  if (process == 0) {
    const bool ready = dup2(open(in.c_str(), O_RDONLY), 0) == 0 &&
                       dup2(open(out.c_str(), O_WRONLY), 1) == 1 && dup2(open(err.c_str(), O_WRONLY), 2) == 2;
    const int code = ready ? run(argv) : 127;
    std::cout.flush();
    std::fflush(nullptr);
    // Not exit: libraries end threads there that a forked process does not have.
    _exit(code);
  }
  Finished finished;
  std::string trouble;
  const int status = status_of(process, trouble);
  if (WIFSIGNALED(status)) trouble += "ended by signal " + std::to_string(WTERMSIG(status)) + "\n";
  finished.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (out_file.empty()) finished.out = content_of(out);
  finished.err = content_of(err) + trouble;
  return finished;
}

std::vector<std::string> Finished::lines() const {
  std::vector<std::string> lines;
  std::istringstream stream(out);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

Finished spawn_gnomon(const std::vector<std::string>& arguments, const std::string& input,
                      const std::filesystem::path& out_file) {
  return run_process(arguments, input, out_file, [](std::vector<char*>& argv) {
    execv(argv[0], argv.data());
    return 127;
  });
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "gnomon_test_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  // What programs keep beside their output lies within as well.
  path_ = std::filesystem::path(name) / "folder";
  std::filesystem::create_directory(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_.parent_path(), ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
  const std::filesystem::path file = path_ / name;
  std::ofstream(file, std::ios::binary) << content;
  return file.string();
}

}  // namespace gnomon::test
