// Draws over one line of standard error.
#include "progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace flythrough {

Progress::Progress(int total) : total_(total), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::show(int done, std::string_view what) {
  if (!terminal_) return;
  constexpr int kCells = 30;
  const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  const auto full = static_cast<std::size_t>(kCells * done / total_);
  const std::string bar = std::string(full, '#') + std::string(kCells - full, '.');
  const std::string left = done == 0 ? "" : fmt::format(", {:.0f} s left", passed * (total_ - done) / done);
  fmt::print(stderr, "\r\033[K[{}] {}/{} {}{}", bar, done, total_, what, left);
  std::fflush(stderr);
}

}  // namespace flythrough
