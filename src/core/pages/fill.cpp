// From the level of each point to the pages that are opened.
//
// Finest levels come first, and a point that a finer page holds opens none: where pages of all levels lie in
// one tree (levels_per_octave 1), no set with fewer pages serves all points, as each page opened is the
// largest that serves some point which no page opened before does.
#include "pages/fill.hpp"

#include <algorithm>

namespace gnomon {
namespace {

// Share of a page's side within which a point counts as on both sides of its edge: look-ups round
// differently.
constexpr double kEdge = 1e-6;

/// The table that `pages` pages need: a power of two, at least half of it empty.
std::size_t table_size(std::size_t pages) noexcept {
  std::size_t size = 16;
  while (size < 2 * pages) size *= 2;
  return size;
}

struct CellRange {
  std::int32_t column[2], row[2];
};

class Opening {
 public:
  explicit Opening(PageContext& context) noexcept : c_(context), grid_(context.memory.grids) {
    std::size_t size = 16;
    while (2 * size <= c_.memory.table.size()) size *= 2;
    room_ = std::min(c_.memory.pages.size(), size / 2);
    table_ = c_.memory.table.first(size);
  }

  /// False where the memory is full.
  bool all() noexcept {
    if (c_.chosen > room_) return false;
    clear();
    if (!sort()) return true;
    for (int step = c_.deepest; step >= 0; --step) {
      for (int base = c_.base_count - 1; base >= 0; --base) {
        const auto level = static_cast<std::uint32_t>(base * kLadder + step);
        const bool whole = step == 0 && c_.options.fallback;
        if (begin_[level] == begin_[level + 1] && !whole) continue;
        grid_[level] = c_.grid(level);
        if (!open_level(level) || (whole && !open_whole(level))) return false;
      }
    }
    return true;
  }
  /// Whether finer pages of one level hold the point and what lies this far round it, in its own pages.
  [[nodiscard]] bool held_by_finer(const PagePoint& point, double reach) const noexcept {
    const std::uint32_t last = point.level / kLadder * kLadder + static_cast<std::uint32_t>(c_.deepest);
    const double own = c_.shrink[point.level % kLadder];
    for (std::uint32_t level = point.level + 1; level <= last; ++level) {
      if (!opened_[level]) continue;
      const double wider = max_of(kEdge, reach * (own / c_.shrink[level % kLadder]));
      if (holds_all(level, cells(level, point, wider))) return true;
    }
    return false;
  }
  [[nodiscard]] int page_of(std::uint32_t level, std::int32_t column, std::int32_t row) const noexcept {
    return find_page(table_, {c_.memory.pages.data(), c_.page_count}, level, column, row);
  }
  [[nodiscard]] CellRange cells(std::uint32_t level, const PagePoint& point, double reach) const noexcept {
    const PageGrid& g = grid_[level];
    const double x = point.x * g.scale.x + g.offset.x, y = point.y * g.scale.y + g.offset.y;
    const auto cell = [](double at, std::int32_t count) {
      return static_cast<std::int32_t>(clamp_to(at, 0.0, count - 1));
    };
    return {{cell(x - reach, g.columns), cell(x + reach, g.columns)},
            {cell(y - reach, g.rows), cell(y + reach, g.rows)}};
  }

 private:
  void clear() noexcept {
    std::fill(table_.begin(), table_.end(), 0u);
    opened_.fill(false);
    for (c_.page_count = 0; c_.page_count < c_.chosen; ++c_.page_count) {
      opened_[c_.memory.pages[c_.page_count].level] = true;
      add_to_table(table_, c_.memory.pages, static_cast<std::uint32_t>(c_.page_count));
    }
  }
  /// Points by level, in `order`. False where there is none.
  bool sort() noexcept {
    begin_.fill(0);
    std::uint32_t count = 0;
    c_.for_each_point([&](const PagePoint& point, std::size_t) {
      ++begin_[point.level + 1];
      ++count;
    });
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    auto next = begin_;
    c_.for_each_point([&](const PagePoint& point, std::size_t index) {
      c_.memory.points[next[point.level]++].order = static_cast<std::uint32_t>(index);
    });
    return count > 0;
  }
  bool open_level(std::uint32_t level) noexcept {
    const double reach = max_of(kEdge, c_.options.reach_texels / c_.options.page_texels);
    const bool shares = c_.options.policy->shares_finer;
    for (std::uint32_t i = begin_[level]; i < begin_[level + 1]; ++i) {
      const PagePoint& point = c_.memory.points[c_.memory.points[i].order];
      const CellRange range = cells(level, point, reach);
      const int own = page_of(level, range.column[0], range.row[0]);
      const bool one = range.column[0] == range.column[1] && range.row[0] == range.row[1];
      if (one && own >= 0) {
        ++c_.memory.pages[static_cast<std::size_t>(own)].points;
        continue;
      }
      if (shares && held_by_finer(point, reach)) continue;
      if (!open_range(level, range)) return false;
      opened_[level] = true;
    }
    return true;
  }
  bool open_range(std::uint32_t level, const CellRange& range) noexcept {
    for (std::int32_t row = range.row[0]; row <= range.row[1]; ++row) {
      for (std::int32_t column = range.column[0]; column <= range.column[1]; ++column) {
        const int page = page_of(level, column, row);
        if (page >= 0) {
          ++c_.memory.pages[static_cast<std::size_t>(page)].points;
          continue;
        }
        if (c_.page_count == room_) return false;
        c_.memory.pages[c_.page_count] = {level, column, row, 0, 1};
        add_to_table(table_, c_.memory.pages, static_cast<std::uint32_t>(c_.page_count++));
      }
    }
    return true;
  }
  /// All pages of a level.
  bool open_whole(std::uint32_t level) noexcept {
    return open_range(level, {{0, grid_[level].columns - 1}, {0, grid_[level].rows - 1}});
  }
  [[nodiscard]] bool holds_all(std::uint32_t level, const CellRange& range) const noexcept {
    for (std::int32_t row = range.row[0]; row <= range.row[1]; ++row) {
      for (std::int32_t column = range.column[0]; column <= range.column[1]; ++column) {
        if (page_of(level, column, row) < 0) return false;
      }
    }
    return true;
  }

