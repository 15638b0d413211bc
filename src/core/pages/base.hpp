// The base of a page plan: one map of make_plan for each part of the light, and the ladder of levels over it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geometry/vector.hpp"
#include "gnomon/pages.hpp"

namespace gnomon {

/// Steps of a ladder: 26 octaves in up to four steps, and the first; rounded up to a power of two.
inline constexpr int kLadder = 128;
static_assert(kLadder >= 26 * 4 + 1);
/// PagePoint::level of a point that no base holds.
inline constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();

/// Working memory for one visible point.
struct PagePoint {
  double x, y;           ///< place in the base
  float need_x, need_y;  ///< texels per unit of the base for m = 1
  std::uint32_t level;   ///< of the base's ladder
  std::uint32_t order;   ///< index of another point
};

/// Pages along one level of a base: cells [first, first + count) along each axis.
struct PageGrid {
  glm::dvec2 side;
  glm::dvec2 scale, offset;  ///< cell = place * scale + offset
  std::int64_t first_x, first_y;
  std::int32_t columns, rows;
};

/// A place whose error policy `picture` weighs.
struct PageSample {
  std::uint64_t cell;         ///< of the finest pages, base by base along a Z-order curve
  float error;                ///< square root of PageContext::excess
  std::uint32_t at_edge : 1;  ///< of a shadow in the last frame
  std::uint32_t opens : 31;   ///< of a node of the tree, by bits: below a page of which depth it has its own
};

/// Levels of all bases.
inline constexpr std::size_t kLadders = std::size_t{kMaxMaps} * kLadder;
/// Most samples of a plan.
inline constexpr std::size_t kPageSamples = 60000;
static_assert(kLadders * sizeof(PageGrid) + kPageSamples * sizeof(PageSample) + 16 <=
              kMaxPageLevels * sizeof(ShadowMap));

struct PageContext;
struct ResolvedPages;

/// The caller's memory, in parts.
struct PageMemory {
  std::span<ShadowMap> levels;     ///< kMaxPageLevels; the plan uses a few dozen
  std::span<PageGrid> grids;       ///< kLadders, in the place of `levels`, which are written last
  std::span<PageSample> samples;   ///< kPageSamples, behind the grids
  std::span<Page> pages;           ///< PageOptions::capacity
  std::span<std::uint32_t> table;  ///< page_table_size(capacity)
  PageContext* context = nullptr;  ///< one
  std::span<PagePoint> points;     ///< at least as many as visible points
};

/// A base map, and places on it: (row_x, row_y) over row_w, each applied to (point, 1).
struct PageBase {
  ShadowMap map;
  glm::dvec4 row_x{0.0}, row_y{0.0}, row_w{0.0};
  glm::dvec2 low{0.0}, high{1.0};  ///< places that the map shows
  glm::dvec2 side{1.0};            ///< of a page of the coarsest level, in units of places
  glm::dvec2 unit{1.0};            ///< units of places along the map's sides
  glm::dvec2 shift{0.0};           ///< added to places: where the grids of all levels begin
  bool fixed = false;              ///< the grid does not follow the camera: no size is tried

  /// Above 0 in front of the light.
  [[nodiscard]] double distance(const glm::dvec3& p) const noexcept { return applied(row_w, p); }
  [[nodiscard]] glm::dvec2 place(const glm::dvec3& p) const noexcept {
    return glm::dvec2(applied(row_x, p), applied(row_y, p)) * (1.0 / distance(p));
  }
  [[nodiscard]] bool holds(const glm::dvec3& p) const noexcept {
    if (!(distance(p) > 0.0)) return false;
    const glm::dvec2 at = place(p);
    return at.x >= low.x && at.y >= low.y && at.x <= high.x && at.y <= high.y;
  }

 private:
  [[nodiscard]] static double applied(const glm::dvec4& row, const glm::dvec3& p) noexcept {
    return row.x * p.x + row.y * p.y + row.z * p.z + row.w;
  }
};

/// What the stages of a page plan share. Points are memory.points[0 .. point_count).
struct PageContext {
  const Camera& camera;
  const View& view;
  const PageHistory& history;
  const PageOptions& options;
  const PageMemory& memory;
  CameraAxes axes;
  std::array<PageBase, kMaxMaps> base = {};
  int base_count = 0;
  bool select_by_map = false;   ///< the first base that holds a point serves it
  int steps = 1;                ///< of the ladder per octave
  int deepest = 0;              ///< last step of the ladder
  double target = 1.0;          ///< of this try
  double per_page = 1.0;        ///< 1 / PageOptions::page_texels
  std::size_t point_count = 0;  ///< outside ones included
  std::uint64_t outside = 0, edge_on = 0;
  std::size_t page_count = 0;
  std::size_t chosen = 0;                ///< first pages of memory.pages, which the policy opened by itself
  std::size_t sample_count = 0;          ///< of memory.samples; 0: none were taken yet
  std::array<double, kLadder> shrink{};  ///< texels of a step over those of the first

