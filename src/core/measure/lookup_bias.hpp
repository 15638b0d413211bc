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

/// Along the light, world units: constant and slope, and what the offset along the normal lifts the point
/// over its plane. `texel`: of the map at the point. `normal`: unit, towards the side that is seen.
/// `light_direction`: unit, the way the light travels. 0 where the surface is edge-on or faces away from
/// the light, and where the map is singular. Unlike plane_bias_world, it has nothing of a warp's own slant.
[[nodiscard]] inline double lookup_bias_world(const BiasOptions& options, const TexelJacobian& texel,
                                              const glm::dvec3& normal,
                                              const glm::dvec3& light_direction) noexcept {
  constexpr double kEdgeOn = 1e-6;
  // Sides of a texel across the light, times its area.
  const glm::dvec3 side_x = glm::cross(texel.y, light_direction),
                   side_y = glm::cross(light_direction, texel.x);
  const double area = std::abs(glm::dot(texel.x, side_x)), cosine = -glm::dot(normal, light_direction);
  if (!(area > 0.0) || !(cosine > kEdgeOn)) return 0.0;
  // How the plane rises towards the light, over ways across it.
  const glm::dvec3 slope = normal / cosine + light_direction;
  const double tangent = std::sqrt(glm::dot(slope, slope));
  const double most = min_of(options.max_slope, kSteepestPlane);
  const double rise = (std::abs(glm::dot(slope, side_x)) + std::abs(glm::dot(slope, side_y))) / area *
                      (tangent > most ? most / tangent : 1.0);
  const double side = std::sqrt(max_of(glm::dot(side_x, side_x), glm::dot(side_y, side_y))) / area;
  return options.slope_texels * rise +
         side * (options.constant_texels + options.normal_offset_texels * tangent);
}

}  // namespace gnomon
