// How wide must a filter be to hide its map's texels, and how small may a map be under a filter?
// Based on: a viewers' study of the filter sizes that hide shadow-map artifacts (radius 3.47 times their
// size).
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// Filter radius over the size of the artifacts that it hides from a viewer. It is the study's result, for
/// its worst case: a shadow edge in steps at full contrast. It looked at 5 to 30 pixels; beyond, the straight
/// line is carried on.
inline constexpr double kHidingRadius = 3.47;

/// Radius in pixels of a kernel that hides texels `texel_pixels` long (PointAliasing::m_max). Any number;
/// negative ones and not-a-number count as 0, which takes no kernel.
[[nodiscard]] double hiding_radius_pixels(double texel_pixels) noexcept;
/// The inverse: length in pixels of the largest texels that a kernel of this radius hides. Any number;
/// negative ones and not-a-number count as 0, which hides nothing.
[[nodiscard]] double hidden_texel_pixels(double radius_pixels) noexcept;

/// Distances that decide the kernel of a penumbra. Other filters ignore them.
struct ShadowDistances {
  double blocker_world = 0.0;  ///< from the receiver to what shadows it, world units, >= 0
  double light_world = 0.0;    ///< from the receiver to the light, world units; 0: parallel light
};

/// True where the kernel keeps its size in the world when the map's texels change: given in world units, or
/// as wide as a penumbra. Kernels in texels shrink with their texels, and no map size makes them hide more.
[[nodiscard]] bool is_kernel_in_world(const FilterSettings& settings) noexcept;
/// Radius of such a kernel across the light at the receiver, world units; 0 for all others, and for penumbras
/// at a contact. Distances that are negative or not a number count as 0.
[[nodiscard]] double kernel_radius_world(const FilterSettings& settings,
                                         const ShadowDistances& distances) noexcept;

/// The result of hiding_map_size.
struct HidingMapSize {
  int map_size = kMaxMapSize;  ///< ResolutionOptions::max_size, texels along a side
  bool hides = false;          ///< false: not even the largest map does, and map_size is that
  double radius_world = 0.0;   ///< of the kernel, world units; 0: it has no size in the world
  /// The same in pixels where it is largest on the screen. That is at the least view depth of any map, on a
  /// surface that faces camera and light. Compare it with the study's range.
  double radius_pixels = 0.0;
};

/// The smallest maps whose texels the filter hides everywhere. Kernel and texel are seen on the same surface
/// from the same place. So the longest side of any texel (ShadowMap::texel_world_max) must be at most the
/// kernel's radius over 3.47, both across the light.
///
/// Texels are assumed to shrink as maps grow. Borders and warps make that inexact by a few texels: repeat the
/// query with a plan of that size until the result is no larger.
///
/// Kernels in texels: every map size, so the smallest, where radius + 1/2 texels are 3.47 or more; none
/// below. Penumbras: those of `distances`, no wider than FilterSettings::radius; nearer blockers have
/// narrower kernels, whose texels may show. A contact, a filter without kernel (hard) and none at all hide
/// nothing. Plans without maps have nothing to hide.
[[nodiscard]] HidingMapSize hiding_map_size(const ShadowPlan& plan, const Camera& camera,
                                            const FilterSettings& settings,
                                            const ShadowDistances& distances = {}) noexcept;
/// The same evaluated at visible points alone (trace::seen_points). A texel is hidden where it is at most a
/// pixel long on the screen. Elsewhere it is hidden where the kernel's radius there is 3.47 times as long.
/// Texels that no pixel sees, or sees from far away, take no larger map. Points that no map serves are
/// skipped; without any other, the smallest map.
[[nodiscard]] HidingMapSize hiding_map_size(const ShadowPlan& plan, const Camera& camera,
                                            const FilterSettings& settings, const ShadowDistances& distances,
                                            std::span<const glm::dvec3> visible_world) noexcept;

}  // namespace gnomon::render
