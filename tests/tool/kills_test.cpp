// What do `fly`, `view` and `report` leave behind where they are killed? Whole files, or files under another
// name.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <functional>
#include <random>
#include <thread>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

using Arguments = std::vector<std::string>;

pid_t start(const Arguments& arguments) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  (void)!std::freopen("/dev/null", "w", stdout);
  (void)!std::freopen("/dev/null", "w", stderr);
  std::vector<char*> argv{const_cast<char*>(GNOMON_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execv(GNOMON_PROGRAM, argv.data());
  ::_exit(127);
}

/// Kills a process as soon as it has begun to write for the n-th time in the folder or one below it; false
/// where it ended before.
bool kill_while_writing(const fs::path& folder, int writes, int signal, const Arguments& arguments) {
  const int events = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  EXPECT_GE(events, 0);
  ::inotify_add_watch(events, folder.c_str(), IN_CREATE | IN_MODIFY);
  for (const auto& below : fs::recursive_directory_iterator(folder))
    if (below.is_directory()) ::inotify_add_watch(events, below.path().c_str(), IN_CREATE | IN_MODIFY);
  const pid_t child = start(arguments);
  int status = 0, seen = 0;
  for (;;) {
    if (::waitpid(child, &status, WNOHANG) == child) break;
    pollfd ready{events, POLLIN, 0};
    if (::poll(&ready, 1, 10) <= 0) continue;
    alignas(inotify_event) char buffer[4096];
    const ssize_t bytes = ::read(events, buffer, sizeof buffer);
    for (ssize_t at = 0; at < bytes; ++seen)
      at += static_cast<ssize_t>(sizeof(inotify_event)) +
            reinterpret_cast<const inotify_event*>(buffer + at)->len;
    if (seen < writes) continue;
    ::kill(child, signal);
    ::waitpid(child, &status, 0);
    break;
  }
  ::close(events);
  return WIFSIGNALED(status) && WTERMSIG(status) == signal;
}

/// Kills a process once it has taken so much of the processor; false where it ended before.
bool kill_after(std::chrono::nanoseconds taken, int signal, const Arguments& arguments) {
  const pid_t child = start(arguments);
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (processor_time(child) >= taken) {
      ::kill(child, signal);
      ::waitpid(child, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return WIFSIGNALED(status) && WTERMSIG(status) == signal;
}

/// The name of a file that is being written: readers do not ask for it.
bool is_aside(const fs::path& file) {
  const std::string end = file.extension().string();
  return end.size() > 1 &&
         std::all_of(end.begin() + 1, end.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// By what a file of this kind ends with.
bool is_whole(const fs::path& file) {
  const std::string text = content_of(file), kind = file.extension().string();
  if (kind == ".png") return text.starts_with("\x89PNG") && text.ends_with("IEND\xAE\x42\x60\x82");
  if (kind == ".svg") return text.ends_with("</svg>\n") || text.ends_with("</svg>");
  if (kind == ".html") return text.ends_with("</html>\n");
  if (kind == ".json") return text.ends_with("}\n");
  return (kind == ".csv" || kind == ".md" || kind == ".tex" || kind == ".jsonl") && text.ends_with("\n");
}

struct Left {
  int whole = 0, aside = 0;
};
Left expect_whole_files(const fs::path& folder) {
  Left left;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().filename() == "results.lock") continue;
    if (is_aside(entry.path())) {
      ++left.aside;
      continue;
    }
    EXPECT_TRUE(is_whole(entry.path())) << entry.path() << ", " << entry.file_size() << " bytes";
    ++left.whole;
  }
  return left;
}

/// Runs the command to its end, then kills it at some of its writes and at random moments, into an empty
/// folder and over what is there.
void expect_whole_after_kills(const std::function<Arguments(const fs::path&)>& command,
                              const std::function<void(const fs::path&)>& prepare) {
  const TemporaryFolder folder;
  const fs::path first = folder.path() / "first";
  prepare(first);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(spawn_gnomon(command(first)).exit_code, 0);
  const std::chrono::nanoseconds all_of_it = std::chrono::steady_clock::now() - begin;
  const int files = expect_whole_files(first).whole;
  ASSERT_GT(files, 0);
  std::mt19937 random(11);
  int kills = 0, aside = 0;
  const auto kill_at_write = [&](const fs::path& out, int writes, int signal) {
    kills += kill_while_writing(out, writes, signal, command(out)) ? 1 : 0;
    const Left left = expect_whole_files(out);
    aside += left.aside;
    if (out == first) {
      EXPECT_EQ(left.whole, files);
    }
  };
  for (const int signal : {SIGKILL, SIGTERM}) {
    for (const bool over : {false, true}) {
      const fs::path out = over ? first : folder.path() / std::to_string(signal);
      if (!over) prepare(out);
      for (const int writes : {1, 1 + static_cast<int>(random() % 4)}) kill_at_write(out, writes, signal);
      kills += kill_after(all_of_it * static_cast<int>(random() % 100) / 100, signal, command(out)) ? 1 : 0;
      expect_whole_files(out);
    }
  }
  // On a busy machine a kill comes after the write that it was meant for.
  constexpr int kKills = 4;
  const auto latest = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while ((kills < kKills || aside == 0) && std::chrono::steady_clock::now() < latest)
    kill_at_write(first, 1, SIGKILL);
  EXPECT_GE(kills, kKills);
  EXPECT_GT(aside, 0) << "no kill fell into a write";
  EXPECT_EQ(spawn_gnomon(command(first)).exit_code, 0);
  EXPECT_EQ(expect_whole_files(first).whole, files);
}

void make_folder(const fs::path& folder) {
  fs::create_directories(folder);
}

TEST(Kills, leave_whole_files_of_fly) {
  expect_whole_after_kills(
      [](const fs::path& out) {
        return Arguments{"fly",        "builtin:fence", "--frames",  "2",      "--size", "64x36",
                         "--map-size", "128",           "--context", "osmesa", "--out",  out.string()};
      },
      make_folder);
}

TEST(Kills, leave_whole_pictures_of_view) {
  expect_whole_after_kills(
      [](const fs::path& out) {
        return Arguments{"view", "builtin:fence", "--size", "640x360", "--map-size",
                         "128",  "--context",     "osmesa", "--out",   (out / "view.png").string()};
      },
      make_folder);
}

TEST(Kills, leave_whole_pages_of_report) {
  expect_whole_after_kills(
      [](const fs::path& out) {
        return Arguments{"report", out.string()};
      },
      [](const fs::path& out) {
        fs::copy(whole(), out, fs::copy_options::recursive);
        // All but what was measured.
        for (const char* made : {"report.html", "summary.csv", "frames.csv", "fronts.md"})
          fs::remove(out / made);
      });
}

}  // namespace
}  // namespace gnomon::test
