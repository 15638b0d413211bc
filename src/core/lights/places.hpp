// Where the maps of all lights lie in the pool.
#pragma once

#include <cstdint>
#include <span>

#include "gnomon/lights.hpp"

namespace gnomon {

/// The pool as cells of the largest size in rows, each a quadtree down to squares of the smallest. Squares
/// are counted along the curve that fills one quarter before the next, so that a map of level l is a run of
/// 4^l squares that begins at a multiple of 4^l.
struct PoolGrid {
  int least = 16;             // side of the smallest squares, texels
  int top = 0;                // level of the cells
  int columns = 1, rows = 1;  // of cells
  [[nodiscard]] std::uint32_t squares() const noexcept {
    return static_cast<std::uint32_t>(columns) * static_cast<std::uint32_t>(rows) << (2 * top);
  }
  /// The rectangle of a map.
  [[nodiscard]] TexelRect rectangle(std::uint32_t square, int level) const noexcept;
};

/// The runs that are taken, in order and without overlap, in the caller's memory.
class TakenRuns {
 public:
  explicit TakenRuns(std::span<LightPlace> memory) noexcept : runs_(memory) {}

  void clear() noexcept { count_ = 0; }
  /// In any order; sort() comes before take().
  void add(std::uint32_t begin, std::uint32_t length) noexcept;
  /// False where two runs share a square, or one leaves the pool.
  [[nodiscard]] bool sort(std::uint32_t squares) noexcept;
  /// Where the search for runs of one length begins.
  struct Cursor {
    std::uint32_t at = 0;
    std::size_t run = 0;
  };
  /// Takes the first free run of this length, a power of two, from the cursor on, and moves the cursor behind
  /// it. False where there is none below `squares`. Runs that come longest first and into an empty pool
  /// always fit while their sum does.
  [[nodiscard]] bool take(Cursor& cursor, std::uint32_t length, std::uint32_t squares,
                          std::uint32_t& begin) noexcept;

 private:
  std::span<LightPlace> runs_;
  std::size_t count_ = 0;
};

}  // namespace gnomon
