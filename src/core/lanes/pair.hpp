// Two numbers side by side, worked on at once: the width that every 64-bit processor's vectors have.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace gnomon {

/// Each operation is the scalar one on both numbers, to the last bit.
class Pair {
 public:
  Pair() noexcept = default;
#if defined(__SSE2__)
  Pair(double low, double high) noexcept : v_(_mm_set_pd(high, low)) {}
  explicit Pair(double both) noexcept : v_(_mm_set1_pd(both)) {}
  /// Two numbers that follow each other in memory.
  [[nodiscard]] static Pair from(const double* p) noexcept {
    return _mm_loadu_pd(p);
  }
  void to(double* p) const noexcept {
    _mm_storeu_pd(p, v_);
  }
  [[nodiscard]] double low() const noexcept {
    return _mm_cvtsd_f64(v_);
  }
  [[nodiscard]] double high() const noexcept {
    return _mm_cvtsd_f64(_mm_unpackhi_pd(v_, v_));
  }

  friend Pair operator+(Pair a, Pair b) noexcept {
    return _mm_add_pd(a.v_, b.v_);
  }
  friend Pair operator-(Pair a, Pair b) noexcept {
    return _mm_sub_pd(a.v_, b.v_);
  }
  friend Pair operator*(Pair a, Pair b) noexcept {
    return _mm_mul_pd(a.v_, b.v_);
  }
  friend Pair operator/(Pair a, Pair b) noexcept {
    return _mm_div_pd(a.v_, b.v_);
  }
  friend Pair min_of(Pair a, Pair b) noexcept {
    return _mm_min_pd(a.v_, b.v_);
  }
  friend Pair max_of(Pair a, Pair b) noexcept {
    return _mm_max_pd(a.v_, b.v_);
  }
  friend Pair sqrt(Pair a) noexcept {
    return _mm_sqrt_pd(a.v_);
  }
  friend Pair abs(Pair a) noexcept {
    return _mm_andnot_pd(_mm_set1_pd(-0.0), a.v_);
  }
  /// The low numbers of both, and the high ones.
  friend Pair lows(Pair a, Pair b) noexcept {
    return _mm_unpacklo_pd(a.v_, b.v_);
  }
  friend Pair highs(Pair a, Pair b) noexcept {
    return _mm_unpackhi_pd(a.v_, b.v_);
  }
  /// Bit 0: a.low() < b.low(), bit 1: a.high() < b.high().
  friend std::uint32_t below(Pair a, Pair b) noexcept {
    return static_cast<std::uint32_t>(_mm_movemask_pd(_mm_cmplt_pd(a.v_, b.v_)));
  }
  /// The same of >=. Where a number is none, neither is set.
  friend std::uint32_t at_least(Pair a, Pair b) noexcept {
    return static_cast<std::uint32_t>(_mm_movemask_pd(_mm_cmpge_pd(a.v_, b.v_)));
  }

 private:
  Pair(__m128d v) noexcept : v_(v) {}
  __m128d v_;
#else
  Pair(double low, double high) noexcept : low_(low), high_(high) {}
  explicit Pair(double both) noexcept : low_(both), high_(both) {}
  /// Two numbers that follow each other in memory.
  [[nodiscard]] static Pair from(const double* p) noexcept {
    return {p[0], p[1]};
  }
  void to(double* p) const noexcept {
    p[0] = low_;
    p[1] = high_;
  }
  [[nodiscard]] double low() const noexcept {
    return low_;
  }
  [[nodiscard]] double high() const noexcept {
    return high_;
  }

  friend Pair operator+(Pair a, Pair b) noexcept {
    return {a.low_ + b.low_, a.high_ + b.high_};
  }
  friend Pair operator-(Pair a, Pair b) noexcept {
    return {a.low_ - b.low_, a.high_ - b.high_};
  }
  friend Pair operator*(Pair a, Pair b) noexcept {
    return {a.low_ * b.low_, a.high_ * b.high_};
  }
  friend Pair operator/(Pair a, Pair b) noexcept {
    return {a.low_ / b.low_, a.high_ / b.high_};
  }
  friend Pair min_of(Pair a, Pair b) noexcept {
    return {a.low_ < b.low_ ? a.low_ : b.low_, a.high_ < b.high_ ? a.high_ : b.high_};
  }
  friend Pair max_of(Pair a, Pair b) noexcept {
    return {a.low_ > b.low_ ? a.low_ : b.low_, a.high_ > b.high_ ? a.high_ : b.high_};
  }
  friend Pair sqrt(Pair a) noexcept {
    return {std::sqrt(a.low_), std::sqrt(a.high_)};
  }
  friend Pair abs(Pair a) noexcept {
    return {std::abs(a.low_), std::abs(a.high_)};
  }
  /// The low numbers of both, and the high ones.
  friend Pair lows(Pair a, Pair b) noexcept {
    return {a.low_, b.low_};
  }
  friend Pair highs(Pair a, Pair b) noexcept {
    return {a.high_, b.high_};
  }
  /// Bit 0: a.low() < b.low(), bit 1: a.high() < b.high().
  friend std::uint32_t below(Pair a, Pair b) noexcept {
    return static_cast<std::uint32_t>(a.low_ < b.low_) | static_cast<std::uint32_t>(a.high_ < b.high_) << 1;
  }
  /// The same of >=. Where a number is none, neither is set.
  friend std::uint32_t at_least(Pair a, Pair b) noexcept {
    return static_cast<std::uint32_t>(a.low_ >= b.low_) | static_cast<std::uint32_t>(a.high_ >= b.high_) << 1;
  }

 private:
  double low_, high_;
#endif
};

/// Calls `use` with each even index and `Two` of the items there and behind it. The last of an odd number
/// comes with itself.
template <typename Two, typename Use>
inline void for_each_two(std::span<const typename Two::One> items, Use&& use) noexcept {
  for (std::size_t i = 0; i < items.size(); i += 2)
    use(i, Two(items[i], items[i + 1 < items.size() ? i + 1 : i]));
}

}  // namespace gnomon
