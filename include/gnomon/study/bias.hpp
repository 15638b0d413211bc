// How far a depth comparison is moved off the surface, so that a surface does not shadow itself.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "gnomon/clip_space.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/options.hpp"

namespace gnomon {

/// Change of normalized device depth for a move of one world unit towards the light at `point_world`, where
/// the light travels along `light_direction` (unit). Exact for every matrix whose rays are the light's. Under
/// a warp it varies as 1 / w, and for a local light it is the derivative at the point. Negative
/// unless ClipSpace::reversed_z. (equation: constant bias in world units, (M_z . l) / w)
[[nodiscard]] double ndc_depth_per_world_unit(const glm::dmat4& clip_from_world,
                                              const glm::dvec3& light_direction,
                                              const glm::dvec3& point_world) noexcept;

/// Extent of one texel at `point_world`, in world units across the light, along the map's x and y. The
/// lengths of the columns of d(world across the light) / d(texel). Infinite where the map is singular or the
/// point behind it.
[[nodiscard]] glm::dvec2 texel_extent_world(const glm::dmat4& clip_from_world, const TexelGrid& texels,
                                            const glm::dvec3& light_direction,
                                            const glm::dvec3& point_world) noexcept;

/// The textbook slope bias, right where w is constant (no warp, directional light); elsewhere take
/// plane_bias_world. Move towards the light, in world units, that keeps a plane with `normal` (unit) from
/// shadowing itself. It holds under a texel of this extent and a kernel that reaches `kernel_radius_texels`
/// texels. It is constant + (slope + radius) tan(angle), the tangent capped. Facing away from the light
/// counts as the cap.
[[nodiscard]] double slope_bias_world(const BiasOptions& options, double texel_world,
                                      double kernel_radius_texels, const glm::dvec3& normal,
                                      const glm::dvec3& light_direction) noexcept;

// ---- For any map: warped, cascaded, spot ----
//
// tan(angle) times a texel is the change of depth per texel only where w is constant. A plane of the world is
// a plane of ndc, too, so its depth there is linear in ndc over the whole map, and in the texel where the
// shape is affine: all that follows is exact there, and first order at the point under another shape. *Add*
// an ndc change to a fragment's ndc depth: its sign moves the fragment towards the light in the clip space of
// `clip_from_world`.

/// A fragment on a surface, as one map sees it.
struct Receiver {
  glm::dmat4 clip_from_world{1.0};  ///< of the map, in any clip space
  TexelGrid texels;                 ///< of the map
  glm::dvec3 light_direction{0.0};  ///< unit, the way the light travels at the point
  glm::dvec3 point{0.0};            ///< world
  glm::dvec3 normal{0.0};           ///< unit, world, towards the side that is seen
};

/// How the depth of a receiving plane changes over the map.
struct ReceiverPlane {
  glm::dvec2 gradient{0.0};  ///< change of depth per unit along x and y; zero where not valid
  bool valid = false;  ///< false where the plane is seen edge-on: use plane_bias_ndc, whose slope is capped
};

/// From the plane itself, without screen derivatives: change of ndc depth per texel along the map's ndc x and
/// y. Equals -pi_x / pi_z, -pi_y / pi_z of pi = M^-T (N, -N.p), times a texel's extent in ndc, but needs no
/// inverse. Not valid within 1e-12 rad of edge-on and where the map is singular or the point behind it.
/// (Isidoro, "Shadow Mapping: GPU-based Tips and Techniques", GDC 2006, made analytic)
[[nodiscard]] ReceiverPlane receiver_plane(const Receiver& receiver) noexcept;

/// The form for shaders: from the derivatives of (u, v, depth) along the screen's x and y, in any unit of u
/// and v. The gradient is depth per that unit. Not valid where the determinant is below 1e-12 of the product
/// of the lengths of its rows (a silhouette, or an edge between two triangles). (Isidoro 2006)
[[nodiscard]] ReceiverPlane receiver_plane_from_derivatives(const glm::dvec3& d_dx,
                                                            const glm::dvec3& d_dy) noexcept;

/// Conservative slope-scaled bias. The ndc change moves the fragment in front of a plane through it. It does
/// so at every texel centre of its own texel and of `kernel_radius_texels` around it,
///   (slope_texels + radius) (|gradient.x| + |gradient.y|) + constant_texels * larger texel extent.
/// With slope_texels = 0.5 it is the least such bias. The plane's angle is capped at max_slope, also where it
/// faces away. In world units it is at most
///   (constant_texels + 2 (slope_texels + radius) (tan(angle) + kappa depth_range_world)) * larger texel
///   extent;
/// the second term of the sum is the warp's own slant, zero without one. 0 where the map is singular.
[[nodiscard]] double plane_bias_ndc(const BiasOptions& options, const Receiver& receiver,
                                    double kernel_radius_texels) noexcept;
/// The same in world units towards the light, to first order for a local light.
[[nodiscard]] double plane_bias_world(const BiasOptions& options, const Receiver& receiver,
                                      double kernel_radius_texels) noexcept;

/// Where to look the fragment up instead: an offset along its normal, world units, that lifts it off its
/// plane by plane_bias_ndc with slope_texels = normal_offset_texels. Without a warp that is
/// (normal_offset_texels + radius) texels times sin(angle), along each of the texel's sides. Exact for
/// directional lights where a warp changes little over the offset: it accounts for w where it leads. Thin
/// shadows move a little at concave edges. (Holbert, "Saying Goodbye to Shadow Acne", GDC 2011)
[[nodiscard]] glm::dvec3 normal_offset_world(const BiasOptions& options, const Receiver& receiver,
                                             double kernel_radius_texels) noexcept;

/// Largest tan(angle) that a plane's depth is followed with exactly. At half a texel's distance a normal that
/// is off by e moves the plane by e tan^2 / 2 texels. For e = 1e-5, a long triangle's in floats, that is 0.05
/// texel at this slope: a third of the default constant bias.
inline constexpr double kSteepestPlane = 100.0;

/// The bias that fits one fragment. It is the ndc change that takes it to where its plane meets the light ray
/// through the centre of the texel it falls into. It adds `epsilon_world` towards the light beyond that
/// (0.0001 of the scene's extent in the paper: what curvature and rounding need). May point away from the
/// light. Planes steeper than kSteepestPlane count as that steep; BiasOptions::max_slope has no effect. 0
/// where the map is singular. (Dou, Yan, Kerzner, Dai, Wyman, "Adaptive Depth Bias for Shadow Maps", I3D
/// 2014)
[[nodiscard]] double adaptive_bias_ndc(const Receiver& receiver, double epsilon_world) noexcept;

enum class DepthFormat : std::uint8_t { unorm16, unorm24, float32 };
/// Largest error of storing `depth`, in [0, 1] as the depth buffer holds it: half a step. Hardware that
/// rounds the comparison's reference to the format as well doubles it.
[[nodiscard]] double depth_rounding(DepthFormat format, double depth) noexcept;
/// The same as a move towards the light in world units at the receiver. Infinite where the map is singular.
[[nodiscard]] double depth_rounding_world(DepthFormat format, const ClipSpace& clip_space,
                                          const Receiver& receiver) noexcept;

// ---- Which bias goes with which filter ----

enum class BiasKind : std::uint8_t {
  constant,        ///< BiasOptions::constant_texels alone
  slope,           ///< plane_bias_ndc
  normal_offset,   ///< normal_offset_world
  receiver_plane,  ///< receiver_plane's gradient times the way to the centre of each texel compared
  adaptive,        ///< adaptive_bias_ndc
};
enum class FilterClass : std::uint8_t {
  single_compare,  ///< the one texel that the fragment falls into is compared
  wide_kernel,  ///< many texels are compared with the fragment, and the results averaged (percentage closer)
  blocker_search,  ///< depths of many texels are compared and then averaged (soft shadows by distance)
  prefiltered,  ///< texels are averaged before the comparison (variance, moments, exponential, convolution)
};
/// Whether this bias alone keeps every plane up to BiasOptions::max_slope from shadowing itself under such a
/// filter, given the kernel's radius, and why.
struct BiasAdvice {
  BiasKind bias;       ///< the bias in question
  FilterClass filter;  ///< the class of filter in question
  bool safe;  ///< normal_offset: where texels differ little over the kernel; the strongest warps need another
  std::string_view reason;  ///< one sentence
};
/// All pairs, by bias, then filter.
[[nodiscard]] std::span<const BiasAdvice> bias_advice() noexcept;
[[nodiscard]] const BiasAdvice& bias_with_filter(BiasKind bias, FilterClass filter) noexcept;

}  // namespace gnomon
