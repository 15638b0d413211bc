// Layers of depth.
#pragma once

#include "filter_parts.hpp"

namespace gnomon::render {

/// A layer from `begin` (where depths count 0) to `end` (1).
struct DepthLayer {
  double begin = 0.0, end = 1.0;
  /// Depths in front of it are all 0, those behind all 1.
  [[nodiscard]] double warped(double depth) const noexcept {
    return std::clamp((depth - begin) / (end - begin), 0.0, 1.0);
  }
};
/// Layer i of `count` of equal depth, each reaching into the ones before and behind it by `overlap` of a
/// layer.
[[nodiscard]] DepthLayer even_layer(int i, int count, double overlap) noexcept;
/// How little layer i says about a receiver whose deepest texel under the kernel is at `deepest`: 0 up to
/// where the layer would end without overlap, 1 from its end on.
[[nodiscard]] double beyond_layer(int i, int count, double overlap, double deepest) noexcept;

}  // namespace gnomon::render
