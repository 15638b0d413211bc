// How does a texel grid stay stable? Centres are snapped to whole texels.
#pragma once

#include <cstdint>

namespace gnomon {

/// Whole-texel coordinates of a stable map's centre in light space, and its depth range in whole depth steps.
/// Two maps of the same light, slice and size with equal keys have the same texel grid and depths: their
/// clip_from_world are equal to the last bit.
struct SnapKey {
  std::int64_t x = 0, y = 0;                   ///< texels
  std::int64_t depth_near = 0, depth_far = 0;  ///< depth steps
  double texel = 0.0;                          ///< side of the grid's squares, world units
  bool valid = false;                          ///< false for Fit::tight
  /// The same grid: both are valid, and equal in all members. Maps without a grid have none in common.
  friend bool operator==(const SnapKey& a, const SnapKey& b) noexcept {
    return a.valid && b.valid && a.x == b.x && a.y == b.y && a.depth_near == b.depth_near &&
           a.depth_far == b.depth_far && a.texel == b.texel;
  }
};

/// The nearest whole number of `step`s to `value`. Needs step > 0; |value / step| beyond 2^53 is returned
/// clamped there, where double no longer represents every whole number.
[[nodiscard]] std::int64_t snap_index(double value, double step) noexcept;

}  // namespace gnomon
