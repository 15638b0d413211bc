// Small vector helpers that no input breaks: lengths without overflow, a spare axis.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lanes/pair.hpp"

namespace gnomon {

[[nodiscard]] inline bool is_finite(const glm::dvec3& v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

[[nodiscard]] inline double largest_component(const glm::dvec3& v) noexcept {
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

/// Unit vector along `v`, also where its square would overflow or vanish; `fallback` for the zero vector.
[[nodiscard]] inline glm::dvec3 safe_normalize(const glm::dvec3& v, const glm::dvec3& fallback) noexcept {
  const double scale = largest_component(v);
  if (!(scale > 0.0)) return fallback;
  const Pair xy = Pair(v.x, v.y) / Pair(scale);
  const double x = xy.low(), y = xy.high(), z = v.z / scale, length = std::sqrt(x * x + y * y + z * z);
  const Pair unit_xy = xy / Pair(length);
  return {unit_xy.low(), unit_xy.high(), z / length};
}

/// The world axis that makes the largest angle with `v`.
[[nodiscard]] inline glm::dvec3 least_aligned_axis(const glm::dvec3& v) noexcept {
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  if (x <= y && x <= z) return {1.0, 0.0, 0.0};
  return y <= z ? glm::dvec3{0.0, 1.0, 0.0} : glm::dvec3{0.0, 0.0, 1.0};
}

[[nodiscard]] inline constexpr double min_of(double a, double b) noexcept {
  return a < b ? a : b;
}
[[nodiscard]] inline constexpr double max_of(double a, double b) noexcept {
  return a > b ? a : b;
}
[[nodiscard]] inline double clamp_to(double v, double lo, double hi) noexcept {
  return v < lo ? lo : (v > hi ? hi : v);
}

}  // namespace gnomon
