// Which rectangles of a map could a moved caster have changed?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "casters/caster_shapes.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/plan.hpp"
#include "maps/texel_mask.hpp"

namespace gnomon::render {

/// A few rectangles that hold the images of all moved boxes, with room for rounding.
struct DirtyTexels {
  static constexpr std::size_t kMost = 4;
  std::array<TexelRect, kMost> rectangle{};
  std::size_t count = 0;
  bool whole = false;  ///< any texel of the map may have changed

  [[nodiscard]] bool any() const noexcept { return whole || count > 0; }
  [[nodiscard]] std::span<const TexelRect> rectangles() const noexcept { return {rectangle.data(), count}; }
};

/// Rectangles round the images of whole boxes, for what costs by the rectangle. `moved_world`: where casters
/// were and where they are; empty boxes change nothing.
[[nodiscard]] DirtyTexels dirty_bounds(const ShadowMap& map, std::span<const Box> moved_world) noexcept;

/// Rectangles that follow the triangles of moved casters in one map, for what costs by the texel. Remembers
/// where they stand, so that the next frame need not find where they stood. Its memory is used again.
class DirtyShapes {
 public:
  /// Rectangles of a map.
  static constexpr std::size_t kMost = 1024;
  /// Triangles and boxes that are projected one by one in one pose; the bounds of further casters are.
  static constexpr std::size_t kMaxParts = 1 << 14;

  /// Finds what casters may have changed that moved, or that stand or stood in named bounds. False: any texel
  /// of the map, and there are no rectangles.
  bool find(const ShadowMap& map, std::span<const Box> named_world, std::span<const MovedCaster> moved);
  /// The next find() is of another map, or of one that was brought up to date without a find().
  void forget() noexcept { remembers_ = false; }
  /// Valid until the next find().
  [[nodiscard]] std::span<const TexelRect> rectangles() const noexcept { return rectangles_; }

 private:
  /// False: any texel.
  bool mark_all(const ShadowMap& map, std::span<const Box> named_world, std::span<const MovedCaster> moved);
  bool mark(TexelMask& mask, const ShadowMap& map, const CasterShape& shape, std::size_t& parts_left);

  TexelMask dirty_, stands_, stood_;
  bool remembers_ = false;  ///< `stands_` is of the casters `standing_`, at the last find()
  std::vector<std::uint32_t> standing_, moved_;  ///< instances, ascending
  std::vector<glm::dvec2> image_;                ///< scratch: texels of a shape's positions
  std::span<const TexelRect> rectangles_;
};

/// False where no texel of the rectangles can show the box.
[[nodiscard]] bool may_touch(const ShadowMap& map, const Box& box,
                             std::span<const TexelRect> rectangles) noexcept;

}  // namespace gnomon::render
