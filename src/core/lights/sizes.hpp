// How many texels each light gets, and where the maps of all lights lie in the pool.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "gnomon/lights.hpp"

namespace gnomon {

/// Working memory for one light.
struct LightWork {
  double demand;        ///< error times the side of its maps without borders, texels
  double ratio;         ///< error saved per texel by the next step
  std::uint32_t light;  ///< index into the lights
  int maps;             ///< how many it draws
  int level;            ///< of their size: the smallest doubled so many times
  int top;              ///< largest level, at least SizeLadder::floor
  int last;             ///< level in the last plan
  double price = 0.0;   ///< milliseconds per frame for each square of the smallest size, of all its maps
  double fixed = 0.0;   ///< the same whatever the size
  int other = 0;        ///< level that the budget of texels alone would give
};

/// Sizes by level: the smallest side doubled `level` times.
struct SizeLadder {
  int least = 16;     // texels
  int floor = 0;      // level of LightOptions::least_size
  int top = 0;        // level of LightOptions::most_size
  double border = 0;  // texels along each side that hold a filter's kernel
  [[nodiscard]] double inside(int level) const noexcept {
    return static_cast<double>(std::int64_t{least} << level) - 2.0 * border;
  }
  /// Area of one map, in squares of the smallest.
  [[nodiscard]] static std::int64_t cells(int level) noexcept { return std::int64_t{1} << (2 * level); }
};

/// What all maps may take together.
struct SizeBudget {
  std::int64_t cells = 0;  // squares of the smallest size
  double milliseconds = std::numeric_limits<double>::infinity();
};

/// Sets the levels of all lights within the budget, and orders them by their light. `demand` is that of
/// LightImportance times weight and share. Each light's `top` bounds its level, and up to `last` its steps
/// count `keep_gain` times. False, without levels, where not even the smallest maps fit.
///
/// A light without demand has maps of the floor where all lights' fit, else the smallest.
///
/// Each step doubles one light's maps: that whose error falls most per texel. Steps of one light gain ever
/// less, so that no order of steps gains more from the same texels; only the last texels, too few for the
/// next step, go to steps that gain less. More cells never make the sum of errors larger: up to the first
/// step that fits into the larger budget alone both orders are the same, and that step gains more than all
/// that the smaller budget has left.
///
/// Where those sizes take too many milliseconds, steps come by what they gain per millisecond, and the same
/// holds for these. Where they do not, the better of both choices is taken: more milliseconds never make the
/// sum larger.
[[nodiscard]] bool choose_sizes(std::span<LightWork> lights, const SizeLadder& ladder,
                                const SizeBudget& budget, double keep_gain) noexcept;

/// Milliseconds per frame of all lights at their levels.
[[nodiscard]] double milliseconds_of(std::span<const LightWork> lights) noexcept;

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

/// A run of squares that a map takes. Working memory.
struct LightPlace {
  std::uint32_t begin;  ///< first square of the smallest maps' grid
  std::uint32_t end;    ///< one past the last
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
