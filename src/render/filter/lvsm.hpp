// Layers of depth.
#pragma once

#include "filter/filter_parts.hpp"

namespace gnomon::render {

/// A layer from `begin` (where depths count 0) to `end` (1).
struct DepthBand {
  double begin = 0.0, end = 1.0;
  /// Depths in front of it are all 0, those behind all 1.
  [[nodiscard]] double warped(double depth) const noexcept {
    return std::clamp((depth - begin) / (end - begin), 0.0, 1.0);
  }
};
/// Layer i, reaching into the ones before and behind it by a share of them.
[[nodiscard]] DepthBand layer_of(int i, const FilterSettings& settings) noexcept;
/// How little layer i says about a receiver whose deepest texel under the kernel is at `deepest`: 0 up to
/// where the layer would end without overlap, 1 from its end on.
[[nodiscard]] double beyond_layer(int i, const FilterSettings& settings, double deepest) noexcept;

/// Ends of all layers but the last, ascending in (0, 1), one more layer than ends: those under which the
/// depths within each layer vary least, each bin of depths weighted by the square root of how many it holds
/// (a large ground must not take all layers), in the middle of the gaps between them. Depths of 1 are not
/// counted; all ends 0 where there are no others.
void place_layers(std::span<const float> depths, std::span<double> ends) noexcept;

}  // namespace gnomon::render
