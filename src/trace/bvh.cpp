// A tree of boxes over triangles, in double precision.
// Based on: Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007; Woop, Benthin, Wald,
// Watertight Ray/Triangle Intersection, 2013; Ize, Robust BVH Ray Traversal, 2013.
#include "bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace gnomon::trace {
namespace {

constexpr int kBins = 16;  // more gain a per cent of traversal at most (Wald 2007, section 3.4)
constexpr std::uint32_t kLeafTriangles = 4;
// Splits by area down to this depth, then by halves: 2^32 triangles add at most 32 levels, and the stack of a
// walk holds one node per level.
constexpr int kDepthBySah = 64;
constexpr std::size_t kStack = kDepthBySah + 33;

double half_area(const Box& box) noexcept {
  if (box.empty()) return 0.0;
  const glm::dvec3 e = box.max - box.min;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

/// A ray as the watertight test wants it: its longest axis last, and the shear that stands it upright.
struct ShearedRay {
  glm::dvec3 origin;
  int x, y, z;
  double sx, sy, sz;

  explicit ShearedRay(const Ray& ray) noexcept : origin(ray.origin) {
    const glm::dvec3 d = ray.direction, a = glm::abs(d);
    z = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
    x = (z + 1) % 3;
    y = (x + 1) % 3;
    if (d[z] < 0.0) std::swap(x, y);
    sx = d[x] / d[z];
    sy = d[y] / d[z];
    sz = 1.0 / d[z];
  }
};

struct Crossing {
  bool hit = false;
  double t = 0.0, b1 = 0.0, b2 = 0.0;
};

/// Edges belong to both of their triangles, so that no ray slips through between.
Crossing crossing(const ShearedRay& ray, const WorldTriangles::Corners& corners) noexcept {
  std::array<glm::dvec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 q = corners[i] - ray.origin;
    p[i] = {q[ray.x] - ray.sx * q[ray.z], q[ray.y] - ray.sy * q[ray.z], ray.sz * q[ray.z]};
  }
  const double u = p[2].x * p[1].y - p[2].y * p[1].x;
  const double v = p[0].x * p[2].y - p[0].y * p[2].x;
  const double w = p[1].x * p[0].y - p[1].y * p[0].x;
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return {};
  const double det = u + v + w;
  if (det == 0.0) return {};
  return {true, (u * p[0].z + v * p[1].z + w * p[2].z) / det, v / det, w / det};
}

}  // namespace

struct Bvh::Build {
  struct Item {
    Box box;
    glm::dvec3 centre;
  };
  const WorldTriangles& triangles;
  std::vector<Node>& nodes;
  std::vector<std::uint32_t>& order;
  std::vector<Item> items;

  Build(const WorldTriangles& from, std::vector<Node>& to_nodes, std::vector<std::uint32_t>& to_order)
      : triangles(from), nodes(to_nodes), order(to_order), items(from.corners.size()) {
    order.resize(items.size());
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = 0; i < items.size(); ++i) {
      for (const glm::dvec3& corner : triangles.corners[i]) items[i].box.extend(corner);
      items[i].centre = 0.5 * (items[i].box.min + items[i].box.max);
    }
    nodes.reserve(items.size());
    if (!items.empty()) node(0, static_cast<std::uint32_t>(items.size()), 0);
  }

  /// Where to part [begin, end) of the order: by the surface area heuristic over bins of the longest axis, or
  /// by halves where all centres fall together. `begin`: not at all.
  std::uint32_t parted(std::uint32_t begin, std::uint32_t end, int depth, const Box& box) {
    if (end - begin <= kLeafTriangles) return begin;
    Box centres;
    for (std::uint32_t i = begin; i < end; ++i) centres.extend(items[order[i]].centre);
    const glm::dvec3 extent = centres.max - centres.min;
    const int axis = extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
    const auto by_halves = [&] {
      const std::uint32_t middle = begin + (end - begin) / 2;
      std::nth_element(
          order.begin() + begin, order.begin() + middle, order.begin() + end,
          [&](std::uint32_t a, std::uint32_t b) { return items[a].centre[axis] < items[b].centre[axis]; });
      return middle;
    };
    if (depth >= kDepthBySah || !(extent[axis] > 0.0)) return by_halves();

    const double scale = kBins / extent[axis], low = centres.min[axis];
    const auto bin_of = [&](std::uint32_t triangle) {
      return static_cast<std::size_t>(
          std::min((items[triangle].centre[axis] - low) * scale, static_cast<double>(kBins - 1)));
    };
    std::array<Box, kBins> bins;
    std::array<std::uint32_t, kBins> counts{};
    for (std::uint32_t i = begin; i < end; ++i) {
      bins[bin_of(order[i])].extend(items[order[i]].box);
      ++counts[bin_of(order[i])];
    }
    std::array<double, kBins> right{};  // cost of bins [i, kBins)
    Box grown;
    std::uint32_t count = 0;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      grown.extend(bins[i]);
      count += counts[i];
      right[i] = half_area(grown) * count;
    }
    std::size_t best = 0;
    double best_cost = std::numeric_limits<double>::infinity();
    grown = {};
    count = 0;
    for (std::size_t i = 1; i < kBins; ++i) {
      grown.extend(bins[i - 1]);
      count += counts[i - 1];
      const double cost = half_area(grown) * count + right[i];
      if (count > 0 && count < end - begin && cost < best_cost) {
        best_cost = cost;
        best = i;
      }
    }
    if (best == 0 || half_area(box) == 0.0) return by_halves();
    const auto middle = std::partition(order.begin() + begin, order.begin() + end,
                                       [&](std::uint32_t triangle) { return bin_of(triangle) < best; });
    return static_cast<std::uint32_t>(middle - order.begin());
  }

  void node(std::uint32_t begin, std::uint32_t end, int depth) {
    Box box;
    for (std::uint32_t i = begin; i < end; ++i) box.extend(items[order[i]].box);
    const std::size_t self = nodes.size();
    nodes.push_back({box.min, box.max, begin, end - begin});
    const std::uint32_t middle = parted(begin, end, depth, box);
    if (middle == begin || middle == end) return;
    nodes[self].count = 0;
    node(begin, middle, depth + 1);
    nodes[self].first = static_cast<std::uint32_t>(nodes.size());
    node(middle, end, depth + 1);
  }
};

