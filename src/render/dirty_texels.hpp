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
  static constexpr std::size_t kMost = 64;
  std::array<TexelRect, kMost> rectangle{};
  std::size_t count = 0;
  bool whole = false;  ///< any texel of the map may have changed

  [[nodiscard]] bool any() const noexcept { return whole || count > 0; }
  [[nodiscard]] std::span<const TexelRect> rectangles() const noexcept { return {rectangle.data(), count}; }
};

/// `moved_world`: where casters were and where they are. Empty boxes change nothing. `most`: rectangles, 1 to
/// kMost; with kMost they follow the outlines of the boxes' images, with fewer their bounds.
[[nodiscard]] DirtyTexels dirty_texels(const ShadowMap& map, std::span<const Box> moved_world,
                                       std::size_t most) noexcept;

/// False where no texel of the rectangles can show the box.
[[nodiscard]] bool may_touch(const ShadowMap& map, const Box& box,
                             std::span<const TexelRect> rectangles) noexcept;

}  // namespace gnomon::render
