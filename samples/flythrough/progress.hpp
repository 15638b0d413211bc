// A progress bar with the time left, on a terminal only.
#pragma once

#include <chrono>
#include <string_view>

namespace flythrough {

class Progress {
 public:
  explicit Progress(int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `done` of the total are finished; `what` is under way.
  void show(int done, std::string_view what);

 private:
  int total_;
  bool terminal_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace flythrough
