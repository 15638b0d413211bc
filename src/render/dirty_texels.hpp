// Which rectangles of a map could a moved caster have changed?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/reuse.hpp"

namespace gnomon::render {

/// A few rectangles that hold the images of all moved boxes, with room for rounding.
struct DirtyTexels {
  static constexpr std::size_t kMostBounds = 4, kMost = 64;
  std::array<TexelRect, kMost> rectangle{};
  std::size_t count = 0;
  bool whole = false;  ///< any texel of the map may have changed

  [[nodiscard]] bool any() const noexcept { return whole || count > 0; }
  [[nodiscard]] std::span<const TexelRect> rectangles() const noexcept { return {rectangle.data(), count}; }
};

/// Up to kMostBounds rectangles round the images of whole boxes, for what costs by the rectangle.
/// `moved_world`: where casters were and where they are; empty boxes change nothing.
[[nodiscard]] DirtyTexels dirty_bounds(const ShadowMap& map, std::span<const Box> moved_world) noexcept;
/// Up to kMost rectangles that follow the images' outlines, for what costs by the texel.
[[nodiscard]] DirtyTexels dirty_outlines(const ShadowMap& map, std::span<const Box> moved_world) noexcept;

/// False where no texel of the rectangles can show the box.
[[nodiscard]] bool may_touch(const ShadowMap& map, const Box& box,
                             std::span<const TexelRect> rectangles) noexcept;

}  // namespace gnomon::render
