// Void and cluster: values are given one after the other to the pixel that is farthest from those that have
// one. Based on: Ulichney, "The void-and-cluster method for dither array generation", 1993.
#include "frame/blue_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/random.hpp"

namespace gnomon::render {
namespace {

constexpr int kSide = kBlueNoiseSide;
constexpr std::size_t kPixels = std::size_t{kSide} * kSide;

/// A pattern of marked pixels and how crowded it is round every pixel, on a tile that repeats.
class Pattern {
 public:
  Pattern() {
    constexpr double kDeviation = 1.5;  // pixels: the paper's
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const int dx = std::min(x, kSide - x), dy = std::min(y, kSide - y);
        weight_[index(x, y)] = std::exp(-(dx * dx + dy * dy) / (2.0 * kDeviation * kDeviation));
      }
    }
  }

  void set(std::size_t pixel, bool marked) {
    marked_[pixel] = marked;
    const int at_x = static_cast<int>(pixel) % kSide, at_y = static_cast<int>(pixel) / kSide;
    const double sign = marked ? 1.0 : -1.0;
    constexpr int kReach = 9;  // six deviations: below a double's rounding of the sums that matter
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx)
        crowd_[index((at_x + dx + kSide) % kSide, (at_y + dy + kSide) % kSide)] +=
            sign * weight_[index((dx + kSide) % kSide, (dy + kSide) % kSide)];
    }
  }
  [[nodiscard]] bool marked(std::size_t pixel) const { return marked_[pixel]; }
  /// The marked pixel that is crowded most.
  [[nodiscard]] std::size_t tightest_cluster() const {
    std::size_t best = kPixels;
    for (std::size_t i = 0; i < kPixels; ++i)
      if (marked_[i] && (best == kPixels || crowd_[i] > crowd_[best])) best = i;
    return best;
  }
  /// The pixel without a mark that is crowded least.
  [[nodiscard]] std::size_t largest_void() const {
    std::size_t best = kPixels;
    for (std::size_t i = 0; i < kPixels; ++i)
      if (!marked_[i] && (best == kPixels || crowd_[i] < crowd_[best])) best = i;
    return best;
  }

 private:
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kSide + x); }
  std::array<double, kPixels> weight_{}, crowd_{};
  std::array<bool, kPixels> marked_{};
};

}  // namespace

std::vector<float> blue_noise() {
  constexpr std::size_t kFirst = kPixels / 10;  // marks that are spread before any gets its value
  Pattern pattern;
  Random random(1);
  for (std::size_t marks = 0; marks < kFirst;) {
    const auto pixel = static_cast<std::size_t>(random.pick(static_cast<int>(kPixels)));
    if (pattern.marked(pixel)) continue;
    pattern.set(pixel, true);
    ++marks;
  }
  for (std::size_t steps = 0; steps < kPixels; ++steps) {
    const std::size_t from = pattern.tightest_cluster();
    pattern.set(from, false);
    const std::size_t to = pattern.largest_void();
    pattern.set(to, true);
    if (to == from) break;
  }
  std::vector<float> values(kPixels);
  const auto give = [&values](std::size_t pixel, std::size_t rank) {
    values[pixel] = (static_cast<float>(rank) + 0.5f) / static_cast<float>(kPixels);
  };
  Pattern thinned = pattern;
  for (std::size_t rank = kFirst; rank-- > 0;) {
    const std::size_t pixel = thinned.tightest_cluster();
    thinned.set(pixel, false);
    give(pixel, rank);
  }
  for (std::size_t rank = kFirst; rank < kPixels; ++rank) {
    const std::size_t pixel = pattern.largest_void();
    pattern.set(pixel, true);
    give(pixel, rank);
  }
  return values;
}

}  // namespace gnomon::render
