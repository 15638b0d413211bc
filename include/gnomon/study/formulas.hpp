// The closed formulas of the field, each by itself: splits along the view, extents of a slice, snapping, and
// where a warped map's texels outgrow a uniform one's.
#pragma once

#include <cstdint>
#include <span>

#include "gnomon/options.hpp"

namespace gnomon {

/// Fills `edges` (N + 1 of them for N maps) with the borders, ascending; the first is exactly `near_depth`,
/// the last exactly `far_depth`. Needs near_depth <= far_depth; logarithmic shares need near_depth > 0 and
/// fall back to uniform where it is not. Equal depths give equal edges.
///
/// logarithmic: n (f/n)^(i/m); uniform: n + (f-n) i/m; practical: their blend (Zhang et al. 2006,
/// parallel-split shadow maps; Scherzer et al. 2011, section 4.3); pseudo_near: n, then p (f/p)^(i/m) for i
/// >= 1 (Lloyd et al. 2006).
void split_depths(double near_depth, double far_depth, const SplitOptions& options,
                  std::span<double> edges) noexcept;

/// The longest distance between two corners of the frustum slice [begin, end] of a camera with these image
/// edges. It is found in view space: the same bits every frame. Image edges as in Camera. This is the
/// side of a square that holds the slice from every direction; never above the diameter of the smallest
/// enclosing sphere.
[[nodiscard]] double longest_chord(double left, double right, double bottom, double top, bool orthographic,
                                   double begin, double end) noexcept;

/// The nearest whole number of `step`s to `value`. Needs step > 0; |value / step| beyond 2^53 is returned
/// clamped there, where double no longer represents every whole number.
[[nodiscard]] std::int64_t snap_index(double value, double step) noexcept;

/// Share of a warped map's length, from its near end, up to which its texels are smaller than a uniform
/// map's. Both lie over the same body with equal widths at the far end. w = 1 + kappa u* = (1 + kappa
/// length)^(2/3) (texel areas grow with w^3). Needs kappa >= 0 and length >= 0; 2/3 where nothing is warped.
/// Based on: Mikkelsen, "Separating-plane perspective shadow mapping", 2007.
[[nodiscard]] double separating_share(double kappa, double length) noexcept;

}  // namespace gnomon
