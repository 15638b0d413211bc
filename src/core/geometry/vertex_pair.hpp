// Two vertices of a body at once.
#pragma once

#include <cstddef>
#include <span>

#include "geometry/pair.hpp"
#include "gnomon/body.hpp"

namespace gnomon {

/// The positions of two vertices, each coordinate in the place of its own vertex.
struct VertexPair {
  Pair x, y, z;
};

/// Calls `use` with each even index and the vertices there and behind it. The last of an odd number comes
/// with itself.
template <typename Use>
inline void for_each_two(std::span<const Polytope::Vertex> vertices, Use&& use) noexcept {
  for (std::size_t i = 0; i < vertices.size(); i += 2) {
    const glm::dvec3& p = vertices[i].position;
    const glm::dvec3& q = vertices[i + 1 < vertices.size() ? i + 1 : i].position;
    const Pair p_xy = Pair::from(&p.x), q_xy = Pair::from(&q.x);
    use(i, VertexPair{lows(p_xy, q_xy), highs(p_xy, q_xy), Pair(p.z, q.z)});
  }
}

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

}  // namespace gnomon
