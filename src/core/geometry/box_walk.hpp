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

#include "geometry/caster_lanes.hpp"
#include "gnomon/body.hpp"
#include "gnomon/caster_set.hpp"

namespace gnomon {

/// A box that only touches a plane is across it: rounding must not lose a flat receiver that lies in the
/// plane.
inline constexpr double kTouching = 1e-12;

/// A bit each of a word says which planes are still asked. Planes beyond these are not: more boxes count as
/// inside, none is lost.
inline constexpr std::size_t kMostPlanes = 32;

/// A box in lane `lane`.
[[nodiscard]] inline Box lane_box(const CasterBlock& block, std::size_t lane) noexcept {
  return {{block.min[0][lane], block.min[1][lane], block.min[2][lane]},
          {block.max[0][lane], block.max[1][lane], block.max[2][lane]}};
}

/// Lanes up to the last that holds anything, in pairs: lists may be short.
[[nodiscard]] inline std::size_t used_lanes(const CasterBlock& block) noexcept {
  return (static_cast<std::size_t>(std::bit_width(unsigned{block.occupied})) + 1) & ~std::size_t{1};
}

/// Which lanes a plane parts from its inside. What is neither outside nor across is inside.
struct LaneSides {
  std::uint32_t outside, across;
};

/// Of the first `used` lanes. Without `across`, boxes across a plane count as inside, in half the time.
/// Monotone, as every rounded step of it is: a node that is outside has only boxes that are, one that is
/// inside likewise.
template <bool across>
[[nodiscard]] inline LaneSides sides_of(const Plane& plane, const CasterBlock& block,
                                        std::size_t used) noexcept {
  const glm::dvec3& n = plane.normal;
  const auto inner = [&](int axis) -> const CasterBlock::Lanes& {
    return (n[axis] > 0.0 ? block.max : block.min)[static_cast<std::size_t>(axis)];
  };
  const auto outer = [&](int axis) -> const CasterBlock::Lanes& {
    return (n[axis] > 0.0 ? block.min : block.max)[static_cast<std::size_t>(axis)];
  };
  const CasterBlock::Lanes &ix = inner(0), &iy = inner(1), &iz = inner(2);
  const CasterBlock::Lanes &ox = outer(0), &oy = outer(1), &oz = outer(2);
  std::uint32_t outside = 0, inside = 0;
#if defined(__SSE2__)
  const __m128d nx = _mm_set1_pd(n.x), ny = _mm_set1_pd(n.y), nz = _mm_set1_pd(n.z);
  const __m128d offset = _mm_set1_pd(plane.offset), sign = _mm_set1_pd(-0.0);
  const __m128d offset_size = _mm_andnot_pd(sign, offset), touching = _mm_set1_pd(-kTouching);
  const auto sum = [&](const CasterBlock::Lanes& x, const CasterBlock::Lanes& y, const CasterBlock::Lanes& z,
                       std::size_t i) {
    const __m128d xy = _mm_add_pd(_mm_mul_pd(_mm_loadu_pd(&x[i]), nx), _mm_mul_pd(_mm_loadu_pd(&y[i]), ny));
    return _mm_add_pd(xy, _mm_mul_pd(_mm_loadu_pd(&z[i]), nz));
  };
  for (std::size_t i = 0; i < used; i += 2) {
    const __m128d inward = sum(ix, iy, iz, i);
    const __m128d limit = _mm_mul_pd(touching, _mm_add_pd(_mm_andnot_pd(sign, inward), offset_size));
    const __m128d out = _mm_cmplt_pd(_mm_add_pd(inward, offset), limit);
    outside |= static_cast<std::uint32_t>(_mm_movemask_pd(out)) << i;
    if constexpr (across) {
      const __m128d in = _mm_cmpge_pd(_mm_add_pd(sum(ox, oy, oz, i), offset), _mm_setzero_pd());
      inside |= static_cast<std::uint32_t>(_mm_movemask_pd(in)) << i;
    }
  }
#else
  for (std::size_t i = 0; i < used; ++i) {
    const double inward = ix[i] * n.x + iy[i] * n.y + iz[i] * n.z;
    const double outward = ox[i] * n.x + oy[i] * n.y + oz[i] * n.z;
    const double limit = -kTouching * (std::abs(inward) + std::abs(plane.offset));
    outside |= static_cast<std::uint32_t>(inward + plane.offset < limit) << i;
    inside |= static_cast<std::uint32_t>(outward + plane.offset >= 0.0) << i;
  }
#endif
  return {outside, across ? ~(outside | inside) & 0xffu : 0u};
}

/// Lanes that reach beyond these bounds.
[[nodiscard]] inline std::uint32_t lanes_beyond(const glm::dvec3& low, const glm::dvec3& high,
                                                const CasterBlock& block) noexcept {
  const std::size_t used = used_lanes(block);
  std::uint32_t beyond = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double l = low[static_cast<int>(axis)], h = high[static_cast<int>(axis)];
#if defined(__SSE2__)
    const __m128d l2 = _mm_set1_pd(l), h2 = _mm_set1_pd(h);
    for (std::size_t i = 0; i < used; i += 2) {
      const __m128d below = _mm_cmplt_pd(_mm_loadu_pd(&block.min[axis][i]), l2);
      const __m128d above = _mm_cmpgt_pd(_mm_loadu_pd(&block.max[axis][i]), h2);
      beyond |= static_cast<std::uint32_t>(_mm_movemask_pd(_mm_or_pd(below, above))) << i;
    }
#else
    for (std::size_t i = 0; i < used; ++i)
      beyond |= static_cast<std::uint32_t>(block.min[axis][i] < l || block.max[axis][i] > h) << i;
#endif
  }
  return beyond;
}

