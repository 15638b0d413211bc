// Random numbers that are the same on every platform, which std::uniform_real_distribution's are not.
#pragma once

#include <cstdint>
#include <random>

namespace gnomon {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1).
  [[nodiscard]] double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  [[nodiscard]] double between(double low, double high) { return low + (high - low) * unit(); }
  /// One of 0 ... count - 1.
  [[nodiscard]] int pick(int count) { return static_cast<int>(unit() * count); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace gnomon
