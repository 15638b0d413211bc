// How far a depth comparison is moved off the surface, so that a surface does not shadow itself.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gnomon {

/// In texels of the map at the point that is shaded, so that one setting serves every cascade and every warp.
/// A texel's extent there is world units from the map's own Jacobian; under a warp it grows with w along x
/// and w^2 along y.
struct BiasOptions {
  /// Along the light, in texels, everywhere. Covers depth rounding.
  double constant_texels = 0.05;
  /// Along the light, in texels times tan(angle between normal and light). 0.5 covers a texel sampled at its
  /// centre.
  double slope_texels = 0.5;
  /// Along the surface normal, in texels times sin(angle between normal and light). Moves thin shadows a
  /// little.
  double normal_offset_texels = 0.5;
  /// Cap of tan(angle): at grazing light the slope term would move shadows off their casters.
  double max_slope = 8.0;
};

/// The same in world units at the centre of the map's body, for one map.
struct BiasWorld {
  double constant = 0.0;       ///< along the light
  double slope = 0.0;          ///< along the light, per unit of tan(angle)
  double normal_offset = 0.0;  ///< along the normal, per unit of sin(angle)
};

/// Change of normalized device depth for a move of one world unit towards the light at `point_world`. Exact
/// for every matrix whose rays are the light's; under a warp it varies as 1 / w.
[[nodiscard]] double ndc_depth_per_world_unit(const glm::dmat4& clip_from_world,
                                              const glm::dvec3& light_direction,
                                              const glm::dvec3& point_world) noexcept;

/// Extent of one texel at `point_world`, in world units across the light, along the map's x and y: the
/// lengths of the columns of d(world across the light) / d(texel). Infinite where the map is singular or the
/// point behind it.
[[nodiscard]] glm::dvec2 texel_extent_world(const glm::dmat4& clip_from_world, int width, int height,
                                            const glm::dvec3& light_direction,
                                            const glm::dvec3& point_world) noexcept;

/// Move towards the light, in world units, that keeps a plane with `normal` (unit) from shadowing itself
/// under a texel of this extent and a kernel that reaches `kernel_radius_texels` texels: constant + (slope +
/// radius) tan(angle), the tangent capped. Facing away from the light counts as the cap.
[[nodiscard]] double slope_bias_world(const BiasOptions& options, double texel_world,
                                      double kernel_radius_texels, const glm::dvec3& normal,
                                      const glm::dvec3& light_direction) noexcept;

}  // namespace gnomon
