// How good a shadow map is, in numbers: Lloyd's aliasing error m at a point, and over what the camera sees.
#pragma once

#include <cstdint>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/view.hpp"

namespace gnomon {

/// The aliasing error at one point of a surface. m counts screen pixels per shadow-map texel: above 1 the map
/// is undersampled there. J is d(texel) / d(pixel) on the surface.
struct PointAliasing {
  /// Whether the other members hold a value.
  enum class Status : std::uint8_t {
    ok,            ///< the error is known
    outside,       ///< the map does not hold the point (clip w <= 0 or |ndc| > 1): m is infinite
    faces_away,    ///< the surface is turned from the light or from the eye: nothing to sample
    undetermined,  ///< edge-on to both the light and the eye: no value
  } status = Status::undetermined;  ///< decides which members hold a value
  double m_max = 0.0;               ///< longest extent of a texel in pixels, 1 / smallest singular value of J
  double m_min = 0.0;               ///< shortest extent
  double m_s = 0.0;                 ///< extent along the map's x
  double m_t = 0.0;                 ///< extent along the map's y
  double m_area = 0.0;              ///< square root of a texel's area in pixels
  double anisotropy = 1.0;          ///< m_max / m_min
  /// The perspective part: the same on a surface that faces the half vector of eye and light, which only the
  /// parametrization decides.
  double perspective_max = 0.0, perspective_s = 0.0, perspective_t = 0.0;
  /// The projection part, cos(normal, eye) / cos(normal, light), which only the surface decides:
  /// m_area^2 = perspective_area^2 * projection.
  double projection = 1.0;
};

/// Aliasing at `point_world` on a surface with `normal` (unit) seen by `camera` through `map`. Works for
/// every projective map. The light ray comes from the matrix: `map.light_world` is read only where it is the
/// light of that matrix. Hand-made maps may leave it out. Their depth then grows away from the light.
/// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, in the form of a
/// Jacobian.
[[nodiscard]] PointAliasing measure_point(const ShadowMap& map, const Camera& camera,
                                          const glm::dvec3& point_world, const glm::dvec3& normal) noexcept;

/// The same without a surface: only the perspective part is filled in (normal = half vector).
[[nodiscard]] PointAliasing measure_perspective(const ShadowMap& map, const Camera& camera,
                                                const glm::dvec3& point_world) noexcept;

/// The same at many points: out[i] equals the result for points[i] bit by bit, in less than half the time.
/// The shortest span decides how many.
void measure_points(const ShadowMap& map, const Camera& camera, std::span<const glm::dvec3> points_world,
                    std::span<const glm::dvec3> normals, std::span<PointAliasing> out) noexcept;
void measure_perspectives(const ShadowMap& map, const Camera& camera,
                          std::span<const glm::dvec3> points_world, std::span<PointAliasing> out) noexcept;

/// The error over many points.
struct AliasingStats {
  double p50 = 0.0, p95 = 0.0, max = 0.0;  ///< of m_max
  /// Mean of m_max. Errors at shadow edges grow with it: it orders techniques by their misclassified pixels
  /// better than any percentile does.
  double mean = 0.0;
  double share_undersampled = 0.0;  ///< of the points with m_max > 1, in [0,1]
  /// Texels per screen pixel that would bring m_s and m_t to 1 everywhere: the sum over the maps of
  /// max m_s * max m_t * texels / pixels.
  double storage = 0.0;
  std::uint64_t samples = 0;  ///< points that counted
  std::uint64_t outside = 0;  ///< points of visible receivers that no map of the plan holds
};

/// How measure() samples.
struct MeasureOptions {
  /// Pixels across and down, and depths along each pixel's ray; each at least 1. Not read where the view has
  /// points.
  int columns = 64, rows = 64, depths = 64;
  int map = -1;  ///< index of the one map whose points count; -1: all
};

/// Perspective error over what the view sees. Allocates nothing: percentiles come from a histogram of log m
/// with bins of 0.1 %. Plans without maps give zeros.
///
/// With View::points_world: at these points. Else over the visible part of the receivers. Samples are a grid
/// of pixels, with depths along each pixel's ray evenly spaced in their logarithm from near to far plane.
/// Those in a receiver box count, which is wherever boxes have room. A thin or flat box may have none on a
/// ray that meets it: the nearest of those counts where the ray enters it. Without a single point (`samples`
/// is 0) all numbers are 0.
[[nodiscard]] AliasingStats measure(const ShadowPlan& plan, const View& view, const SceneBounds& bounds,
                                    const MeasureOptions& options = {}) noexcept;

}  // namespace gnomon
