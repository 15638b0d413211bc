// Eight boxes against a plane at once: the one test that all culling of casters goes through.
#pragma once

#include <bit>
#include <glm/vec4.hpp>

#include "geometry/usable.hpp"
#include "gnomon/caster_set.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace gnomon {

constexpr std::size_t kLanes = CasterBlock::kLanes;

inline void set_lane(CasterBlock& block, std::size_t lane, const Box& box) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    block.min[axis][lane] = box.min[static_cast<int>(axis)];
    block.max[axis][lane] = box.max[static_cast<int>(axis)];
  }
  const auto bit = static_cast<std::uint8_t>(1u << lane);
  const bool empty = box.empty();
  block.occupied = static_cast<std::uint8_t>(empty ? block.occupied & ~bit : block.occupied | bit);
  block.full = block.occupied;
  block.unusable = static_cast<std::uint8_t>(usable(box) ? block.unusable & ~bit : block.unusable | bit);
}

/// Which corner of a box a sum is taken at, and what of the sum is asked.
enum class Ask : std::uint8_t {
  outside,  ///< the corner farthest inside is outside: so is the box
  across,   ///< the corner farthest outside is not inside
};

/// Bit per lane. The sums are in one order for all that cull, for the same rounding. A sum that is no number
/// (an endless box) is neither outside nor inside.
template <Ask ask>
[[nodiscard]] inline std::uint32_t lanes(const glm::dvec4& plane, const CasterBlock& block) noexcept {
  const auto corner = [&](std::size_t axis, double slope) -> const CasterBlock::Lanes& {
    return (slope > 0.0) == (ask == Ask::outside) ? block.max[axis] : block.min[axis];
  };
  const CasterBlock::Lanes &x = corner(0, plane.x), &y = corner(1, plane.y), &z = corner(2, plane.z);
  std::uint32_t bits = 0;
#if defined(__SSE2__)
  const __m128d px = _mm_set1_pd(plane.x), py = _mm_set1_pd(plane.y), pz = _mm_set1_pd(plane.z);
  const __m128d pw = _mm_set1_pd(plane.w), zero = _mm_setzero_pd();
  for (std::size_t i = 0; i < kLanes; i += 2) {
    const __m128d xy = _mm_add_pd(_mm_mul_pd(px, _mm_loadu_pd(&x[i])), _mm_mul_pd(py, _mm_loadu_pd(&y[i])));
    const __m128d sum = _mm_add_pd(_mm_add_pd(xy, _mm_mul_pd(pz, _mm_loadu_pd(&z[i]))), pw);
    const __m128d hit = ask == Ask::outside ? _mm_cmplt_pd(sum, zero) : _mm_cmpnge_pd(sum, zero);
    bits |= static_cast<std::uint32_t>(_mm_movemask_pd(hit)) << i;
  }
#else
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double sum = plane.x * x[i] + plane.y * y[i] + plane.z * z[i] + plane.w;
    bits |= static_cast<std::uint32_t>(ask == Ask::outside ? sum < 0.0 : !(sum >= 0.0)) << i;
  }
#endif
  return bits;
}

/// Calls `use` with each set bit's number.
template <typename Use>
inline void for_each_bit(std::uint32_t bits, Use&& use) noexcept {
  for (; bits != 0; bits &= bits - 1) use(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace gnomon
