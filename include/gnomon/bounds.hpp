// Axis-aligned boxes: how casters and receivers are told to the core.
#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace gnomon {

/// An axis-aligned box in world units. Flat and single-point boxes are legal; a box with min > max on any
/// axis is empty and takes no part in anything.
struct Box {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const noexcept { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  /// Grows the box to hold `point` (same space as the box).
  void extend(const glm::dvec3& point) noexcept {
    min = {point.x < min.x ? point.x : min.x, point.y < min.y ? point.y : min.y,
           point.z < min.z ? point.z : min.z};
    max = {point.x > max.x ? point.x : max.x, point.y > max.y ? point.y : max.y,
           point.z > max.z ? point.z : max.z};
  }
  /// Grows the box to hold `other`; an empty `other` changes nothing.
  void extend(const Box& other) noexcept {
    if (other.empty()) return;
    extend(other.min);
    extend(other.max);
  }
};

/// What throws shadows and what shadows fall on, as boxes in world space. The two lists may be the same span;
/// the memory stays the caller's and is only read during the call it is passed to.
struct SceneBounds {
  std::span<const Box> casters;
  std::span<const Box> receivers;
};

}  // namespace gnomon
