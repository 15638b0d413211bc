// Which shadow maps are worth drawing for this camera, light and scene? Plain data, one record per map.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string_view>
#include <type_traits>

#include "gnomon/body.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/clip_space.hpp"
#include "gnomon/light.hpp"
#include "gnomon/plan_options.hpp"
#include "gnomon/shape.hpp"
#include "gnomon/snap.hpp"
#include "gnomon/visible_depths.hpp"

namespace gnomon {

inline constexpr int kMaxOmissions =
    32;  ///< entries of ShadowPlan::omitted; later ones are counted, not listed

/// Planes round a map's share of the receivers where not depth divides them: a face of the camera's frustum
/// has four edges.
inline constexpr int kMaxSelectPlanes = 4;

enum class PlanStatus : std::uint8_t {
  ok,               ///< there are maps to draw
  nothing_visible,  ///< no receiver in view: no map, everything in view is lit
  no_caster,        ///< receivers in view, but nothing can shadow them: no map, everything is lit
  invalid_input,    ///< a broken contract, see ShadowPlan::invalid_field; no map
};
[[nodiscard]] std::string_view to_string(PlanStatus status) noexcept;

/// Something that this scene did not need.
enum class OmissionKind : std::uint8_t {
  cascade_without_receiver,  ///< a: depth_begin, b: depth_end
  cascade_without_caster,    ///< a: depth_begin, b: depth_end
  depth_without_receiver,    ///< the camera's range was cut to the receivers': a: depth_begin, b: depth_end
  depth_not_visible,        ///< PlanOptions::visible_depths shows nothing there: a: depth_begin, b: depth_end
  warp_without_gain,        ///< a: objective with the warp over the objective without
  warp_in_stable_fit,       ///< a warp was requested, and Fit::stable takes none
  part_without_caster,      ///< of a partition other than by depth; a: depth_begin, b: depth_end
  partition_without_gain,   ///< one map takes all; a: objective of the parts over that of one map
  partition_in_stable_fit,  ///< another partition than view_depth was requested, and Fit::stable takes none
  face_without_receiver,    ///< of a solid round the light: no visible receiver in it within range and cone
  face_without_caster,      ///< of a solid round the light: no caster between it and its receivers
  resolution_without_gain,  ///< a smaller map meets the requested bound of m; a: bound at full size, b: now
  depth_near_light,         ///< nearer than a to the light nothing casts shadows; b: number of casters there
  option_ignored,           ///< an option that this light or partition has no use for; a: IgnoredOption
  view_without_receiver,    ///< of plan_views: no receiver in view; a: index of the camera
  pages_coarsened,          ///< of plan_pages: the pool is too small; a: requested error, b: planned error
  points_left_coarser,      ///< of plan_pages: PageOptions::share left them to coarser pages; a: how many
  points_beyond_levels,     ///< of plan_pages: the deepest level does not suffice for them; a: how many
  shape_without_gain,       ///< a: the error that the shape lowers, over that without it; 1: it has no use
  plane_without_receiver,   ///< no visible receiver near it, or the light lies in it; a: index in warp.planes
  plane_without_caster,     ///< no caster can reach its receivers; a: index in warp.planes
  cascade_on_planes,        ///< maps of warp.planes serve all of it; a: depth_begin, b: depth_end
  faces_less_divided,       ///< no map is left for a slice that pays; a: slices of that face, b: face_slices
};
/// The option that OmissionKind::option_ignored names.
enum class IgnoredOption : std::uint8_t {
  partition,       ///< split.partition: it divides another kind of light
  split_scheme,    ///< split.scheme: a local light has no cascades
  split_overlap,   ///< split.overlap: only cascades blend
  visible_depths,  ///< the visible depths: a local light has no cascades
  texel_budget,    ///< resolution.texel_budget: maps of this partition keep their size
  history,         ///< the history: parts that follow the view do not move steadily
  selection,       ///< split.selection: only cascades are chosen among by view depth
  cadence,         ///< cadence: needs a history and cascades of a fixed number and size
  visible_points,  ///< the visible points: a local light's maps, kept or stable maps do not follow them
  shape,           ///< warp.shape: see there for the maps that have linear texels whatever it says
  planes,  ///< warp.planes: needs a directional light, one view, depths as partition, tight or rotated
};
/// One entry of ShadowPlan::omitted.
struct Omission {
  OmissionKind kind{};      ///< decides what `a` and `b` hold
  int map = -1;             ///< the cascade or face it is about, as ShadowMap::cascade; -1: the whole plan
  double a = 0.0, b = 0.0;  ///< as OmissionKind states
  std::int64_t saves_texels = 0;  ///< texels that are not drawn
};
/// Writes "what" and "why" as two lines of English, each cut to `size - 1` characters; no heap.
struct OmissionText {
  std::array<char, 48> what;  ///< zero-terminated
  std::array<char, 144> why;  ///< zero-terminated
};
[[nodiscard]] OmissionText describe(const Omission& omission) noexcept;

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
  /// Index of the requested cascade. Local lights have none: 0 for a spot's single map, and for the faces of
  /// a cube 0 to 5 in the order +x -x +y -y +z -z (of the world for a point light; a wide spot's face 5 looks
  /// along it). Partition::tetrahedron: 0 looks along -y, 1 to 3 the other ways. Partition::frustum_faces:
  /// the face, in the order left, right, bottom, top, near, far; with SplitOptions::face_slices above 1
  /// counted through all slices, by face in that order, the nearest first. separating_plane: 0 before the
  /// plane, 1 behind. receiver_clusters: the cluster, in the order of their division.
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
  /// Planes round everything that can shadow a receiver of this map: a caster is needed only if a part of it
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

