// From the level of each point to the pages that are opened.
#pragma once

#include "pages/base.hpp"

namespace gnomon {

/// Opens a page for each point at its level, finest levels first; page_count of memory.pages, with the level
/// of the ladder as Page::level. False where the memory does not hold them.
[[nodiscard]] bool open_pages(PageContext& context) noexcept;
/// What leave_to_coarser did.
struct LeftToCoarser {
  std::uint64_t points = 0;  ///< that got a coarser level
  int rounds = -1;           ///< that ended with all pages open; -1: not even those of no round fit
  bool open = false;         ///< false: the pages of the round after those do not fit into the memory
};
/// Rounds in which PageOptions::share is spent: points that left a page may leave another one with few.
inline constexpr int kShareRounds = 6;
/// Leaves pages that few points need to a coarser level, as PageOptions::share allows, in the first `rounds`
/// rounds. Opens the pages of all points again after each.
[[nodiscard]] LeftToCoarser leave_to_coarser(PageContext& context, int rounds) noexcept;

/// Where the search for a page begins in a table of this many entries, a power of two.
[[nodiscard]] inline std::uint32_t page_hash(std::uint32_t level, std::int32_t column,
                                             std::int32_t row) noexcept {
  std::uint32_t h = level * 0x9E3779B1u;
  h = (h ^ static_cast<std::uint32_t>(column)) * 0x85EBCA77u;
  h ^= h >> 15;
  h = (h ^ static_cast<std::uint32_t>(row)) * 0xC2B2AE3Du;
  return h ^ (h >> 13);
}
/// Index of a page, or -1. Entries of the table are indices plus one; 0: empty.
[[nodiscard]] int find_page(std::span<const std::uint32_t> table, std::span<const Page> pages,
                            std::uint32_t level, std::int32_t column, std::int32_t row) noexcept;
/// Adds the page of this index to the table, which must have room.
void add_to_table(std::span<std::uint32_t> table, std::span<const Page> pages, std::uint32_t index) noexcept;

}  // namespace gnomon
