// Every broken or unusual file loads or is refused with one line. Each runs in a process of its own, so that
// a crash or a hang is a failure of that file and not of the test.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "gtest/gtest.h"
#include "shared_files.hpp"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Of the processor, which other programs on the machine do not use up; and by the clock for one that waits.
constexpr rlim_t kProcessorSeconds = 20;
constexpr std::chrono::seconds kPatience{240};
constexpr std::size_t kAtOnce = 2;  // processes; most of their time is the start of OpenImageIO

enum class Outcome { loaded, refused };
using Outcomes = std::map<fs::path, Outcome>;

struct Run {
  fs::path file, output;
  pid_t process;
  Clock::time_point begin;
};

Run start(const fs::path& file, const fs::path& output) {
  const pid_t process = ::fork();
  if (process == 0) {
    const int out = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600),
              nothing = ::open("/dev/null", O_WRONLY);
    ::dup2(nothing, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    const rlimit seconds{kProcessorSeconds, kProcessorSeconds};
    ::setrlimit(RLIMIT_CPU, &seconds);
    ::execl(GNOMON_LOAD_SCENE_MAIN, GNOMON_LOAD_SCENE_MAIN, file.c_str(), nullptr);
    ::_exit(127);
  }
  return {file, output, process, Clock::now()};
}

std::string text_of(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

// True once the process has ended; notes how, and fails the test unless it ended as it should.
bool is_done(const Run& run, Outcomes& outcomes) {
  int status = 0;
  if (::waitpid(run.process, &status, WNOHANG) == 0) {
    if (Clock::now() - run.begin < kPatience) return false;
    ::kill(run.process, SIGKILL);
    ::waitpid(run.process, &status, 0);
    ADD_FAILURE() << run.file << " took more than " << kPatience.count() << " s";
    return true;
  }
  const std::string said = text_of(run.output);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  if (code == 0) {
    outcomes[run.file] = Outcome::loaded;
    EXPECT_EQ(said, "") << run.file;
  } else if (code == 2) {
    outcomes[run.file] = Outcome::refused;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << run.file << " said: " << said;
    EXPECT_NE(said.find(run.file.string() + ": "), std::string::npos) << said;
  } else {
    ADD_FAILURE() << run.file << " ended with " << code << ": " << said;
  }
  return true;
}

Outcomes run_all(const std::vector<fs::path>& files) {
  Outcomes outcomes;
  std::vector<Run> running;
  const fs::path temporary = fs::temp_directory_path() / ("gnomon_robustness_" + std::to_string(::getpid()));
  fs::create_directories(temporary);
  std::size_t next = 0;
  while (next < files.size() || !running.empty()) {
    while (next < files.size() && running.size() < kAtOnce) {
      running.push_back(start(files[next], temporary / std::to_string(next)));
      ++next;
    }
    std::erase_if(running, [&](const Run& run) { return is_done(run, outcomes); });
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::error_code ignored;
  fs::remove_all(temporary, ignored);
  return outcomes;
}

TEST(GltfRobustness, a_file_that_is_not_there_is_refused_with_one_line) {
  const auto outcomes = run_all({"/nonexistent/scene.gltf"});
  EXPECT_EQ(outcomes, (Outcomes{{"/nonexistent/scene.gltf", Outcome::refused}}));
}

TEST(GltfRobustness, every_file_loads_or_is_refused_with_one_line_and_valid_ones_load) {
  const auto files = gltf_files(shared_folder() / "gltf-robustness");
  if (files.empty()) GTEST_SKIP() << "no shared/gltf-robustness";
  const Outcomes outcomes = run_all(files);
  int loaded = 0, refused = 0;
  for (const auto& [file, outcome] : outcomes) {
    loaded += outcome == Outcome::loaded ? 1 : 0;
    refused += outcome == Outcome::refused ? 1 : 0;
    // The asset generator's files are valid glTF, however unusual.
    if (file.string().find("asset-generator") != std::string::npos) {
      EXPECT_EQ(outcome, Outcome::loaded) << file;
    }
  }
  std::printf("loaded: %d, refused: %d\n", loaded, refused);
  EXPECT_EQ(outcomes.size(), files.size());
  EXPECT_GT(loaded, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace gnomon::test
