// World-unit biases from the map's own texel footprint.
// Based on: the Jacobian of the map; Scherzer, Wimmer, Purgathofer, survey 2011, section 5 (bias terms).
#include "gnomon/bias.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "jacobian.hpp"
#include "vector.hpp"

namespace gnomon {

double ndc_depth_per_world_unit(const glm::dmat4& m, const glm::dvec3& light_direction,
                                const glm::dvec3& point) noexcept {
  const double w = m[0][3] * point.x + m[1][3] * point.y + m[2][3] * point.z + m[3][3];
  const double dz = m[0][2] * light_direction.x + m[1][2] * light_direction.y + m[2][2] * light_direction.z;
  return -dz / w;
}

glm::dvec2 texel_extent_world(const glm::dmat4& clip_from_world, int width, int height,
                              const glm::dvec3& light_direction, const glm::dvec3& point) noexcept {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const TexelJacobian b = texel_jacobian(clip_from_world, width, height, point);
  if (!(b.w > 0.0)) return {kInfinite, kInfinite};
  // Rows across the light; the inverse of the 2x2 map they span gives a texel's two edges.
  const glm::dvec3 x = b.x - light_direction * glm::dot(b.x, light_direction);
  const glm::dvec3 y = b.y - light_direction * glm::dot(b.y, light_direction);
  const double xx = glm::dot(x, x), yy = glm::dot(y, y);
  const glm::dvec3 across = glm::cross(x, y);
  const double area = std::sqrt(glm::dot(across, across));
  if (!(area > 0.0)) return {kInfinite, kInfinite};
  return {std::sqrt(yy) / area, std::sqrt(xx) / area};
}

double slope_bias_world(const BiasOptions& options, double texel_world, double kernel_radius_texels,
                        const glm::dvec3& normal, const glm::dvec3& light_direction) noexcept {
  const double cosine = -glm::dot(normal, light_direction);
  double slope = options.max_slope;
  if (cosine > 0.0) {
    const glm::dvec3 across = glm::cross(normal, light_direction);
    const double sine = std::sqrt(glm::dot(across, across));
    if (sine < cosine * options.max_slope) slope = sine / cosine;
  }
  return texel_world * (options.constant_texels + (options.slope_texels + kernel_radius_texels) * slope);
}

}  // namespace gnomon
