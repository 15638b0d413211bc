// The true shadow at every pixel of a frame: hard, through an ideal filter, and of a light with an extent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/trace/tracer.hpp"

namespace gnomon::trace {

/// State of a pixel before any ray goes to the light.
enum class PixelState : std::uint8_t {
  sky,          ///< no surface
  turned_away,  ///< the side that is seen faces away from the light: dark without any map
  unlit,        ///< beyond the range or outside of the cone of the light
  undecided,    ///< no certain result: no triangle where the picture has one, or light that only grazes it
  facing,       ///< a ray decides
};

/// The surface at a pixel: the world point of the look-up, and the triangle it lies on.
struct SurfacePoint {
  PixelState state = PixelState::sky;    ///< known before any ray goes to the light
  std::uint32_t triangle = kNoTriangle;  ///< index within the tracer
  glm::dvec3 position{0.0};              ///< world
  glm::dvec3 normal{0.0};                ///< of the triangle, unit, turned to the viewer
  bool receives = true;                  ///< false: lit where it faces the light, whatever stands before that
  double above = 0.0;  ///< height of `position` over the triangle's plane along `normal`: rounding
};

/// Rows top to bottom, as in FloatImage.
struct SurfacePoints {
  int width = 0, height = 0;         ///< pixels
  std::vector<SurfacePoint> pixels;  ///< width x height
};

/// The ray from the eye through a place in the picture: shares of its width from the left, of its height from
/// the top. It runs from the near depth to the far one. Its t is the view depth.
[[nodiscard]] Ray eye_ray(const Camera& camera, const CameraAxes& axes, double column_share,
                          double row_share) noexcept;
/// Finds the triangle behind each pixel by a ray from the eye. `positions` and `normals` are those of
/// render::Renderer of the same names: relative to camera.position, and "surface" in the fourth channel.
[[nodiscard]] SurfacePoints surface_points(const Tracer& tracer, const Camera& camera, const Light& light,
                                           const FloatImage& positions, const FloatImage& normals);

/// Result of one ray to the light's centre.
enum class Verdict : std::uint8_t {
  none,       ///< nothing to evaluate: sky, turned away, unlit
  undecided,  ///< the point is undecided, or the result changes within Tracer::error_world across the ray: an
              ///< edge is too close
  shadow,
  lit,
};
/// The exact hard shadow of each pixel.
struct HardReference {
  int width = 0, height = 0;    ///< pixels
  std::vector<Verdict> pixels;  ///< width x height, rows top to bottom
};
/// One ray per pixel decides. Four more around it, at the engine's error, check that the result is certain.
[[nodiscard]] HardReference hard_reference(const Tracer& tracer, const SurfacePoints& points,
                                           const Light& light);

/// Visibility 1 lit .. 0 in shadow; -1 where there is nothing to evaluate or the point is undecided.
struct SoftReference {
  int width = 0, height = 0;  ///< pixels
  std::vector<float> pixels;  ///< width x height, rows top to bottom
};

/// How a filter's kernel weighs the plane across the light, in the unit of its axes.
enum class KernelShape : std::uint8_t {
  box,    ///< evenly over [-1,1] x [-1,1]
  disc,   ///< evenly over the unit disc
  gauss,  ///< standard deviation 1, cut at 3
};
/// Where a kernel lies at a point: world vectors across the light. Both zero: a single point.
struct KernelAxes {
  glm::dvec3 x{0.0}, y{0.0};  ///< world units
};
/// The texel's sides across the light at a point, in world units, times `radius_texels`: the axes of a kernel
/// of that radius in the map. Zero where the map is singular.
[[nodiscard]] KernelAxes texel_axes(const ShadowMap& map, const glm::dvec3& point,
                                    double radius_texels) noexcept;
/// The box in the map that has the variance of a pixel: its half sides, texels. `facet`: the pixel's half
/// sides on the surface (facet_axes). FilterLookup::pixel, without a bound.
[[nodiscard]] glm::dvec2 pixel_in_texels(const ShadowMap& map, const glm::dvec3& point,
                                         const KernelAxes& facet) noexcept;
/// Two axes of this length across the light at a point, world units.
[[nodiscard]] KernelAxes world_axes(const Light& light, const glm::dvec3& point, double radius) noexcept;

/// Half a pixel's sides on the plane of its surface, world units. They are the axes of the box that an image
/// without staircases averages the light over. Facets that are seen from their edge end at twice their
/// distance; both zero where there is no surface. Based on: Pan et al., "Fast, Sub-pixel Antialiased Shadow
/// Maps", 2009.
[[nodiscard]] KernelAxes facet_axes(const Camera& camera, const SurfacePoint& point) noexcept;

/// Samples per pixel of the soft references: stratified, jittered by a hash of pixel and sample, the same in
/// every run. 16 are good to about 0.03 at the middle of a straight edge's penumbra.
inline constexpr int kSoftSamples = 16;

/// Result of an ideal filter: the share of the kernel's weight, in the receiver's plane, from which the
/// light's centre is visible. `axes` is called for facing pixels, from several threads.
[[nodiscard]] SoftReference filtered_reference(const Tracer& tracer, const SurfacePoints& points,
                                               const Light& light, KernelShape shape,
                                               const std::function<KernelAxes(std::size_t pixel)>& axes,
                                               int samples = kSoftSamples);

/// The visible part of an area light: a disc that faces the point. `radius` is world units for a local light,
/// the tangent of the angular radius for a directional one (the sun's is 0.00465).
[[nodiscard]] SoftReference area_reference(const Tracer& tracer, const SurfacePoints& points,
                                           const Light& light, double radius, int samples = kSoftSamples);

/// The light on the surfaces that a pixel shows, over the whole pixel.
struct PixelReference {
  int width = 0, height = 0;  ///< pixels
  /// Share of the light, 1 lit .. 0 in shadow; -1 where the pixel's centre shows no surface that faces the
  /// light. Width x height, rows top to bottom.
  std::vector<float> pixels;
  /// 1 where the samples meet more than the surface at the centre: an edge, a fold, or the sky.
  std::vector<std::uint8_t> several;
};
/// `samples` rays from the eye through each pixel, and one to the light from each surface that they meet.
/// The samples are stratified, the same in every run. Surfaces have no part in the share where no map
/// decides: they face away from the light, lie beyond it or are grazed by it. Pixels of several surfaces have
/// the mean of all that the light can reach. `points` are those of surface_points through `camera`.
[[nodiscard]] PixelReference pixel_reference(const Tracer& tracer, const Camera& camera,
                                             const SurfacePoints& points, const Light& light,
                                             int samples = kSoftSamples);

}  // namespace gnomon::trace
