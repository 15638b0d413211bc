// Eight boxes side by side against planes and bounds: the tests that all culling of casters goes through.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/extend/body.hpp"
#include "lanes/lanes.hpp"
#include "lanes/pair.hpp"

namespace gnomon {

/// Boxes of a block.
inline constexpr std::size_t kLanes = CasterBlock::kLanes;
static_assert(kLanes == kDoubleLanes);

/// A box that only touches a plane is across it: rounding must not lose a flat receiver that lies in the
/// plane.
inline constexpr double kTouching = 1e-12;

/// Puts a box of a list or a leaf into a lane; `unusable` stays as it is.
inline void set_lane(CasterBlock& block, std::size_t lane, const Box& box) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    block.min[axis][lane] = box.min[static_cast<int>(axis)];
    block.max[axis][lane] = box.max[static_cast<int>(axis)];
  }
  const auto bit = static_cast<std::uint8_t>(1u << lane);
  block.occupied = static_cast<std::uint8_t>(box.empty() ? block.occupied & ~bit : block.occupied | bit);
  block.full = block.occupied;
}

/// Calls `use` with each set bit's number.
template <typename Use>
inline void for_each_bit(std::uint32_t bits, Use&& use) noexcept {
  for (; bits != 0; bits &= bits - 1) use(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Which corner of a box a sum is taken at, and what of the sum is asked.
enum class Ask : std::uint8_t {
  outside,  ///< the corner farthest inside is outside: so is the box
  across,   ///< the corner farthest outside is not inside
};

/// Bit per lane. The sums are in one order for all that cull, for the same rounding. A sum that is no number
/// (an endless box) is neither outside nor inside.
template <Ask ask>
[[nodiscard]] inline std::uint32_t lanes(const glm::dvec4& plane, const CasterBlock& block) noexcept {
  const auto corner = [&](std::size_t axis, double slope) -> const CasterBlock::Lanes& {
    return (slope > 0.0) == (ask == Ask::outside) ? block.max[axis] : block.min[axis];
  };
  const CasterBlock::Lanes &x = corner(0, plane.x), &y = corner(1, plane.y), &z = corner(2, plane.z);
  const Pair px(plane.x), py(plane.y), pz(plane.z), pw(plane.w), zero(0.0);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kLanes; i += 2) {
    const Pair sum = px * Pair::from(&x[i]) + py * Pair::from(&y[i]) + pz * Pair::from(&z[i]) + pw;
    bits |= (ask == Ask::outside ? below(sum, zero) : at_least(sum, zero) ^ 3u) << i;
  }
  return bits;
}

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

/// The sides of the first `used` lanes. Without `across`, boxes across a plane count as inside, in half the
/// time. Monotone, as every rounded step of it is: a node that is outside has only boxes that are, one that
/// is inside likewise.
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
  const Pair nx(n.x), ny(n.y), nz(n.z), offset(plane.offset), touching(-kTouching), zero(0.0);
  const auto sum = [&](const CasterBlock::Lanes& x, const CasterBlock::Lanes& y, const CasterBlock::Lanes& z,
                       std::size_t i) {
    return Pair::from(&x[i]) * nx + Pair::from(&y[i]) * ny + Pair::from(&z[i]) * nz;
  };
  for (std::size_t i = 0; i < used; i += 2) {
    const Pair inward = sum(ix, iy, iz, i);
    outside |= below(inward + offset, touching * (abs(inward) + abs(offset))) << i;
    if constexpr (across) inside |= at_least(sum(ox, oy, oz, i) + offset, zero) << i;
  }
  return {outside, across ? ~(outside | inside) & 0xffu : 0u};
}

/// Lanes that reach beyond these bounds.
[[nodiscard]] inline std::uint32_t lanes_beyond(const glm::dvec3& low, const glm::dvec3& high,
                                                const CasterBlock& block) noexcept {
  const std::size_t used = used_lanes(block);
  std::uint32_t beyond = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Pair l(low[static_cast<int>(axis)]), h(high[static_cast<int>(axis)]);
    for (std::size_t i = 0; i < used; i += 2)
      beyond |= (below(Pair::from(&block.min[axis][i]), l) | below(h, Pair::from(&block.max[axis][i]))) << i;
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
      const bool filled = (world.occupied >> i & 1) != 0;
      out.min[axis][i] = (filled ? world.min[axis][i] : o) - o;
      out.max[axis][i] = (filled ? world.max[axis][i] : o) - o;
    }
  }
  out.occupied = world.occupied;
}
/// Puts up to eight boxes of a list into a block. Lanes beyond them stay as they were, and are not occupied.
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

}  // namespace gnomon
