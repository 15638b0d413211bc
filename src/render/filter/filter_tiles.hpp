// Which tiles of the filtered maps does a frame read, and which of them hold texels from earlier frames?
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "gl/gl_object.hpp"

namespace gnomon::render {

/// Texels along a side of a tile. Larger: fewer tiles to list, more texels that no pixel reads.
inline constexpr int kTileSide = 32;

/// The programs that keep the states of tiles, compiled by the first use.
struct TilePrograms {
  Program keep, list;
};

/// One state for each tile of each map (shaders/pass/store/tiles.glsl), and the lists of the map at hand.
class FilterTiles {
 public:
  /// The lists, in the order of the groups in shaders/pass/store/tiles.glsl.
  enum class List : std::uint8_t { tiles, rows };
  /// What becomes of a layer's states before the frame's reads are marked.
  struct Keep {
    bool holds = false;  ///< false: no texel of the layer is valid
    bool all = false;    ///< true: all tiles that are not valid are filled, whatever is read
  };

  /// Fits the states to layers of this size. All are stale where that changes anything.
  void fit(int width, int height, int layers);
  void keep(GLint layer, const Keep& what);
  /// For a pass that marks tiles; image unit 0.
  void bind_for_marks() const noexcept;
  /// For passes that look up a tile's state; image unit 0.
  void bind_for_reads() const noexcept;
  /// Lists the wanted tiles of a layer, and the rows of 8 texels whose blur by `reach` ends in one.
  void list(GLint layer, glm::ivec2 size, int reach);
  /// Dispatches one group for each tile, or for four rows of tiles, of a list.
  void dispatch(List which) const noexcept;

  [[nodiscard]] int per_layer() const noexcept { return width_ * height_; }
  /// Texels of the wanted tiles since the last call; waits for the passes before it.
  [[nodiscard]] std::uint64_t take_count();
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }

 private:
  void make_programs();

  int width_ = 0, height_ = 0, layers_ = 0;  ///< tiles
  Texture states_;
  Buffer lists_, count_;
  TilePrograms programs_;
  std::uint64_t bytes_ = 0;
};

}  // namespace gnomon::render
