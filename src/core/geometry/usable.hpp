// Which numbers and boxes does the core take at all?
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "gnomon/bounds.hpp"

namespace gnomon {

/// Largest magnitude accepted anywhere: its square, and a product of three such, stay far inside double's
/// range.
inline constexpr double kLargest = 1e30;

[[nodiscard]] inline bool usable(double v) noexcept {
  return std::abs(v) <= kLargest;
}  // false for NaN
[[nodiscard]] inline bool usable(const glm::dvec3& v) noexcept {
  return usable(v.x) && usable(v.y) && usable(v.z);
}
[[nodiscard]] inline bool usable(const Box& box) noexcept {
  if (usable(box.min) && usable(box.max)) return true;
  // An empty box may hold infinities: that is how one is made.
  const auto has_nan = [](const glm::dvec3& v) {
    return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z);
  };
  return box.empty() && !has_nan(box.min) && !has_nan(box.max);
}

}  // namespace gnomon
