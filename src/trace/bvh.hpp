// A tree of boxes over triangles, in double precision.
// Based on: Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007; Woop, Benthin, Wald,
// Watertight Ray/Triangle Intersection, 2013; Ize, Robust BVH Ray Traversal, 2013.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "gnomon/trace/tracer.hpp"
#include "world_triangles.hpp"

namespace gnomon::trace {

class Bvh {
 public:
  /// Refers to `triangles`, which must outlive it.
  explicit Bvh(const WorldTriangles& triangles);

  [[nodiscard]] bool occluded(const Ray& ray) const noexcept;
  [[nodiscard]] Hit first_hit(const Ray& ray) const noexcept;
  [[nodiscard]] Hit first_caster(const Ray& ray) const noexcept;
  [[nodiscard]] Hit first_seen(const Ray& ray) const noexcept;
  [[nodiscard]] Hit hit_nearest_to(const Ray& ray, double t) const noexcept;
  /// Calls meet(triangle, b1, b2) for every triangle on the ray, in no order; b1 and b2 weigh its second and
  /// third corner there. A triangle on its edge counts as met, so that two may share a point.
  void each_hit(const Ray& ray, const std::function<void(std::uint32_t, double, double)>& meet) const;

 private:
  struct Node {
    glm::dvec3 min, max;
    std::uint32_t first = 0;  ///< of a leaf: into order_; else the second child (the first is the next node)
    std::uint32_t count = 0;  ///< of a leaf's triangles; 0: not a leaf
  };
  struct Build;

  /// Calls accept(triangle, t, b1, b2) for every triangle that the ray meets, boxes in no order; `end` may be
  /// lowered in between. Stops where accept answers true.
  template <class Accept>
  void walk(const Ray& ray, double& end, Accept&& accept) const noexcept;
  /// The nearest hit of a triangle that counts.
  template <class Counts>
  [[nodiscard]] Hit first_of(const Ray& ray, Counts&& counts) const noexcept;
  [[nodiscard]] Hit filled(std::uint32_t triangle, double t) const noexcept;

  const WorldTriangles& triangles_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  ///< triangle numbers, leaf by leaf
};

}  // namespace gnomon::trace
