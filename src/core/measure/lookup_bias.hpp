// How far does a look-up move a point off its surface? The bias of shaders/library/receiver.glsl at a point.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "gnomon/options.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon {

/// The sides of a texel, world units across the light.
struct TexelSides {
  glm::dvec3 x{0.0}, y{0.0};  ///< ways by one texel along the map's x and y
  double longer = 0.0;        ///< length; 0 where the map is singular
};

[[nodiscard]] inline TexelSides texel_sides(const TexelJacobian& texel,
                                            const glm::dvec3& light_direction) noexcept {
  const glm::dvec3 x = glm::cross(texel.y, light_direction), y = glm::cross(light_direction, texel.x);
  const double area = glm::dot(texel.x, x);
  if (!(std::abs(area) > 0.0)) return {};
  return {x / area, y / area, std::sqrt(max_of(glm::dot(x, x), glm::dot(y, y))) / std::abs(area)};
}

/// Along the light, world units: constant and slope, and what the offset along the normal lifts the point
/// over its plane. `texel`: of the map at the point. `normal`: unit, towards the side that is seen.
/// `light_direction`: unit, the way the light travels. 0 where the surface is edge-on or faces away from
/// the light, and where the map is singular. Unlike plane_bias_world, it has nothing of a warp's own slant.
[[nodiscard]] inline double lookup_bias_world(const BiasOptions& options, const TexelJacobian& texel,
                                              const glm::dvec3& normal,
                                              const glm::dvec3& light_direction) noexcept {
  constexpr double kEdgeOn = 1e-6;
  const TexelSides side = texel_sides(texel, light_direction);
  const double cosine = -glm::dot(normal, light_direction);
  if (!(side.longer > 0.0) || !(cosine > kEdgeOn)) return 0.0;
  // How the plane rises towards the light, over ways across it.
  const glm::dvec3 slope = normal / cosine + light_direction;
  const double tangent = std::sqrt(glm::dot(slope, slope));
  const double most = min_of(options.max_slope, kSteepestPlane);
  const double rise = (std::abs(glm::dot(slope, side.x)) + std::abs(glm::dot(slope, side.y))) *
                      (tangent > most ? most / tangent : 1.0);
  return options.slope_texels * rise +
         side.longer * (options.constant_texels + options.normal_offset_texels * tangent);
}

}  // namespace gnomon
