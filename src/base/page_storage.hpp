// Memory on the heap that a page plan is written into, for programs and tests: the core allocates none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gnomon/pages.hpp"

namespace gnomon {

struct PageStorage {
  /// `capacity` >= 0, pages.
  explicit PageStorage(int capacity = 4096, std::size_t point_count = 1 << 14)
      : levels(kMostPageLevels),
        pages(static_cast<std::size_t>(capacity)),
        table(page_table_size(capacity)),
        points(point_count) {}
  [[nodiscard]] PageMemory spans() noexcept { return {levels, pages, table, points}; }

  std::vector<ShadowMap> levels;
  std::vector<Page> pages;
  std::vector<std::uint32_t> table;
  std::vector<PagePoint> points;
};

}  // namespace gnomon
