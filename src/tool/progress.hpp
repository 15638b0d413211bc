// Progress for people, on standard error, once work takes over a second: a bar on a terminal; else, where
// work will take over ten seconds, a line now and then.
#pragma once

#include <chrono>
#include <string>

namespace gnomon::tool {

class Progress {
 public:
  /// `total`: steps in all; 0 where nobody knows, then only the count is shown. `most_seconds`: what it may
  /// take in all, for work that ends unfinished then; 0: as long as it takes.
  Progress(std::string label, long long total, double most_seconds = 0.0);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets the steps done so far; draws at most ten times a second, and writes lines ever more rarely.
  void set(long long done);
  /// Takes the bar off the terminal, before other output is written there.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void write_line(long long done, Clock::time_point now);
  /// ", 1:05 left", or nothing before the first steps tell.
  [[nodiscard]] std::string time_left(double share, double seconds_so_far) const;

  std::string label_;
  long long total_;
  double most_seconds_;
  Clock::time_point begin_, next_draw_;
  bool on_terminal_;
  bool drawn_ = false;
};

}  // namespace gnomon::tool
