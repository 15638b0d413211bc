// Two points of a body at once.
#pragma once

#include <cstddef>
#include <span>

#include "geometry/pair.hpp"
#include "gnomon/warp.hpp"

namespace gnomon {

/// The coordinates of two points, each in the place of its own number.
struct PointPair {
  Pair x, y;      ///< light plane
  Pair z, depth;  ///< as WarpInput::Point
};

/// Calls `use` with two points after another. The last of an odd number comes with itself.
template <typename Use>
inline void for_each_two(std::span<const WarpInput::Point> body, Use&& use) noexcept {
  for (std::size_t i = 0; i < body.size(); i += 2) {
    const WarpInput::Point& p = body[i];
    const WarpInput::Point& q = body[i + 1 < body.size() ? i + 1 : i];
    const Pair p_xy = Pair::from(&p.x), q_xy = Pair::from(&q.x);
    const Pair p_z = Pair::from(&p.z), q_z = Pair::from(&q.z);
    use(PointPair{lows(p_xy, q_xy), highs(p_xy, q_xy), lows(p_z, q_z), highs(p_z, q_z)});
  }
}

}  // namespace gnomon
