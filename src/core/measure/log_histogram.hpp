// Percentiles of many numbers without keeping them, in little memory.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/vector.hpp"

namespace gnomon {

/// Counts positive numbers by exponent and the first kBits bits of their mantissa: bins 2^-kBits wide,
/// relative to the number (10 bits: 0.1 %), and no logarithm.
///
/// 64 bins are a group. The first kGroups that occur have a count for each bin, all others one for the whole:
/// a small thread's stack has no room for every bin. As a rule no more groups occur. Where a percentile lies
/// in one without bins, the same numbers are counted once more (count_again).
template <int kBits, std::size_t kGroups>
class LogHistogram {
 public:
  void add(double value) noexcept {
    ++count_;
    if (value > largest_) largest_ = value;
    const std::size_t bin = bin_of(value), group = bin / kGroup;
    if (place_[group] == kNone && !make_place(group)) return;
    if (++low_[place_[group] * kGroup + bin % kGroup] == 0) carry(bin);
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] double largest() const noexcept { return largest_; }
  /// Whether the bins of these percentiles were counted.
  [[nodiscard]] bool knows(std::span<const double> shares) const noexcept {
    for (const double share : shares) {
      const std::size_t group = find(share).group;
      if (group < kAllGroups && (place_[group] == kNone || overflowed_)) return false;
    }
    return true;
  }
  /// Middle of the bin that holds the value below which `share` of the values lie. Needs knows().
  [[nodiscard]] double percentile(double share) const noexcept {
    const Found found = find(share);
    if (found.group == kAllGroups) return largest_;
    double seen = found.before;
    for (std::size_t bin = found.group * kGroup; bin < (found.group + 1) * kGroup; ++bin) {
      seen += static_cast<double>(counted(bin));
      if (seen >= found.wanted && seen > 0.0) return min_of(middle_of(bin), largest_);
    }
    return largest_;
  }
  /// Forgets all numbers: from now on the bins of these percentiles count, at most kMaxShares of them. The
  /// same numbers are to be added again.
  void count_again(std::span<const double> shares) noexcept {
    std::array<std::size_t, kMaxShares> group{};
    for (std::size_t i = 0; i < shares.size(); ++i) group[i] = find(shares[i]).group;
    clear();
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (group[i] < kAllGroups && place_[group[i]] == kNone)
        place_[group[i]] = static_cast<std::uint8_t>(used_++);
    }
    used_ = kGroups;
  }
  static constexpr std::size_t kMaxShares = 3;

 private:
  static constexpr int kShift = 52 - kBits;
  static constexpr int kLowestExponent = -40, kHighestExponent = 40;
  static constexpr std::uint64_t kFirst = static_cast<std::uint64_t>(1023 + kLowestExponent) << kBits;
  static constexpr std::size_t kBins = static_cast<std::size_t>(kHighestExponent - kLowestExponent) << kBits;
  static constexpr std::size_t kGroup = 64, kAllGroups = kBins / kGroup;
  static constexpr std::uint8_t kNone = 0xff;
  static_assert(kGroups >= kMaxShares && kGroups < kNone);

  static std::size_t bin_of(double value) noexcept {
    const std::uint64_t top = std::bit_cast<std::uint64_t>(value) >> kShift;
    if (!(value > 0.0) || top < kFirst) return 0;
    return top - kFirst < kBins ? static_cast<std::size_t>(top - kFirst) : kBins - 1;
  }
  static double middle_of(std::size_t bin) noexcept {
    const std::uint64_t half = std::uint64_t{1} << (kShift - 1);
    return std::bit_cast<double>(((static_cast<std::uint64_t>(bin) + kFirst) << kShift) | half);
  }

  /// Counts the value itself where there is no place.
  [[nodiscard]] bool make_place(std::size_t group) noexcept {
    if (used_ == kGroups) {
      ++without_[group];
      return false;
    }
    place_[group] = static_cast<std::uint8_t>(used_++);
    return true;
  }
  [[nodiscard]] std::uint64_t total(std::size_t group) const noexcept {
    if (place_[group] == kNone) return without_[group];
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < kGroup; ++i) sum += low_[place_[group] * kGroup + i];
    for (const Carry& carry : std::span(carry_).first(carried_)) {
      if (carry.bin / kGroup == group) sum += std::uint64_t{carry.times} << 16;
    }
    return sum;
  }
  /// The group that holds a percentile, kAllGroups for none, and how many values lie before it.
  struct Found {
    std::size_t group;
    double before, wanted;
  };
  [[nodiscard]] Found find(double share) const noexcept {
    Found found{0, 0.0, share * static_cast<double>(count_)};
    for (; found.group < kAllGroups; ++found.group) {
      const double with = found.before + static_cast<double>(total(found.group));
      if (with >= found.wanted && with > 0.0) break;
      found.before = with;
    }
    return found;
  }
  /// The bin's count has passed 2^16.
  void carry(std::size_t bin) noexcept {
    std::size_t i = 0;
    while (i < carried_ && carry_[i].bin != bin) ++i;
    if (i == carry_.size()) {
      overflowed_ = true;
      return;
    }
    if (i == carried_) carry_[carried_++] = {static_cast<std::uint32_t>(bin), 0};
    ++carry_[i].times;
  }
  [[nodiscard]] std::uint64_t counted(std::size_t bin) const noexcept {
    std::uint64_t high = 0;
    for (const Carry& carry : std::span(carry_).first(carried_)) {
      if (carry.bin == bin) high = carry.times;
    }
    return (high << 16) + low_[place_[bin / kGroup] * kGroup + bin % kGroup];
  }
  void clear() noexcept {
    low_.fill(0);
    without_.fill(0);
    place_.fill(kNone);
    carried_ = used_ = 0;
    count_ = 0;
    largest_ = 0.0;
    overflowed_ = false;
  }

  struct Carry {
    std::uint32_t bin, times;
  };
  std::array<std::uint16_t, kGroups * kGroup> low_;
  std::array<std::uint32_t, kAllGroups> without_;  // of groups without a place
  std::array<std::uint8_t, kAllGroups> place_;
  std::array<Carry, kMaxShares * kGroup> carry_;  // enough for every bin that is counted a second time
  std::size_t carried_, used_;
  std::uint64_t count_;
  double largest_;
  bool overflowed_;

 public:
  LogHistogram() noexcept { clear(); }
};

}  // namespace gnomon
