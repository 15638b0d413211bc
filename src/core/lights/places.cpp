// Where the maps of all lights lie in the pool.
// Based on: Samet, "The Quadtree and Related Hierarchical Data Structures", 1984; Knowlton, "A Fast Storage
// Allocator", 1965 (blocks of powers of two).
#include "lights/places.hpp"

#include <algorithm>

namespace gnomon {
namespace {

/// Every second bit, packed.
std::uint32_t even_bits(std::uint32_t x) noexcept {
  x &= 0x55555555u;
  x = (x | x >> 1) & 0x33333333u;
  x = (x | x >> 2) & 0x0f0f0f0fu;
  x = (x | x >> 4) & 0x00ff00ffu;
  return (x | x >> 8) & 0x0000ffffu;
}

}  // namespace

TexelRect PoolGrid::rectangle(std::uint32_t square, int level) const noexcept {
  const std::uint32_t cell = square >> (2 * top), inside = square & ((1u << (2 * top)) - 1u);
  const int column = static_cast<int>(cell) % columns, row = static_cast<int>(cell) / columns;
  const int side = least << level, cell_side = least << top;
  return {column * cell_side + static_cast<int>(even_bits(inside)) * least,
          row * cell_side + static_cast<int>(even_bits(inside >> 1)) * least, side, side};
}

void TakenRuns::add(std::uint32_t begin, std::uint32_t length) noexcept {
  runs_[count_++] = {begin, begin + length};
}

bool TakenRuns::sort(std::uint32_t squares) noexcept {
  std::sort(runs_.begin(), runs_.begin() + static_cast<std::ptrdiff_t>(count_),
            [](const LightPlace& a, const LightPlace& b) { return a.begin < b.begin; });
  std::uint32_t end = 0;
  for (const LightPlace& run : runs_.first(count_)) {
    if (run.begin < end || run.end < run.begin || run.end > squares) return false;
    end = run.end;
  }
  return true;
}

bool TakenRuns::take(Cursor& cursor, std::uint32_t length, std::uint32_t squares,
                     std::uint32_t& begin) noexcept {
  for (;;) {
    const std::uint32_t at = (cursor.at + length - 1) & ~(length - 1);
    while (cursor.run < count_ && runs_[cursor.run].end <= at) ++cursor.run;
    if (at > squares || squares - at < length) return false;
    cursor.at = at;
    if (cursor.run == count_ || runs_[cursor.run].begin >= at + length) break;
    cursor.at = runs_[cursor.run].end;
  }
  begin = cursor.at;
  cursor.at += length;
  // Runs that touch become one: in a pool filled in order there is only one.
  if (cursor.run > 0 && runs_[cursor.run - 1].end == begin) {
    runs_[cursor.run - 1].end = cursor.at;
    return true;
  }
  const auto place = runs_.begin() + static_cast<std::ptrdiff_t>(cursor.run);
  std::move_backward(place, runs_.begin() + static_cast<std::ptrdiff_t>(count_),
                     runs_.begin() + static_cast<std::ptrdiff_t>(count_ + 1));
  *place = {begin, cursor.at};
  ++count_;
  ++cursor.run;
  return true;
}

}  // namespace gnomon
