// Which pages of a plan does a pool still hold from earlier frames, and where do the others go?
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "geometry/matrix.hpp"
#include "gnomon/pages.hpp"

namespace gnomon {
namespace {

/// Planes of the four sides, and of the light's place: also where a page's own far plane would leave out a
/// caster, as another clip space would put that elsewhere.
struct PageSides {
  std::array<glm::dvec4, 5> plane;

  explicit PageSides(const glm::dmat4& clip_from_world) noexcept {
    const glm::dvec4 x = row_of(clip_from_world, 0), y = row_of(clip_from_world, 1),
                     w = row_of(clip_from_world, 3);
    plane = {w + x, w - x, w + y, w - y, w};
  }
  /// False where the box lies beyond one of them.
  [[nodiscard]] bool may_hold(const Box& box) const noexcept {
    return std::all_of(plane.begin(), plane.end(), [&](const glm::dvec4& p) {
      double farthest = p.w, magnitude = std::abs(p.w);
      for (int axis = 0; axis < 3; ++axis) {
        const double term = p[axis] * (p[axis] > 0.0 ? box.max[axis] : box.min[axis]);
        farthest += term;
        magnitude += std::abs(term);
      }
      // A caster that touches an edge counts, whatever is rounded.
      constexpr double kRounding = 1e-12;
      return farthest >= -kRounding * magnitude;
    });
  }
};

/// Under parallel light: false where a line along an edge of the box parts its outline from the page.
/// Together with the sides, that decides for the box exactly.
bool outline_may_reach(const glm::dmat4& m, const Box& box) noexcept {
  const bool parallel = m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] > 0.0;
  if (!parallel) return true;
  const glm::dvec3 middle = 0.5 * (box.min + box.max), half = 0.5 * (box.max - box.min);
  const glm::dvec2 at(m * glm::dvec4(middle, 1.0));
  for (int edge = 0; edge < 3; ++edge) {
    const glm::dvec2 across(-m[edge][1], m[edge][0]);
    double reach = m[3][3] * (std::abs(across.x) + std::abs(across.y));
    for (int axis = 0; axis < 3; ++axis)
      reach += std::abs(across.x * m[axis][0] + across.y * m[axis][1]) * half[axis];
    const double off = std::abs(glm::dot(across, at));
    constexpr double kRounding = 1e-9;
    if (off > reach + kRounding * (off + reach)) return false;
  }
  return true;
}

/// By the rows that differ from page to page.
std::uint64_t hash_of(const glm::dmat4& m) noexcept {
  std::uint64_t h = 0x9E3779B97F4A7C15u;
  for (const double value : {m[0][0], m[1][0], m[2][0], m[3][0], m[3][1]}) {
    // Adding 0 turns -0 into 0, which equals it.
    h = (h ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0xBF58476D1CE4E5B9u;
    h ^= h >> 29;
  }
  return h;
}

/// Slots by the page they hold; entries are indices plus one.
class HeldSlots {
 public:
  HeldSlots(std::span<const PageSlot> slots, std::span<std::uint32_t> table) noexcept
      : slots_(slots), table_(table.first(std::bit_floor(table.size()))) {
    std::fill(table_.begin(), table_.end(), 0u);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (slots[i].used == 0) continue;
      std::size_t at = first_of(slots[i].clip_from_world);
      while (table_[at] != 0) at = (at + 1) & (table_.size() - 1);
      table_[at] = static_cast<std::uint32_t>(i + 1);
    }
  }
  /// The slot that holds the page, or -1.
  [[nodiscard]] std::int64_t find(const glm::dmat4& clip_from_world, int texels) const noexcept {
    for (std::size_t at = first_of(clip_from_world); table_[at] != 0; at = (at + 1) & (table_.size() - 1)) {
      const PageSlot& slot = slots_[table_[at] - 1];
      if (slot.texels == texels && slot.clip_from_world == clip_from_world) return table_[at] - 1;
    }
    return -1;
  }

 private:
  [[nodiscard]] std::size_t first_of(const glm::dmat4& m) const noexcept {
    return static_cast<std::size_t>(hash_of(m)) & (table_.size() - 1);
  }
  std::span<const PageSlot> slots_;
  std::span<std::uint32_t> table_;
};

/// Empties the slots that a moved static caster reaches, and marks those that a moving one reaches; returns
/// how many it emptied.
std::uint64_t empty_touched(std::span<const Box> moved, std::span<const Box> moving,
                            std::span<PageSlot> slots) noexcept {
  std::uint64_t touched = 0;
  if (moved.empty() && moving.empty()) return touched;
  for (PageSlot& slot : slots) {
    if (slot.used == 0) continue;
    const PageSides sides(slot.clip_from_world);
    const auto reached_by = [&](std::span<const Box> boxes) {
      return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
        return !box.empty() && sides.may_hold(box) && outline_may_reach(slot.clip_from_world, box);
      });
    };
    if (reached_by(moved)) {
      slot.used = 0;
      ++touched;
    } else if (!slot.behind) {
      slot.behind = reached_by(moving);
    }
  }
  return touched;
}

}  // namespace

KeptPages keep_pages(const PagePlan& plan, std::span<const Box> moved_world, std::span<PageSlot> slots,
                     std::span<std::uint32_t> table, std::span<KeptPage> out,
                     std::span<const Box> moving_world) noexcept {
  KeptPages kept;
  const std::size_t pages = plan.pages.size();
  const bool countable = slots.size() <= 2 * static_cast<std::size_t>(kMaxPages);
  if (!countable || slots.size() < pages || out.size() < pages ||
      table.size() < page_table_size(static_cast<int>(slots.size())))
    return kept;
  kept.fits = true;
  kept.touched = empty_touched(moved_world, moving_world, slots);
  std::uint64_t now = 0;
  for (const PageSlot& slot : slots) now = std::max(now, slot.used);
  ++now;
  const HeldSlots held(slots, table);
  for (std::size_t i = 0; i < pages; ++i) {
    const std::int64_t slot = held.find(page_map(plan, plan.pages[i]).clip_from_world, plan.slot_texels());
    out[i] = {static_cast<std::uint32_t>(slot < 0 ? 0 : slot), slot < 0, false};
    if (slot < 0) continue;
    PageSlot& at = slots[static_cast<std::size_t>(slot)];
    at.used = now;
    out[i].compose = std::exchange(at.behind, false);
    ++(out[i].compose ? kept.composed : kept.kept);
  }
  kept.drawn = pages - kept.kept - kept.composed;
  if (kept.drawn == 0) return kept;
  // The table has been read: now the slots that are free, the longest unused first.
  std::size_t free = 0;
  for (std::uint32_t i = 0; i < slots.size(); ++i) {
    if (slots[i].used != now) table[free++] = i;
  }
  std::sort(table.begin(), table.begin() + static_cast<std::ptrdiff_t>(free),
            [&](std::uint32_t a, std::uint32_t b) {
              return slots[a].used != slots[b].used ? slots[a].used < slots[b].used : a < b;
            });
  std::size_t next = 0;
  for (std::size_t i = 0; i < pages; ++i) {
    if (!out[i].draw) continue;
    out[i].slot = table[next++];
    slots[out[i].slot] = {page_map(plan, plan.pages[i]).clip_from_world, plan.slot_texels(), now, false};
  }
  return kept;
}

}  // namespace gnomon
