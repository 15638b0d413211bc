// Marks convex hulls row by row in bits, and joins the rows' runs into rectangles.
#include "maps/texel_mask.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace gnomon::render {
namespace {

constexpr int kWordBits = 64;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Unmarked cells that rectangles may hold, of the marked ones.
constexpr double kWasteShare = 1.0 / 16.0;
// Edges that rise less are taken as level.
constexpr double kLevel = 1e-6;

/// The lowest texel whose centre is not below a place; `count` where there is none. std::ceil is a call on
/// many machines.
int first_texel(double place, int count) noexcept {
  const double at = std::clamp(place - 0.5, 0.0, 1.0 * count);
  const int texel = static_cast<int>(at);
  return texel + (texel < at ? 1 : 0);
}
/// The highest one whose centre is not above it; -1 where there is none.
int last_texel(double place, int count) noexcept {
  return static_cast<int>(std::clamp(place + 0.5, 0.0, 1.0 * count)) - 1;
}

}  // namespace

TexelRect joined(const TexelRect& a, const TexelRect& b) noexcept {
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

void TexelMask::reset(int width, int height) {
  if (is_of(width, height)) {
    const auto row = [this](int r) { return bits_.begin() + static_cast<std::ptrdiff_t>(words_) * r; };
    if (first_row_ <= last_row_) std::fill(row(first_row_), row(last_row_ + 1), std::uint64_t{0});
  } else {
    cell_ = 1;
    while (std::max(width, height) > kMaxCells * cell_) cell_ *= 2;
    width_ = width;
    height_ = height;
    columns_ = (width + cell_ - 1) / cell_;
    rows_ = (height + cell_ - 1) / cell_;
    words_ = static_cast<std::size_t>((columns_ + kWordBits - 1) / kWordBits);
    bits_.assign(words_ * static_cast<std::size_t>(rows_), 0);
    outline_.resize(static_cast<std::size_t>(rows_));
  }
  first_row_ = rows_;
  last_row_ = -1;
}

TexelMask::Cells TexelMask::cells_between(const glm::dvec2& low, const glm::dvec2& high) const noexcept {
  const int left = first_texel(low.x, width_), right = last_texel(high.x, width_);
  const int bottom = first_texel(low.y, height_), top = last_texel(high.y, height_);
  if (right < left || top < bottom) return {};
  return {left / cell_, right / cell_, bottom / cell_, top / cell_};
}

void TexelMask::mark_row(int row, int first_column, int last_column) noexcept {
  std::uint64_t* const words = &bits_[words_ * static_cast<std::size_t>(row)];
  const int first_word = first_column / kWordBits, last_word = last_column / kWordBits;
  for (int word = first_word; word <= last_word; ++word) {
    std::uint64_t mask = ~std::uint64_t{0};
    if (word == first_word) mask &= ~std::uint64_t{0} << first_column % kWordBits;
    if (word == last_word) mask &= ~std::uint64_t{0} >> (kWordBits - 1 - last_column % kWordBits);
    words[word] |= mask;
  }
}

void TexelMask::mark_all(const Cells& cells) noexcept {
  for (int row = cells.first_row; row <= cells.last_row; ++row)
    mark_row(row, cells.first_column, cells.last_column);
  first_row_ = std::min(first_row_, cells.first_row);
  last_row_ = std::max(last_row_, cells.last_row);
}

bool TexelMask::holds(const Cells& cells) const noexcept {
  const int word = cells.first_column / kWordBits;
  // Most images of triangles are small.
  if (cells.last_column / kWordBits != word) return false;
  const std::uint64_t bits = ~std::uint64_t{0} >> (kWordBits - 1 - (cells.last_column - cells.first_column))
                                                      << cells.first_column % kWordBits;
  for (int row = cells.first_row; row <= cells.last_row; ++row) {
    if ((bits & ~bits_[words_ * static_cast<std::size_t>(row) + static_cast<std::size_t>(word)]) != 0)
      return false;
  }
  return true;
}

void TexelMask::mark(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& room) {
  const Cells cells = cells_between(low - room, high + room);
  if (!cells.empty()) mark_all(cells);
}

void TexelMask::mark(std::span<const glm::dvec2> corners, std::span<const std::array<std::uint8_t, 2>> edges,
                     const glm::dvec2& room) {
  glm::dvec2 low = corners[0], high = low;
  for (const glm::dvec2& corner : corners.subspan(1)) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  const Cells cells = cells_between(low - room, high + room);
  if (cells.empty() || holds(cells)) return;
  if (cells.last_row == cells.first_row && cells.last_column == cells.first_column) {
    mark_all(cells);
    return;
  }
  for (int row = cells.first_row; row <= cells.last_row; ++row)
    outline_[static_cast<std::size_t>(row)] = {kInfinity, -kInfinity};
  for (const std::array<std::uint8_t, 2>& edge : edges)
    add_to_outline(corners[edge[0]], corners[edge[1]], room.y);
  for (int row = cells.first_row; row <= cells.last_row; ++row) {
    const Range& range = outline_[static_cast<std::size_t>(row)];
    const int left = first_texel(range.low - room.x, width_), right = last_texel(range.high + room.x, width_);
    if (left <= right) mark_row(row, left / cell_, right / cell_);
  }
  first_row_ = std::min(first_row_, cells.first_row);
  last_row_ = std::max(last_row_, cells.last_row);
}

void TexelMask::add_to_outline(glm::dvec2 a, glm::dvec2 b, double room) noexcept {
  if (a.y > b.y) std::swap(a, b);
  const int begin = first_texel(a.y - room, height_) / cell_, last = last_texel(b.y + room, height_);
  if (last < 0) return;
  const int end = last / cell_;
  const bool level = b.y - a.y < kLevel;
  const double slope = level ? 0.0 : (b.x - a.x) / (b.y - a.y);
  for (int row = begin; row <= end; ++row) {
    // Between the centres of a row of cells, and as far beyond as an outline may be off.
    const double from = std::max(1.0 * row * cell_ + 0.5 - room, a.y),
                 to = std::min((row + 1.0) * cell_ - 0.5 + room, b.y);
    const double x = level ? a.x : a.x + slope * (from - a.y), z = level ? b.x : a.x + slope * (to - a.y);
    Range& range = outline_[static_cast<std::size_t>(row)];
    range.low = std::min({range.low, x, z});
    range.high = std::max({range.high, x, z});
  }
}

void TexelMask::mark(const TexelMask& other) noexcept {
  const std::size_t begin = words_ * static_cast<std::size_t>(other.first_row_),
                    end = words_ * static_cast<std::size_t>(other.last_row_ + 1);
  for (std::size_t i = begin; i < end; ++i) bits_[i] |= other.bits_[i];
  first_row_ = std::min(first_row_, other.first_row_);
  last_row_ = std::max(last_row_, other.last_row_);
}

void TexelMask::list_runs() {
  runs_.clear();
  for (int row = first_row_; row <= last_row_; ++row) {
    const std::uint64_t* const words = &bits_[words_ * static_cast<std::size_t>(row)];
    int begin = -1;
    for (std::size_t w = 0; w < words_; ++w) {
      const int at = static_cast<int>(w) * kWordBits;
      std::uint64_t word = words[w];
      // Bit by bit from one change to the next.
      for (int bit = 0; bit < kWordBits;) {
        const std::uint64_t rest = (begin < 0 ? word : ~word) >> bit;
        if (rest == 0) break;
        bit += std::countr_zero(rest);
        if (begin < 0) {
          begin = at + bit;
        } else {
          runs_.push_back({row, begin, at + bit});
          begin = -1;
        }
      }
    }
    if (begin >= 0) runs_.push_back({row, begin, columns_});
  }
}

void TexelMask::close(const Open& open) {
  const int x = open.begin * cell_, y = open.first_row * cell_;
  rectangles_.push_back({x, y, std::min(open.end * cell_, width_) - x,
                         std::min((open.first_row + open.rows) * cell_, height_) - y});
}

void TexelMask::join(double share) {
  rectangles_.clear();
  open_.clear();
  for (std::size_t run = 0; run < runs_.size();) {
    const int row = runs_[run].row;
    still_open_.clear();
    std::size_t at = 0;
    for (; run < runs_.size() && runs_[run].row == row; ++run) {
      const Run& added = runs_[run];
      Open joined{added.begin, added.end, row, 1, 1.0 * (added.end - added.begin)};
      // Those that end before it end before all further runs.
      while (at < open_.size() && open_[at].end <= added.begin) close(open_[at++]);
      if (at < open_.size() && open_[at].first_row + open_[at].rows == row) {
        const Open& open = open_[at];
        const int begin = std::min(open.begin, added.begin), end = std::max(open.end, added.end);
        const double marked = open.marked + added.end - added.begin;
        if (1.0 * (end - begin) * (open.rows + 1) <= (1.0 + share) * marked) {
          joined = {begin, end, open.first_row, open.rows + 1, marked};
          ++at;
        }
      }
      still_open_.push_back(joined);
    }
    for (; at < open_.size(); ++at) close(open_[at]);
    std::swap(open_, still_open_);
  }
  for (const Open& open : open_) close(open);
}

std::span<const TexelRect> TexelMask::rectangles(std::size_t most) {
  list_runs();
  constexpr double kMaxShare = 64.0;
  double share = kWasteShare;
  for (join(share); rectangles_.size() > most && share < kMaxShare; join(share)) share *= 2.0;
  while (rectangles_.size() > most && most > 0) {
    // Neighbours in the list are neighbours in the map, more or less.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rectangles_.size(); i += 2) {
      const TexelRect& other = rectangles_[std::min(i + 1, rectangles_.size() - 1)];
      rectangles_[kept++] = joined(rectangles_[i], other);
    }
    rectangles_.resize(kept);
  }
  return rectangles_;
}

}  // namespace gnomon::render
