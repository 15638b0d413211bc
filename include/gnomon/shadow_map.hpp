// What does drawing, reading, culling and measuring one shadow map need? Plain data, one record per map.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/options.hpp"

namespace gnomon {

/// Back faces and silhouette planes of a 12-faced body: at most 12 faces plus a silhouette of at most 20
/// edges.
inline constexpr int kMaxCullPlanes = 32;

/// Planes round a map's share of the receivers where not depth divides them: a face of the camera's frustum
/// has four edges.
inline constexpr int kMaxSelectPlanes = 4;

/// Whole-texel coordinates of a stable map's centre in light space, and its depth range in whole depth steps.
/// Two maps of the same light, slice and size with equal keys have the same texel grid and depths. Their
/// clip_from_world are equal to the last bit.
struct SnapKey {
  std::int64_t x = 0, y = 0;                   ///< texels
  std::int64_t depth_near = 0, depth_far = 0;  ///< depth steps
  glm::dvec2 texel{0.0};                       ///< sides of the grid's rectangles, world units
  bool valid = false;                          ///< true for Fit::stable, and levels of pages
  /// The same grid: both are valid, and equal in all members. Maps without a grid have none in common.
  friend bool operator==(const SnapKey& a, const SnapKey& b) noexcept {
    return a.valid && b.valid && a.x == b.x && a.y == b.y && a.depth_near == b.depth_near &&
           a.depth_far == b.depth_far && a.texel == b.texel;
  }
};

/// BiasOptions in world units at the centre of the map's body, for one map.
struct BiasWorld {
  double constant = 0.0;       ///< along the light
  double slope = 0.0;          ///< along the light, per unit of tan(angle)
  double normal_offset = 0.0;  ///< along the normal, per unit of sin(angle)
};

/// Texels [x, x + width) times [y, y + height) of a map, counted as its memory is: columns from ndc x = -1,
/// rows from ClipSpace::first_row. The rectangle for glScissor, vkCmdSetScissor, RSSetScissorRects or
/// setScissorRect.
struct TexelRect {
  int x = 0, y = 0, width = 0, height = 0;  ///< texels
  /// True where it holds no texel.
  [[nodiscard]] bool empty() const noexcept { return width <= 0 || height <= 0; }
  /// Equal in all members.
  bool operator==(const TexelRect&) const = default;
};

struct TexelGrid;

/// One shadow map: everything that drawing, reading, culling and measuring it needs.
struct ShadowMap {
  /// Clip space of the map from world space, in double, and from points relative to the camera position, in
  /// float. Shaders take the second: it keeps its precision a thousand kilometres from the origin.
  glm::dmat4 clip_from_world{1.0};
  glm::mat4 clip_from_camera_relative{1.0f};  ///< for points relative to ShadowPlan::origin_world
  double depth_begin = 0.0, depth_end = 0.0;  ///< view depths served, world units
  /// Width of the blend band before depth_begin that this map also covers, with all casters
  /// (SplitOptions::overlap), world units of view depth. 0 where no other map ends at depth_begin.
  double overlap = 0.0;
  /// The light in homogeneous world coordinates: its position with w = 1, or the unit direction towards it
  /// with w = 0.
  glm::dvec4 light_world{0.0, 1.0, 0.0, 0.0};
  /// Index of the requested cascade. Local lights have none. It is 0 for a spot's single map. The faces of a
  /// cube have 0 to 5 in the order +x -x +y -y +z -z. The axes are the world's for a point light; a wide
  /// spot's face 5 looks along it. Partition::tetrahedron: 0 looks along -y, 1 to 3 the other ways.
  /// Partition::frustum_faces: the face, in the order left, right, bottom, top, near, far. With
  /// SplitOptions::face_slices above 1 counted through all slices, by face in that order, the nearest first.
  /// separating_plane: 0 before the plane, 1 behind. receiver_clusters: the cluster, in the order of their
  /// division.
  int cascade = 0;
  int width = 0, height = 0;  ///< texels; may differ, and from map to map (metric_resolution, texel_budget)
  const Shape* shape = &shapes::linear;  ///< how the texels lie on the projected square; never nullptr
  ShapeParameters shape_parameters{};    ///< of `shape`
  const Warp* warp = nullptr;            ///< never nullptr in a plan's maps; the one that was used
  /// Strength of the warp, 1 / world units; 0: none. Local lights: 1 / slope, as the warp works on offsets
  /// across the light per unit of distance along it.
  double kappa = 0.0;
  glm::dvec2 texel_world{0.0};      ///< extent of a texel across the light at the body's centre, world units
  glm::dvec2 texel_world_max{0.0};  ///< the same where it is largest on the body
  double depth_range_world = 0.0;   ///< distance along the light from the map's near to its far plane
  int filter_margin_texels = 0;     ///< texels along each side that no receiver falls into
  BiasWorld bias_world;             ///< bias at the body's centre, world units
  /// Planes round everything that can shadow a receiver of this map. A caster is needed only if a part of it
  /// lies where dot(xyz, p_world) + w >= 0 of all of them. World space, unit normals.
  std::array<glm::dvec4, kMaxCullPlanes> cull_planes;
  int cull_plane_count = 0;  ///< entries of cull_planes that are used
  /// Planes that part this map's receivers from the other maps': the map serves a point only where
  /// dot(xyz, p_world) + w >= 0 for all of them. World space, unit normals; none where depth or their own
  /// extent separates the maps. Parallel to the light, but for those of WarpOptions::planes and of cascades
  /// beside them.
  std::array<glm::dvec4, kMaxSelectPlanes> select_planes{};
  int select_plane_count = 0;  ///< entries of select_planes that are used
  SnapKey snap_key;            ///< of Fit::stable: equal keys mean an identical grid
  /// Perspective part of m along the map's x and y, largest over the body. The weights are the simplified
  /// ones of Lloyd et al. 2006, which ignore that pixels beside the view axis are smaller.
  double m_s_max = 0.0, m_t_max = 0.0;
  /// Bound of the perspective part of m in any direction, over the body.
  double m_max = 0.0;
  double storage = 0.0;  ///< texels per screen pixel for m <= 1 everywhere in this slice (vertex objective)

  /// The texels and how they lie, for look-ups. To call it, include extend/shape.hpp, which has the type.
  [[nodiscard]] TexelGrid texels() const noexcept;
};

/// Writes the indices of the casters that `map` needs to `out`. Returns how many there are: all of them are
/// counted, those beyond out.size() are not written. Conservative: a caster that can shadow a receiver
/// of the map is always among them.
std::size_t cull_casters(const ShadowMap& map, std::span<const Box> casters,
                         std::span<std::uint32_t> out) noexcept;

}  // namespace gnomon