Bvh::Bvh(const WorldTriangles& triangles) : triangles_(triangles) {
  const Build build(triangles, nodes_, order_);
}

template <class Accept>
void Bvh::walk(const Ray& ray, double& end, Accept&& accept) const noexcept {
  if (nodes_.empty()) return;
  // Rounding of the three operations of a slab test (Ize 2013).
  constexpr double kSlack = 8.0 * std::numeric_limits<double>::epsilon();
  const ShearedRay sheared(ray);
  const glm::dvec3 inverse = 1.0 / ray.direction;
  std::array<std::uint32_t, kStack> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    double enter = ray.begin, leave = end;
    for (int a = 0; a < 3; ++a) {
      const double t0 = (node.min[a] - ray.origin[a]) * inverse[a];
      const double t1 = (node.max[a] - ray.origin[a]) * inverse[a];
      if (std::isnan(t0) || std::isnan(t1))
        continue;  // 0 times infinity: the ray runs within the slab's side
      const double low = std::min(t0, t1), high = std::max(t0, t1);
      if (low > enter) enter = low;
      const double later = high + kSlack * std::abs(high);
      if (later < leave) leave = later;
    }
    if (enter > leave) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t triangle = order_[i];
      if (triangle == ray.except) continue;
      const Crossing at = crossing(sheared, triangles_.corners[triangle]);
      if (!at.hit || at.t < ray.begin || at.t > end || !triangles_.is_there(triangle, at.b1, at.b2)) continue;
      if (accept(triangle, at.t, at.b1, at.b2)) return;
    }
  }
}

bool Bvh::occluded(const Ray& ray) const noexcept {
  bool found = false;
  double end = ray.end;
  walk(ray, end,
       [&](std::uint32_t triangle, double, double, double) { return found = triangles_.casts[triangle]; });
  return found;
}

Hit Bvh::filled(std::uint32_t triangle, double t) const noexcept {
  const WorldTriangles::Corners& c = triangles_.corners[triangle];
  const glm::dvec3 area = glm::cross(c[1] - c[0], c[2] - c[0]);
  const double size = glm::length(area);
  return {triangle, t, size > 0.0 ? area / size : glm::dvec3(0.0)};
}

template <class Counts>
Hit Bvh::first_of(const Ray& ray, Counts&& counts) const noexcept {
  std::uint32_t best = kNoTriangle;
  double end = ray.end;
  walk(ray, end, [&](std::uint32_t triangle, double t, double, double) {
    if (!counts(triangle)) return false;
    best = triangle;
    end = t;
    return false;
  });
  return best == kNoTriangle ? Hit{} : filled(best, end);
}

Hit Bvh::first_hit(const Ray& ray) const noexcept {
  return first_of(ray, [&](std::uint32_t triangle) { return triangles_.shown[triangle]; });
}

Hit Bvh::first_caster(const Ray& ray) const noexcept {
  return first_of(ray, [&](std::uint32_t triangle) { return triangles_.casts[triangle]; });
}

Hit Bvh::first_seen(const Ray& ray) const noexcept {
  return first_of(ray, [&](std::uint32_t triangle) {
    const WorldTriangles::Corners& c = triangles_.corners[triangle];
    const double away = glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), ray.direction);
    return triangles_.shown[triangle] && triangles_.shown_side[triangle] * away <= 0.0;
  });
}

void Bvh::each_hit(const Ray& ray, const std::function<void(std::uint32_t, double, double)>& meet) const {
  double end = ray.end;
  walk(ray, end, [&](std::uint32_t triangle, double, double b1, double b2) {
    meet(triangle, b1, b2);
    return false;
  });
}

Hit Bvh::hit_nearest_to(const Ray& ray, double t) const noexcept {
  std::uint32_t best = kNoTriangle;
  double end = ray.end, at = 0.0;
  walk(ray, end, [&](std::uint32_t triangle, double found, double, double) {
    if (!triangles_.shown[triangle]) return false;
    if (best == kNoTriangle || std::abs(found - t) < std::abs(at - t)) {
      best = triangle;
      at = found;
    }
    return false;
  });
  return best == kNoTriangle ? Hit{} : filled(best, at);
}

}  // namespace gnomon::trace
