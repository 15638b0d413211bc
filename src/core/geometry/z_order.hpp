// Where does a cell lie along a curve through a grid that keeps neighbours together?
// Based on: Morton, "A Computer Oriented Geodetic Data Base", 1966.
#pragma once

#include <cstdint>

namespace gnomon {

/// The lower 32 bits, with a 0 before each.
[[nodiscard]] constexpr std::uint64_t spread_bits(std::uint64_t v) noexcept {
  v &= 0x00000000FFFFFFFFu;
  v = (v | v << 16) & 0x0000FFFF0000FFFFu;
  v = (v | v << 8) & 0x00FF00FF00FF00FFu;
  v = (v | v << 4) & 0x0F0F0F0F0F0F0F0Fu;
  v = (v | v << 2) & 0x3333333333333333u;
  return (v | v << 1) & 0x5555555555555555u;
}
/// Every other bit from the lowest on: what spread_bits() spread.
[[nodiscard]] constexpr std::uint64_t gathered_bits(std::uint64_t v) noexcept {
  v &= 0x5555555555555555u;
  v = (v | v >> 1) & 0x3333333333333333u;
  v = (v | v >> 2) & 0x0F0F0F0F0F0F0F0Fu;
  v = (v | v >> 4) & 0x00FF00FF00FF00FFu;
  v = (v | v >> 8) & 0x0000FFFF0000FFFFu;
  return (v | v >> 16) & 0x00000000FFFFFFFFu;
}

}  // namespace gnomon
