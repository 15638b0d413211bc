// Which texels of a map are marked, and which few rectangles hold them?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "gnomon/motion.hpp"

namespace gnomon::render {

/// The smallest rectangle that holds both; neither is empty.
[[nodiscard]] TexelRect joined(const TexelRect& a, const TexelRect& b) noexcept;

/// Maps of up to kMaxCells a side are marked by the texel, larger ones by squares of 2, 4, ... texels. Its
/// memory is used again.
class TexelMask {
 public:
  static constexpr int kMaxCells = 1024;

  /// Empties the mask, for a map of this many texels.
  void reset(int width, int height);
  /// Marks every texel whose centre lies in the convex hull of corners, or within `room` of it along either
  /// axis. Every edge of the hull is one of `edges`, pairs of corners; others lie inside. Texels from the
  /// map's lower left corner, all finite.
  void mark(std::span<const glm::dvec2> corners, std::span<const std::array<std::uint8_t, 2>> edges,
            const glm::dvec2& room);
  /// The same for a rectangle from `low` to `high`.
  void mark(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& room);
  [[nodiscard]] bool is_of(int width, int height) const noexcept {
    return width_ == width && height_ == height;
  }
  /// Marks what the other marks. Both are of maps of one size.
  void mark(const TexelMask& other) noexcept;
  /// Rectangles that hold all marked texels, `most` at most, with few others: a sixteenth of those, or as
  /// many as `most` takes. Valid until the next call of any member.
  [[nodiscard]] std::span<const TexelRect> rectangles(std::size_t most);

 private:
  struct Range {
    double low, high;
  };
  struct Run {
    int row, begin, end;  ///< cells
  };
  struct Open {
    int begin, end, first_row, rows;  ///< cells
    double marked;                    ///< cells that it holds
  };
  struct Cells {
    int first_column = 0, last_column = -1, first_row = 0, last_row = -1;
    [[nodiscard]] bool empty() const noexcept { return last_column < first_column; }
  };
  /// Cells that hold a centre between two corners.
  [[nodiscard]] Cells cells_between(const glm::dvec2& low, const glm::dvec2& high) const noexcept;
  void mark_row(int row, int first_column, int last_column) noexcept;
  void mark_all(const Cells& cells) noexcept;
  /// True: all of them are marked. False: some may not be.
  [[nodiscard]] bool holds(const Cells& cells) const noexcept;
  /// Widens the outline's rows by an edge.
  void add_to_outline(glm::dvec2 a, glm::dvec2 b, double room) noexcept;
  void list_runs();
  /// Joins runs row by row into rectangles that hold at most `share` more cells than are marked.
  void join(double share);
  void close(const Open& open);

  int width_ = 0, height_ = 0, cell_ = 1, rows_ = 0;
  int columns_ = 0;
  std::size_t words_ = 0;  ///< of a row
  std::vector<std::uint64_t> bits_;
  int first_row_ = 0, last_row_ = -1;  ///< that hold any
  std::vector<Range> outline_;         ///< scratch of mark()
  std::vector<Run> runs_;
  std::vector<Open> open_, still_open_;
  std::vector<TexelRect> rectangles_;
};

}  // namespace gnomon::render
