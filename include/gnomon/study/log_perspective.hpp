// Logarithmic perspective shadow maps, in numbers: the parametrization with the least error that is known,
// as a yardstick for those that hardware draws.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/measure.hpp"

namespace gnomon {

/// One map of a directional light round the receivers in view. Across the warp axis it is a perspective
/// shadow map, along it the logarithm of that map's w. Straight lines become curves, so that no rasterizer of
/// triangles draws it. Without a warp that gains (light along the view, orthographic camera) it is the
/// uniform map.
struct LogPerspectiveMap {
  bool valid = false;                          ///< false: broken input, or no receiver in view
  int size = 0;                                ///< texels along each side
  glm::dvec3 eye_world{0.0};                   ///< what lengths are counted from
  glm::dvec3 light_direction{0.0, -1.0, 0.0};  ///< unit, the way the light travels
  /// World directions across the light: where texels grow to, and across that. Unit.
  glm::dvec3 along{0.0}, across{0.0};
  double kappa = 0.0;   ///< of the perspective, 1 / world units: w = 1 + kappa u; 1 / near depth overhead
  double centre = 0.0;  ///< of the projection, across, world units
  double u_min = 0.0, length = 0.0;  ///< of the body along the axis, world units
  double x_min = 0.0, x_max = 0.0;   ///< of the body's image (distance across - centre) / w
};

/// The map with `size` texels along each side, kLeastMapSize..kMaxMapSize, and no border for filters.
[[nodiscard]] LogPerspectiveMap log_perspective_map(const Camera& camera, const DirectionalLight& light,
                                                    const SceneBounds& bounds, int size) noexcept;

/// Where a world point lands, in texels from the map's corner; in y, texels are even in ln w. Infinite
/// behind the projection's centre.
[[nodiscard]] glm::dvec2 log_perspective_texel(const LogPerspectiveMap& map,
                                               const glm::dvec3& point_world) noexcept;

/// d(texel) / d(world): gradients of both texel coordinates, per world unit. Zero behind the projection's
/// centre.
struct LogPerspectiveJacobian {
  glm::dvec3 x, y;  ///< texels per world unit
};
[[nodiscard]] LogPerspectiveJacobian log_perspective_jacobian(const LogPerspectiveMap& map,
                                                              const glm::dvec3& point_world) noexcept;

/// As measure_perspective() and measure() of measure.hpp, in the same terms and over the same grid.
[[nodiscard]] PointAliasing measure_perspective(const LogPerspectiveMap& map, const Camera& camera,
                                                const glm::dvec3& point_world) noexcept;
[[nodiscard]] AliasingStats measure(const LogPerspectiveMap& map, const Camera& camera,
                                    const SceneBounds& bounds, const MeasureOptions& grid = {}) noexcept;

}  // namespace gnomon
