// Questions to many boxes at once, eight side by side: down a CasterSet's tree or along a list, with one
// answer. Based on: Assarsson, Moeller, "Optimized View Frustum Culling Algorithms for Bounding Boxes", 2000
// (planes that a node is inside of are not asked again below it).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "gnomon/extend/body.hpp"
#include "lanes/casters.hpp"

namespace gnomon {

/// A bit each of a word says which planes are still asked. Planes beyond these are not: more boxes count as
/// inside, none is lost.
inline constexpr std::size_t kMaxPlanes = 32;

/// One walk over boxes for a query that grows its answer as it goes. A query has
///   uint32_t wanted(const CasterBlock&): lanes that could still change the answer,
///   uint32_t inside(const CasterBlock&, lanes, bool leaf): lanes whose boxes, or all boxes below which, are
///   inside
///     of every plane; returns those below which it wants to look further (of boxes: none),
///   kCuts: whether boxes across a plane count otherwise than those inside; then
///   void across(const CasterBlock&, lanes): boxes that are neither inside nor outside.
template <typename Query>
class BoxWalk {
 public:
  BoxWalk(std::span<const Plane> planes, const Boxes& boxes, const glm::dvec3& origin, Query& query) noexcept
      : planes_(planes.first(std::min(planes.size(), kMaxPlanes))),
        boxes_(boxes),
        origin_(origin),
        query_(query) {}

  /// Everything, down to the boxes.
  void whole() noexcept { pass(0, true); }
  /// Nothing below this level, and no box that is across: what is inside as a whole, cheaply.
  void coarse(std::size_t finest) noexcept { pass(finest, false); }

 private:
  void pass(std::size_t finest, bool across) noexcept {
    finest_ = finest;
    across_ = across;
    const std::size_t count = planes_.size();
    const std::uint32_t asked = count == kMaxPlanes ? ~0u : (1u << count) - 1u;
    if (const CasterSet* set = boxes_.set(); set != nullptr) {
      if (set->level_count() > 0) visit(*set, set->level_count() - 1, 0, asked);
      return;
    }
    const std::span<const Box> list = boxes_.list();
    CasterBlock block;
    for (std::size_t begin = 0; begin < list.size(); begin += kLanes) {
      set_relative(list.subspan(begin, std::min(kLanes, list.size() - begin)), origin_, block);
      std::array<std::uint8_t, kMaxPlanes> open;
      (void)judge(block, true, asked, open);
    }
  }

  struct Below {
    std::uint32_t inside, across;
  };

  /// Tells the query of the block's lanes; returns those to look below.
  [[nodiscard]] Below judge(const CasterBlock& block, bool leaf, std::uint32_t asked,
                            std::array<std::uint8_t, kMaxPlanes>& open) noexcept {
    std::uint32_t kept = block.occupied;
    if (kept != 0) kept &= query_.wanted(block);
    std::uint32_t across = 0;
    const std::size_t used = used_lanes(block);
    const bool apart = Query::kCuts || !leaf;
    // What eight boxes were outside of, the next often are, too.
    std::uint32_t rest = asked;
    std::size_t k = (asked >> last_ & 1) != 0 ? last_ : static_cast<std::size_t>(std::countr_zero(rest));
    while (rest != 0 && kept != 0) {
      const LaneSides sides =
          apart ? sides_of<true>(planes_[k], block, used) : sides_of<false>(planes_[k], block, used);
      kept &= ~sides.outside;
      open[k] = static_cast<std::uint8_t>(sides.across);
      across |= sides.across;
      rest &= ~(std::uint32_t{1} << k);
      if (kept == 0) last_ = k;
      k = static_cast<std::size_t>(std::countr_zero(rest));
    }
    Below below{0, across & kept};
    if (const std::uint32_t inside = kept & ~across; inside != 0)
      below.inside = query_.inside(block, inside, leaf);
    if constexpr (Query::kCuts) {
      if (leaf && across_ && below.across != 0) query_.across(block, below.across);
    }
    return below;
  }

  void visit(const CasterSet& set, std::size_t level, std::size_t at, std::uint32_t asked) noexcept {
    CasterBlock block;
    set_relative(set.block(level, at), origin_, block);
    std::array<std::uint8_t, kMaxPlanes> open;
    const Below below = judge(block, level == 0, asked, open);
    if (level <= finest_) return;
    // What was found below one child may leave nothing to ask of the next.
    for_each_wanted(block, below.inside,
                    [&](std::size_t lane) { visit(set, level - 1, at * kLanes + lane, 0); });
    for_each_wanted(block, below.across, [&](std::size_t lane) {
      std::uint32_t still = 0;
      for_each_bit(asked, [&](std::size_t k) { still |= (std::uint32_t{open[k]} >> lane & 1u) << k; });
      visit(set, level - 1, at * kLanes + lane, still);
    });
  }
  template <typename Use>
  void for_each_wanted(const CasterBlock& block, std::uint32_t lanes, Use&& use) noexcept {
    while (lanes != 0) {
      use(static_cast<std::size_t>(std::countr_zero(lanes)));
      lanes &= lanes - 1;
      if (lanes != 0) lanes &= query_.wanted(block);
    }
  }

  std::span<const Plane> planes_;
  const Boxes& boxes_;
  glm::dvec3 origin_;
  Query& query_;
  std::size_t finest_ = 0, last_ = 0;
  bool across_ = true;
};

}  // namespace gnomon