  /// The texels and how they lie, for look-ups.
  [[nodiscard]] TexelGrid texels() const noexcept { return {width, height, shape, shape_parameters}; }
};

/// An array of `room` records. A new one leaves them unset: setting all the records of a plan would take a
/// tenth of the time that planning takes.
template <typename Record, std::size_t room>
class Records {
 public:
  /// Unset.
  Records() noexcept {}
  /// The first of them.
  [[nodiscard]] Record* data() noexcept { return all_.data(); }
  /// The same, to be read.
  [[nodiscard]] const Record* data() const noexcept { return all_.data(); }
  /// One of them; `i` below `room`.
  [[nodiscard]] Record& operator[](std::size_t i) noexcept { return all_[i]; }
  /// The same, to be read.
  [[nodiscard]] const Record& operator[](std::size_t i) const noexcept { return all_[i]; }

 private:
  static_assert(std::is_trivially_copyable_v<Record>);
  union {
    std::array<Record, room> all_;
  };
};

/// The result of make_plan: maps, omissions, and how points find their map.
struct ShadowPlan {
  PlanStatus status = PlanStatus::invalid_input;  ///< whether there are maps, and why not
  std::string_view invalid_field;                 ///< for invalid_input: which, e.g. "camera.far_depth"
  glm::dvec3 origin_world{0.0};  ///< what clip_from_camera_relative is relative to: the camera position
  /// Unit, the way the light travels; of a spot along its axis, of a point light towards the camera.
  glm::dvec3 light_direction{0.0, -1.0, 0.0};
  ClipSpace clip_space;  ///< of all matrices of the plan
  /// Of the options: in texels of the map at each point, for those who compute it per point.
  BiasOptions bias;
  /// How a point finds its map: false, by its view depth (maps do not overlap in depth); true, for local
  /// lights, for receivers parted by planes and with maps of WarpOptions::planes: the first map that holds it
  /// (map_holds), at any depth. A point that no map holds is lit.
  bool select_by_map = false;
  /// With select_by_map: several maps may hold a point. The one with the most texels per area across the
  /// light there serves it (SplitOptions::selection), not the first. Equal ones: the first.
  bool select_finest = false;
  /// True if map sizes depend on the view (metric_resolution, max_error or texel_budget), so that they may
  /// differ from frame to frame. Renderers then keep images a little larger than the maps.
  bool sizes_vary = false;
  Records<ShadowMap, kMaxMaps> map;           ///< the first map_count are used, the others unset
  int map_count = 0;                          ///< maps to draw
  Records<Omission, kMaxOmissions> omission;  ///< the first omission_count are used, the others unset
  int omission_count = 0;                     ///< may exceed kMaxOmissions

  /// The maps to draw: those of WarpOptions::planes, then by cascade.
  [[nodiscard]] std::span<const ShadowMap> maps() const noexcept {
    return {map.data(), static_cast<std::size_t>(map_count)};
  }
  /// The omissions, at most kMaxOmissions.
  [[nodiscard]] std::span<const Omission> omitted() const noexcept {
    return {omission.data(),
            static_cast<std::size_t>(omission_count < kMaxOmissions ? omission_count : kMaxOmissions)};
  }
};

/// Chooses the shadow maps. Pure: the same input gives the same bits. Allocates nothing, never throws; broken
/// input comes back as PlanStatus::invalid_input.
///
/// `visible` (optional, read during the call only): view depths at which the camera sees a surface, from this
/// frame or tracked over the last ones (visible_depths.hpp). Cascades then cover only the range from the
/// nearest to the farthest of them, with kDepthSafety on either side, and skip depths between that show
/// nothing. Receivers elsewhere get no shadow. Nothing visible counts as unknown. Used with directional
/// lights, perspective cameras and SplitRange other than camera.
///
/// `visible_points_world` (optional, read during the call only): points of surfaces that the camera sees, of
/// a depth buffer of this frame or the last read at every tenth pixel, say. Each cascade then covers across
/// the light only the bounds of those in its depths, with kPointSafety of the bounds on every side; receivers
/// elsewhere get no shadow. A cascade without any is fitted to its receivers. Directional lights, and fits
/// other than stable and warped_stable. Takes time in proportion to the points.
/// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010.
[[nodiscard]] ShadowPlan make_plan(const Camera& camera, const Light& light, const SceneBounds& bounds,
                                   const PlanOptions& options = {}, const VisibleDepths* visible = nullptr,
                                   std::span<const glm::dvec3> visible_points_world = {}) noexcept;
/// Share of the visible points' bounds that a map covers beyond them on each side.
inline constexpr double kPointSafety = 1.0 / 64.0;

/// True where the map shows the point off its filter margin and within its depths. Its clip coordinates have
/// w > 0, and z is in the range of the clip space. Its texel lies filter_margin_texels or more inside the
/// map. A quarter texel, or what positions round by, is left to rounding. It is inside all select_planes.
[[nodiscard]] bool map_holds(const ShadowPlan& plan, const ShadowMap& map,
                             const glm::dvec3& point_world) noexcept;
/// Index of the map that serves a point at this view depth, or -1; see ShadowPlan::select_by_map. Depths
/// beyond the outermost ends, or in a gap, by no more than their rounding belong to the map that ends there.
[[nodiscard]] int map_serving(const ShadowPlan& plan, const glm::dvec3& point_world,
                              double view_depth) noexcept;

/// Writes the indices of the casters that `map` needs to `out` and returns how many there are (all of them
/// are counted; those beyond out.size() are not written). Conservative: a caster that can shadow a receiver
/// of the map is always among them.
std::size_t cull_casters(const ShadowMap& map, std::span<const Box> casters,
                         std::span<std::uint32_t> out) noexcept;

}  // namespace gnomon
