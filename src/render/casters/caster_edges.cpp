// Corners are joined by position, then edges are sorted by their two corners.
#include "casters/caster_edges.hpp"

#include <algorithm>
#include <tuple>

namespace gnomon::render {
namespace {

/// One side of a triangle. `low` and `high` are the joined corners that it runs between.
struct Side {
  std::uint32_t low, high, from, to, opposite;
};

/// By index of a corner of `triangles`: the least index among the corners at its position.
std::vector<std::uint32_t> joined_corners(std::span<const glm::vec3> positions,
                                          std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> order(triangles.begin(), triangles.end());
  const auto key = [&](std::uint32_t i) {
    const glm::vec3& p = positions[i];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return key(a) < key(b) || (!(key(b) < key(a)) && a < b);
  });
  std::vector<std::uint32_t> joined(positions.size());
  for (std::size_t i = 0, first = 0; i < order.size(); ++i) {
    if (key(order[first]) != key(order[i])) first = i;
    joined[order[i]] = order[first];
  }
  return joined;
}

}  // namespace

std::vector<std::uint32_t> caster_edges(std::span<const glm::vec3> positions,
                                        std::span<const std::uint32_t> triangles) {
  const std::vector<std::uint32_t> joined = joined_corners(positions, triangles);
  std::vector<Side> sides;
  for (std::size_t t = 0; t + 3 <= triangles.size(); t += 3) {
    const std::uint32_t corner[3] = {triangles[t], triangles[t + 1], triangles[t + 2]};
    const auto at = [&](int i) { return joined[corner[i % 3]]; };
    if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) continue;
    for (int i = 0; i < 3; ++i) {
      sides.push_back({std::min(at(i), at(i + 1)), std::max(at(i), at(i + 1)), corner[i], corner[(i + 1) % 3],
                       corner[(i + 2) % 3]});
    }
  }
  const auto ends = [](const Side& side) { return std::tuple(side.low, side.high); };
  std::stable_sort(sides.begin(), sides.end(),
                   [&](const Side& a, const Side& b) { return ends(a) < ends(b); });
  std::vector<std::uint32_t> edges;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && ends(sides[end]) == ends(sides[begin])) ++end;
    const Side& one = sides[begin];
    const Side& other = end - begin == 2 ? sides[begin + 1] : one;
    edges.insert(edges.end(), {one.opposite, one.from, one.to, other.opposite});
  }
  return edges;
}

}  // namespace gnomon::render
