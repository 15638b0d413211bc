// Progress for people, on standard error: a bar on a terminal, else a line now and then.
#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace gnomon::tool {

Progress::Progress(std::string label, long long total, double most_seconds)
    : label_(std::move(label)),
      total_(total),
      most_seconds_(most_seconds),
      begin_(Clock::now()),
      next_draw_(begin_ + std::chrono::seconds(1)),
      on_terminal_(isatty(STDERR_FILENO) == 1) {}

/// As long again as it took so far, by the share that is left.
std::string Progress::time_left(double share, double seconds_so_far) const {
  if (share <= 0.0) return {};
  double left = seconds_so_far * (1.0 - share) / share;
  if (most_seconds_ > 0.0) left = std::min(left, std::max(most_seconds_ - seconds_so_far, 0.0));
  const auto seconds = static_cast<long long>(left + 0.5);
  char text[32];
  std::snprintf(text, sizeof text, ", %lld:%02lld left", seconds / 60, seconds % 60);
  return text;
}

/// A log of hours has some fifty lines.
void Progress::write_line(long long done, Clock::time_point now) {
  constexpr std::chrono::seconds kShort{10}, kOften{5};
  const auto so_far = now - begin_;
  const double share = static_cast<double>(done) / static_cast<double>(std::max(total_, 1LL));
  const double seconds = std::chrono::duration<double>(so_far).count();
  const bool is_first = next_draw_ == begin_ + std::chrono::seconds(1);
  if (done <= 0 || total_ <= 0 ||
      (is_first && std::chrono::duration<double>(kShort).count() * share > seconds))
    return;
  next_draw_ = now + std::max<Clock::duration>(kOften, so_far / 10);
  std::fprintf(stderr, "%s: %lld of %lld%s\n", label_.c_str(), done, total_,
               time_left(share, seconds).c_str());
}

void Progress::set(long long done) {
  const auto now = Clock::now();
  if (now < next_draw_) return;
  if (!on_terminal_) return write_line(done, now);
  next_draw_ = now + std::chrono::milliseconds(100);
  drawn_ = true;
  if (total_ <= 0) {
    std::fprintf(stderr, "\r%s: %lld\033[K", label_.c_str(), done);
    return;
  }
  constexpr int kBarWidth = 30;
  const double share = std::clamp(static_cast<double>(done) / static_cast<double>(total_), 0.0, 1.0);
  const std::string bar(static_cast<std::size_t>(share * kBarWidth), '#');
  std::fprintf(stderr, "\r%s [%-*s] %3.0f %%%s\033[K", label_.c_str(), kBarWidth, bar.c_str(), 100.0 * share,
               time_left(share, std::chrono::duration<double>(now - begin_).count()).c_str());
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace gnomon::tool
