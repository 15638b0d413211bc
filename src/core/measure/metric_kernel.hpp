// The arithmetic of the aliasing error, shared by the single-point functions and the sampled ones.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/measure.hpp"

namespace gnomon {

/// A point as the camera sees it: unit ray from the eye, and d(world)/d(pixel) across and down.
struct ViewPoint {
  glm::dvec3 ray, pixel_x, pixel_y;
};

[[nodiscard]] inline ViewPoint view_point(const Camera& camera, const CameraAxes& axes,
                                          const glm::dvec3& point) noexcept {
  const double px = (camera.right - camera.left) / camera.width;
  const double py = (camera.top - camera.bottom) / camera.height;
  if (camera.orthographic) return {axes.forward, axes.right * px, axes.up * py};
  const glm::dvec3 offset = point - camera.position;
  const double depth = glm::dot(offset, axes.forward);
  return {safe_normalize(offset, axes.forward), axes.right * (px * depth), axes.up * (py * depth)};
}

/// A 2x2 matrix d(texel)/d(pixel), row by row.
struct Jacobian2 {
  double xx, xy, yx, yy;
};

/// Squared length of the sum of two unit rays below which they oppose each other: rounding decides the rest.
inline constexpr double kOpposedRays = 1e-24;

/// On the surface that faces the half vector: the pixel's extent across the eye ray, mirrored into the plane
/// across the light ray. The mirror stays defined where both rays oppose each other; there any axis across
/// them serves.
[[nodiscard]] inline Jacobian2 perspective_jacobian(const TexelJacobian& b, const ViewPoint& view,
                                                    const glm::dvec3& light) noexcept {
  const glm::dvec3 sum = view.ray + light;
  const double sum2 = glm::dot(sum, sum);
  const glm::dvec3 mirror =
      sum2 > kOpposedRays
          ? sum
          : safe_normalize(glm::cross(view.ray, least_aligned_axis(view.ray)), {1.0, 0.0, 0.0});
  const double twice = 2.0 / (sum2 > kOpposedRays ? sum2 : 1.0);
  const auto turned = [&](const glm::dvec3& pixel) {
    const glm::dvec3 across = pixel - view.ray * glm::dot(view.ray, pixel);
    return across - mirror * (twice * glm::dot(mirror, across));
  };
  const glm::dvec3 px = turned(view.pixel_x), py = turned(view.pixel_y);
  return {glm::dot(b.x, px), glm::dot(b.x, py), glm::dot(b.y, px), glm::dot(b.y, py)};
}

/// Extents of a texel in pixels: columns and singular values of the inverse of d(texel)/d(pixel).
struct Extents {
  double longest, shortest, s, t;
};

[[nodiscard]] inline Extents extents(const Jacobian2& j) noexcept {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const double determinant = std::abs(j.xx * j.yy - j.xy * j.yx);
  const double half = 0.5 * (j.xx * j.xx + j.xy * j.xy + j.yx * j.yx + j.yy * j.yy);
  const double spread = (half - determinant) * (half + determinant);
  // `spread`, and 0 where rounding puts it below: compilers take the root of what they choose from, too.
  const double known = 0.5 * spread + 0.5 * std::abs(spread);
  const double largest = std::sqrt(half + std::sqrt(known));
  // Vector units take no branches and divide by zero where the quotient is thrown away, too. This changes no
  // bit of what is above 1e-133.
  constexpr double kLeast = 1e-150;
  const double inverse = 1.0 / (determinant + kLeast);
  const auto over_determinant = [&](double v) { return determinant > 0.0 ? v * inverse : kInfinite; };
  const double longest = over_determinant(largest);
  const double shortest = largest > 0.0 ? 1.0 / (largest + kLeast) : kInfinite;
  // Rounding would make the shortest extent of a square texel the longer.
  return {longest, min_of(shortest, longest), over_determinant(std::sqrt(j.yy * j.yy + j.yx * j.yx)),
          over_determinant(std::sqrt(j.xx * j.xx + j.xy * j.xy))};
}

/// The perspective part of the error, from the map's derivatives at the point.
[[nodiscard]] inline PointAliasing perspective_aliasing(const TexelJacobian& b, const ViewPoint& view,
                                                        const glm::dvec3& light) noexcept {
  const Extents e = extents(perspective_jacobian(b, view, light));
  PointAliasing result;
  result.status = PointAliasing::Status::ok;
  result.m_max = result.perspective_max = e.longest;
  result.m_s = result.perspective_s = e.s;
  result.m_t = result.perspective_t = e.t;
  result.m_min = e.shortest;
  result.m_area = std::sqrt(e.longest * e.shortest);
  if (e.shortest < std::numeric_limits<double>::infinity()) result.anisotropy = e.longest / e.shortest;
  return result;
}

/// Of a point that no map holds: infinite.
[[nodiscard]] inline PointAliasing outside_map() noexcept {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  PointAliasing result;
  result.status = PointAliasing::Status::outside;
  result.m_max = result.m_min = result.m_s = result.m_t = result.m_area = kInfinite;
  result.perspective_max = result.perspective_s = result.perspective_t = kInfinite;
  return result;
}

}  // namespace gnomon