/// Largest dot(direction, p) over each lane's box.
[[nodiscard]] inline CasterBlock::Lanes reaches(const CasterBlock& block,
                                                const glm::dvec3& direction) noexcept {
  const auto corner = [&](int axis) -> const CasterBlock::Lanes& {
    return (direction[axis] > 0.0 ? block.max : block.min)[static_cast<std::size_t>(axis)];
  };
  const CasterBlock::Lanes &x = corner(0), &y = corner(1), &z = corner(2);
  CasterBlock::Lanes out;
  for (std::size_t i = 0; i < kLanes; ++i)
    out[i] = x[i] * direction.x + y[i] * direction.y + z[i] * direction.z;
  return out;
}
[[nodiscard]] inline std::uint32_t lanes_above(const CasterBlock::Lanes& values, double least) noexcept {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kLanes; ++i) bits |= static_cast<std::uint32_t>(values[i] > least) << i;
  return bits;
}

/// Eight boxes or nodes, relative to an origin. Lanes of nothing are zero, which arithmetic stands.
inline void set_relative(const CasterBlock& world, const glm::dvec3& origin, CasterBlock& out) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double o = origin[static_cast<int>(axis)];
    if (world.occupied == 0xff) {
      for (std::size_t i = 0; i < kLanes; ++i) {
        out.min[axis][i] = world.min[axis][i] - o;
        out.max[axis][i] = world.max[axis][i] - o;
      }
      continue;
    }
    for (std::size_t i = 0; i < kLanes; ++i) {
      const bool held = (world.occupied >> i & 1) != 0;
      out.min[axis][i] = (held ? world.min[axis][i] : o) - o;
      out.max[axis][i] = (held ? world.max[axis][i] : o) - o;
    }
  }
  out.occupied = world.occupied;
}
/// Of up to eight boxes of a list. Lanes beyond them stay as they were, and are not occupied.
inline void set_relative(std::span<const Box> boxes, const glm::dvec3& origin, CasterBlock& out) noexcept {
  std::uint32_t occupied = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& world = boxes[i];
    if (world.empty()) continue;
    occupied |= 1u << i;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<int>(axis);
      out.min[axis][i] = world.min[a] - origin[a];
      out.max[axis][i] = world.max[a] - origin[a];
    }
  }
  out.occupied = static_cast<std::uint8_t>(occupied);
}

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
      : planes_(planes.first(std::min(planes.size(), kMostPlanes))),
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
    const std::uint32_t asked = count == kMostPlanes ? ~0u : (1u << count) - 1u;
    if (const CasterSet* set = boxes_.set(); set != nullptr) {
      if (set->level_count() > 0) visit(*set, set->level_count() - 1, 0, asked);
      return;
    }
    const std::span<const Box> list = boxes_.list();
    CasterBlock block;
    for (std::size_t begin = 0; begin < list.size(); begin += kLanes) {
      set_relative(list.subspan(begin, std::min(kLanes, list.size() - begin)), origin_, block);
      std::array<std::uint8_t, kMostPlanes> open;
      (void)judge(block, true, asked, open);
    }
  }

  struct Below {
    std::uint32_t inside, across;
  };

  /// Tells the query of the block's lanes; returns those to look below.
  [[nodiscard]] Below judge(const CasterBlock& block, bool leaf, std::uint32_t asked,
                            std::array<std::uint8_t, kMostPlanes>& open) noexcept {
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
    std::array<std::uint8_t, kMostPlanes> open;
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
