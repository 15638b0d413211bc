// A progress bar for people: drawn on standard error if that is a terminal, and only once work takes over a
// second.
#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace gnomon::tool {

Progress::Progress(std::string label, long long total)
    : label_(std::move(label)),
      total_(total),
      next_draw_(Clock::now() + std::chrono::seconds(1)),
      on_terminal_(isatty(STDERR_FILENO) == 1) {}

void Progress::set(long long done) {
  if (!on_terminal_) return;
  const auto now = Clock::now();
  if (now < next_draw_) return;
  next_draw_ = now + std::chrono::milliseconds(100);
  drawn_ = true;
  if (total_ <= 0) {
    std::fprintf(stderr, "\r%s: %lld\033[K", label_.c_str(), done);
    return;
  }
  constexpr int kBarWidth = 30;
  const double share = std::clamp(static_cast<double>(done) / static_cast<double>(total_), 0.0, 1.0);
  const std::string bar(static_cast<std::size_t>(share * kBarWidth), '#');
  std::fprintf(stderr, "\r%s [%-*s] %3.0f %%\033[K", label_.c_str(), kBarWidth, bar.c_str(), 100.0 * share);
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace gnomon::tool