  [[nodiscard]] PageBase& base_of(std::uint32_t level) noexcept { return base[level / kLadder]; }
  [[nodiscard]] const PageBase& base_of(std::uint32_t level) const noexcept { return base[level / kLadder]; }
  /// How many times too coarse the first step is for an error of 1.
  [[nodiscard]] double excess(const PagePoint& point) const noexcept {
    const PageBase& b = base_of(point.level);
    return max_of(point.need_x * b.side.x, point.need_y * b.side.y) * per_page;
  }
  /// The first step of the ladder that is fine enough; the deepest where none is.
  [[nodiscard]] int step_for(double excess_at_target) const noexcept {
    if (!(excess_at_target > 1.0)) return excess_at_target != excess_at_target ? deepest : 0;
    if (!(excess_at_target * shrink[static_cast<std::size_t>(deepest)] <= 1.0)) return deepest;
    // The exponent, of a number above 1.
    const auto octaves = static_cast<int>(std::bit_cast<std::uint64_t>(excess_at_target) >> 52) - 1023;
    int step = std::min(octaves * steps, deepest);
    // No branch: neighbouring points need different steps. It stops at the first that suffices.
    for (int i = 0; i < steps; ++i) step += excess_at_target * shrink[static_cast<std::size_t>(step)] > 1.0;
    return step;
  }
  /// Gives the point a step of its base's ladder.
  void set_step(PagePoint& point, int step) const noexcept {
    const int kept = step < 0 ? 0 : step > deepest ? deepest : step;
    point.level = point.level / kLadder * kLadder + static_cast<std::uint32_t>(kept);
  }
  /// Calls f(point, index) for each point that a base holds.
  template <typename F>
  void for_each_point(F&& f) noexcept {
    for (std::size_t i = 0; i < point_count; ++i) {
      if (memory.points[i].level != kOutside) f(memory.points[i], i);
    }
  }
  /// Gives each point the coarsest step that keeps the target.
  void set_steps_by_need() noexcept {
    const double inverse = 1.0 / target;
    for_each_point(
        [&](PagePoint& point, std::size_t) { set_step(point, step_for(excess(point) * inverse)); });
  }
  [[nodiscard]] std::uint8_t feedback(std::size_t point) const noexcept {
    return history.feedback.empty() ? std::uint8_t{0} : history.feedback[point];
  }
  [[nodiscard]] PageGrid grid(std::uint32_t level) const noexcept {
    const PageBase& b = base_of(level);
    PageGrid g{};
    g.side = b.side * shrink[level % kLadder];
    const glm::dvec2 low = (b.low + b.shift) / g.side, high = (b.high + b.shift) / g.side;
    // Beyond, doubles hold no whole number of pages: positions there are rounding.
    constexpr double kFarthest = 0x1p53, kMaxPagesAcross = 0x1p22;
    g.first_x = static_cast<std::int64_t>(clamp_to(std::floor(low.x), -kFarthest, kFarthest));
    g.first_y = static_cast<std::int64_t>(clamp_to(std::floor(low.y), -kFarthest, kFarthest));
    const auto across = [](double last, std::int64_t first) {
      return static_cast<std::int32_t>(
                 clamp_to(std::floor(last) - static_cast<double>(first), 0.0, kMaxPagesAcross)) +
             1;
    };
    g.columns = across(high.x, g.first_x);
    g.rows = across(high.y, g.first_y);
    g.scale = 1.0 / g.side;
    g.offset = b.shift / g.side - glm::dvec2(g.first_x, g.first_y);
    return g;
  }
};

/// Plans the base maps; returns the status of that plan, and writes what it says besides pages to `out`.
[[nodiscard]] PlanStatus plan_base(const Light& light, const SceneBounds& bounds, const ResolvedPages& how,
                                   PageContext& context, PagePlan& out) noexcept;
/// Fills memory.points with the visible points, or with samples of the boxes.
void add_points(const SceneBounds& bounds, PageContext& context) noexcept;
/// Gives the sides of pages the aspect that wastes the fewest texels, and a size within a step of the ladder
/// that goes by `trial`: 0 is the largest.
void size_base(int trial, PageContext& context) noexcept;

}  // namespace gnomon