  PageContext& c_;
  std::span<std::uint32_t> table_;
  std::size_t room_ = 0;
  std::array<std::uint32_t, kLadders + 1> begin_{};
  std::span<PageGrid> grid_;  // of levels that were opened or have points
  std::array<bool, kLadders> opened_{};
};

/// Lowers the points of the pages with the fewest, `budget` points at most: a page counts each point that
/// lies in it and that no finer page holds, and pages below the limit count `budget` points together at most.
std::uint64_t lower_points(PageContext& c, Opening& opening, std::uint64_t budget) noexcept {
  const std::span<Page> pages = c.memory.pages.first(c.page_count);
  // Pages by their number of points; those with more are no candidates.
  constexpr std::size_t kMaxPoints = 1024;
  std::array<std::uint64_t, kMaxPoints> with{};
  for (const Page& page : pages) {
    if (page.points < kMaxPoints && page.level % kLadder > 0) ++with[page.points];
  }
  std::uint64_t left = budget;
  std::size_t limit = 0;  // pages with fewer points go
  while (limit < kMaxPoints && with[limit] * limit <= left) left -= with[limit] * limit, ++limit;
  std::uint64_t lowered = 0;
  c.for_each_point([&](PagePoint& point, std::size_t) {
    if (point.level % kLadder == 0) return;
    const CellRange range = opening.cells(point.level, point, 0.0);
    const int own = opening.page_of(point.level, range.column[0], range.row[0]);
    if (own < 0 || pages[static_cast<std::size_t>(own)].points >= limit) return;
    if (opening.held_by_finer(point, 0.0)) return;
    c.set_step(point, static_cast<int>(point.level % kLadder) - c.steps);
    ++lowered;
  });
  return lowered;
}

}  // namespace

int find_page(std::span<const std::uint32_t> table, std::span<const Page> pages, std::uint32_t level,
              std::int32_t column, std::int32_t row) noexcept {
  if (table.empty()) return -1;
  const std::size_t mask = table.size() - 1;
  for (std::size_t at = page_hash(level, column, row) & mask; table[at] != 0; at = (at + 1) & mask) {
    const Page& page = pages[table[at] - 1];
    if (page.level == level && page.column == column && page.row == row)
      return static_cast<int>(table[at] - 1);
  }
  return -1;
}

void add_to_table(std::span<std::uint32_t> table, std::span<const Page> pages, std::uint32_t index) noexcept {
  const Page& page = pages[index];
  const std::size_t mask = table.size() - 1;
  std::size_t at = page_hash(page.level, page.column, page.row) & mask;
  while (table[at] != 0) at = (at + 1) & mask;
  table[at] = index + 1;
}

std::size_t page_table_size(int capacity) noexcept {
  return table_size(static_cast<std::size_t>(capacity > 0 ? capacity : 1));
}

bool open_pages(PageContext& context) noexcept {
  Opening opening(context);
  return opening.all();
}

LeftToCoarser leave_to_coarser(PageContext& c, int rounds) noexcept {
  const std::uint64_t inside = c.point_count - c.outside;
  const auto budget = static_cast<std::uint64_t>((1.0 - c.options.share) * static_cast<double>(inside));
  Opening opening(c);
  LeftToCoarser left;
  for (int round = 0; round <= rounds; ++round) {
    // Each round has its part of the budget, the first none.
    const std::uint64_t so_far = budget * static_cast<std::uint64_t>(round) / kShareRounds;
    if (round > 0) left.points += lower_points(c, opening, so_far - left.points);
    // The coarser pages may be more than those that were left.
    left.open = opening.all();
    if (!left.open) break;
    left.rounds = round;
  }
  return left;
}

}  // namespace gnomon
