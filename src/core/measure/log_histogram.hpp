// Percentiles of many numbers without keeping them.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/vector.hpp"

namespace gnomon {

/// Counts positive numbers by exponent and the first kBits bits of their mantissa: bins 2^-kBits wide,
/// relative to the number (10 bits: 0.1 %, 320 KiB; 6 bits: 1.6 %, 20 KiB), and no logarithm.
template <int kBits>
class LogHistogram {
 public:
  void add(double value) noexcept {
    ++count_;
    if (value > largest_) largest_ = value;
    ++bins_[bin_of(value)];
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] double largest() const noexcept { return largest_; }
  /// Middle of the bin that holds the value below which `share` of the values lie.
  [[nodiscard]] double percentile(double share) const noexcept {
    const double wanted = share * static_cast<double>(count_);
    double seen = 0.0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      seen += static_cast<double>(bins_[i]);
      if (seen >= wanted && seen > 0.0) return min_of(middle_of(i), largest_);
    }
    return largest_;
  }

 private:
  static constexpr int kShift = 52 - kBits;
  static constexpr int kLowestExponent = -40, kHighestExponent = 40;
  static constexpr std::uint64_t kFirst = static_cast<std::uint64_t>(1023 + kLowestExponent) << kBits;
  static constexpr std::size_t kBins = static_cast<std::size_t>(kHighestExponent - kLowestExponent) << kBits;

  static std::size_t bin_of(double value) noexcept {
    const std::uint64_t top = std::bit_cast<std::uint64_t>(value) >> kShift;
    if (!(value > 0.0) || top < kFirst) return 0;
    return top - kFirst < kBins ? static_cast<std::size_t>(top - kFirst) : kBins - 1;
  }
  static double middle_of(std::size_t bin) noexcept {
    const std::uint64_t half = std::uint64_t{1} << (kShift - 1);
    return std::bit_cast<double>(((static_cast<std::uint64_t>(bin) + kFirst) << kShift) | half);
  }

  std::array<std::uint32_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double largest_ = 0.0;
};

}  // namespace gnomon
