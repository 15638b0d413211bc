// Two points of a body at once: vertices in space, and points as warps see them.
#pragma once

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "lanes/pair.hpp"

namespace gnomon {

/// The positions of two vertices, each coordinate in the place of its own vertex.
struct VertexPair {
  using One = Polytope::Vertex;
  Pair x, y, z;
  VertexPair(const One& p, const One& q) noexcept
      : VertexPair(Pair::from(&p.position.x), Pair::from(&q.position.x), Pair(p.position.z, q.position.z)) {}

 private:
  VertexPair(Pair p_xy, Pair q_xy, Pair both_z) noexcept
      : x(lows(p_xy, q_xy)), y(highs(p_xy, q_xy)), z(both_z) {}
};

/// Dot product of a direction and each of two positions.
class DotPair {
 public:
  explicit DotPair(const glm::dvec3& direction) noexcept
      : x_(direction.x), y_(direction.y), z_(direction.z) {}
  [[nodiscard]] Pair operator()(const VertexPair& two) const noexcept {
    return two.x * x_ + two.y * y_ + two.z * z_;
  }

 private:
  Pair x_, y_, z_;
};

/// The coordinates of two points, each in the place of its own number.
struct PointPair {
  using One = WarpInput::Point;
  Pair x, y;      ///< light plane
  Pair z, depth;  ///< as WarpInput::Point
  PointPair(const One& p, const One& q) noexcept
      : PointPair(Pair::from(&p.x), Pair::from(&q.x), Pair::from(&p.z), Pair::from(&q.z)) {}

 private:
  PointPair(Pair p_xy, Pair q_xy, Pair p_z, Pair q_z) noexcept
      : x(lows(p_xy, q_xy)), y(highs(p_xy, q_xy)), z(lows(p_z, q_z)), depth(highs(p_z, q_z)) {}
};

}  // namespace gnomon
