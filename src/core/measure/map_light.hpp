// Whose light does a map's matrix belong to? Maps of others may say nothing of it.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/shadow_map.hpp"

namespace gnomon {

/// Whether the matrix sends the light to no place of its image: x, y and w of a parallel light's direction,
/// or of a local light's position, are zero but for rounding.
[[nodiscard]] inline bool is_light_of(const glm::dmat4& clip_from_world, const glm::dvec4& light) noexcept {
  // Far above the rounding of a matrix, far below an angle that changes a cosine.
  constexpr double kRounding = 1e-7;
  const double length = glm::length(glm::dvec3(light));
  double across = 0.0;  // of what the matrix makes of a step, which rounding of w is to be compared with
  for (const int row : {0, 1, 3}) {
    const glm::dvec4 r = row_of(clip_from_world, row);
    across = max_of(across, glm::length(glm::dvec3(r)));
    if (!(std::abs(glm::dot(r, light)) <= kRounding * (across * length + std::abs(r.w * light.w))))
      return false;
  }
  return length > 0.0 || light.w != 0.0;
}

/// 1 where cross(gradient of the map's x, of its y) is the way that the light travels, -1 where it is the way
/// back.
[[nodiscard]] inline double light_sense(const ShadowMap& map) noexcept {
  return glm::determinant(map.clip_from_world) *
                     glm::determinant(map.texels().place(glm::dvec2(0.0)).texel_from_ndc) <
                 0.0
             ? -1.0
             : 1.0;
}

/// ShadowMap::light_world, or what the matrix says where that is not its light: the one point, or direction,
/// that has no place in the map. All points of a ray from there have one place.
[[nodiscard]] inline glm::dvec4 light_of(const ShadowMap& map) noexcept {
  const glm::dmat4& m = map.clip_from_world;
  if (is_light_of(m, map.light_world)) return map.light_world;
  const glm::dvec4 x = row_of(m, 0), y = row_of(m, 1), w = row_of(m, 3);
  const glm::dvec3 x3(x), y3(y), w3(w);
  // The light travels along sense * (apart + spread * point).
  const glm::dvec3 apart = w.w * glm::cross(x3, y3) - y.w * glm::cross(x3, w3) + x.w * glm::cross(y3, w3);
  const double spread = glm::dot(glm::cross(x3, y3), w3), sense = light_sense(map);
  // Far above what rounding to single precision makes of a warp under a parallel light, which may have either
  // sign; far below what a local light has.
  constexpr double kParallel = 1e-5;
  const bool parallel = std::abs(spread) <= kParallel * glm::length(x3) * glm::length(y3) * glm::length(w3);
  const glm::dvec4 light = parallel ? glm::dvec4(-sense * safe_normalize(apart, glm::dvec3(0.0)), 0.0)
                                    : glm::dvec4(apart / -spread, 1.0);
  const bool known = parallel ? glm::dot(light, light) > 0.0 : sense * spread > 0.0;
  return known && std::isfinite(glm::dot(light, light)) ? light : map.light_world;
}

}  // namespace gnomon
