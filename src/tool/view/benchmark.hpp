// A fixed flight along the path: the same frames on every machine, and a row of figures for each.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "stage.hpp"
#include "state.hpp"

namespace gnomon::tool::view {

class Benchmark {
 public:
  /// `from`: what is shown. Its path is flown once, in `frames` even steps; its sun and its animation move on
  /// by the time that a step of the path takes, where the state has them moving.
  /// `renderer`: named in every row.
  Benchmark(const State& from, int frames, std::filesystem::path file, std::string renderer);

  /// The state of the next frame. The last is drawn before the first as well, and does not count: it fills
  /// caches.
  [[nodiscard]] State next() const;
  /// The figures of next(), as it was drawn; `frame_ms`: all of the drawing, planning included.
  void take(const Stage& stage, double frame_ms);
  [[nodiscard]] bool done() const noexcept { return frame_ >= frames_; }

  [[nodiscard]] int frame() const noexcept { return std::max(frame_, 0); }
  [[nodiscard]] int frames() const noexcept { return frames_; }
  [[nodiscard]] const State& before() const noexcept { return from_; }
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  /// The rows with their head, as CSV.
  [[nodiscard]] std::string text() const;
  /// Median and 95th percentile of side A's time of shadows.
  [[nodiscard]] std::string summary() const;

 private:
  State from_;
  int frames_, frame_ = -1;
  std::filesystem::path file_;
  std::string renderer_, rows_;
  std::vector<double> total_ms_;
};

}  // namespace gnomon::tool::view
