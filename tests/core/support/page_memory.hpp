// The memory that a page plan is written into.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gnomon/pages.hpp"

namespace gnomon::test {

struct HeldPages {
  explicit HeldPages(int capacity = 4096, std::size_t count = 1 << 14)
      : pages(static_cast<std::size_t>(capacity)), table(page_table_size(capacity)), points(count) {}
  std::vector<ShadowMap> levels = std::vector<ShadowMap>(kMostPageLevels);
  std::vector<Page> pages;
  std::vector<std::uint32_t> table;
  std::vector<PagePoint> points;
  [[nodiscard]] PageMemory spans() { return {levels, pages, table, points}; }
};

}  // namespace gnomon::test
