// Which shadow maps are worth drawing for this view, light and scene? Plain data, one record per map.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <type_traits>

#include "gnomon/bounds.hpp"
#include "gnomon/clip_space.hpp"
#include "gnomon/light.hpp"
#include "gnomon/options.hpp"
#include "gnomon/shadow_map.hpp"
#include "gnomon/view.hpp"

namespace gnomon {

inline constexpr int kMaxOmissions =
    32;  ///< entries of ShadowPlan::omitted; later ones are counted, not listed

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
  depth_not_visible,         ///< View::depths shows nothing there: a: depth_begin, b: depth_end
  warp_without_gain,         ///< a: objective with the warp over that without; infinite: it fits no map here
  warp_in_stable_fit,        ///< a warp was requested, and Fit::stable takes none
  part_without_caster,       ///< of a partition other than by depth; a: depth_begin, b: depth_end
  partition_without_gain,    ///< one map takes all; a: objective of the parts over that of one map
  partition_in_stable_fit,   ///< another partition than view_depth was requested, and Fit::stable takes none
  face_without_receiver,     ///< of a solid round the light: no visible receiver in it within range and cone
  face_without_caster,       ///< of a solid round the light: no caster between it and its receivers
  resolution_without_gain,   ///< a smaller map meets the requested bound of m; a: bound at full size, b: now
  depth_near_light,          ///< nothing casts nearer than depth a on the map's axis; b: casters cut there
  option_ignored,            ///< an option that this light or partition has no use for; a: IgnoredOption
  view_without_receiver,     ///< of plan_views: no receiver in view; a: index of the camera
  pages_coarsened,           ///< of plan_pages: the pool is too small; a: requested error, b: planned error
  points_left_coarser,       ///< of plan_pages: PageOptions::share left them to coarser pages; a: how many
  points_beyond_levels,      ///< of plan_pages: the deepest level does not suffice for them; a: how many
  shape_without_gain,        ///< a: the error that the shape lowers, over that without it; 1: it has no use
  plane_without_receiver,  ///< no visible receiver near it, or the light lies in it; a: index in warp.planes
  plane_without_caster,    ///< no caster can reach its receivers; a: index in warp.planes
  cascade_on_planes,       ///< maps of warp.planes serve all of it; a: depth_begin, b: depth_end
  faces_less_divided,      ///< no map is left for a slice that pays; a: slices of that face, b: face_slices
  receiver_near_light,     ///< receivers nearer than a to the light have no map, and are lit; b: their boxes
  cascade_without_gain,    ///< the next map serves it with the same texels; a: depth_begin, b: depth_end
};
/// The option that OmissionKind::option_ignored names.
enum class IgnoredOption : std::uint8_t {
  partition,       ///< split.partition: it divides another kind of light
  split_scheme,    ///< split.scheme: a local light has no cascades, and Objective::picture splits by itself
  split_overlap,   ///< split.overlap: only cascades blend
  visible_depths,  ///< the visible depths: a local light has no cascades
  texel_budget,    ///< resolution.texel_budget: maps of this partition keep their size
  history,         ///< the history: parts that follow the view do not move steadily
  selection,       ///< split.selection: only cascades are chosen among by view depth
  cadence,         ///< cadence: needs a history and cascades of a fixed number and size
  visible_points,  ///< the visible points: a local light's maps, kept or stable maps do not follow them
  shape,           ///< warp.shape: see there for the maps that have linear texels whatever it says
  planes,      ///< warp.planes: needs a directional light, one view, depths as partition, tight or rotated
  page_share,  ///< PageOptions::share: see PagePolicy::chooses
  page_reach,  ///< PageOptions::reach_texels: the same
};
/// One entry of ShadowPlan::omitted.
struct Omission {
  OmissionKind kind{};      ///< decides what `a` and `b` hold
  int map = -1;             ///< the cascade or face it is about, as ShadowMap::cascade; -1: the whole plan
  double a = 0.0, b = 0.0;  ///< as OmissionKind states
  std::int64_t saves_texels = 0;  ///< texels that are not drawn
};
/// An omission in words.
struct OmissionText {
  std::array<char, 48> what;  ///< zero-terminated
  std::array<char, 144> why;  ///< zero-terminated
};
/// Says what was omitted and why, as two lines of English, each cut to its array's size; no heap.
[[nodiscard]] OmissionText describe(const Omission& omission) noexcept;

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
  /// The bias of the options, in texels of the map at each point, for shaders that compute it per point.
  BiasOptions bias;
  /// How a point finds its map. view_depth: the cascades of a directional light. first_holding: local lights,
  /// receivers parted by planes, and maps of WarpOptions::planes. finest: SplitOptions::selection; of maps
  /// with equal texels the first. A point that no map holds is lit.
  MapSelection selection = MapSelection::view_depth;
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

struct PlanHistory;

/// Chooses the shadow maps. Pure: the same input gives the same bits. Allocates nothing, never throws; broken
/// input comes back as PlanStatus::invalid_input.
///
/// With View::depths, cascades cover only the range from the nearest to the farthest visible depth, with
/// kDepthSafety on either side. They skip depths between that show nothing. Receivers elsewhere get no
/// shadow. Used with directional lights, perspective cameras and SplitRange other than camera.
///
/// With View::points_world, each cascade covers across the light only the bounds of those in its depths, with
/// kPointSafety of the bounds on every side. Receivers elsewhere get no shadow. A cascade without any is
/// fitted to its receivers. Directional lights, and fits other than stable and warped_stable. Takes time in
/// proportion to the points.
///
/// `history` makes it a plan for the next frame of a moving camera (motion.hpp), nullptr one of its own.
/// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010.
[[nodiscard]] ShadowPlan make_plan(const View& view, const Light& light, const SceneBounds& bounds,
                                   const PlanOptions& options = {}, PlanHistory* history = nullptr) noexcept;
/// Share of the visible points' bounds that a map covers beyond them on each side.
inline constexpr double kPointSafety = 1.0 / 64.0;

/// True where the map shows the point off its filter margin and within its depths. Its clip coordinates have
/// w > 0, and z is in the range of the clip space. Its texel lies filter_margin_texels or more inside the
/// map. A quarter texel, or what positions round by, is left to rounding. It is inside all select_planes.
[[nodiscard]] bool map_holds(const ShadowPlan& plan, const ShadowMap& map,
                             const glm::dvec3& point_world) noexcept;
/// Index of the map that serves a point at this view depth, or -1; see ShadowPlan::selection. Depths
/// beyond the outermost ends, or in a gap, by no more than their rounding belong to the map that ends there.
[[nodiscard]] int map_serving(const ShadowPlan& plan, const glm::dvec3& point_world,
                              double view_depth) noexcept;

inline constexpr int kMaxViews =
    8;  ///< cameras of one plan: the two eyes, four players, or a probe's six faces

/// Chooses the shadow maps that all cameras share. A cascade holds the receivers that any camera sees between
/// its depths, each by its own view depth. Errors count for the camera that sees them largest: m_s_max,
/// m_t_max, m_max and storage of a map are the largest over the cameras.
///
/// Points find their map by what the maps hold (MapSelection::finest), so that
/// all cameras read the same texels for one point. clip_from_camera_relative is relative to
/// ShadowPlan::origin_world, the mean of the eyes: shaders take points relative to it, or each camera takes
/// rebased(map, its position).
///
/// Cameras that see no receiver are omitted, and listed as OmissionKind::view_without_receiver. One camera:
/// the plan of make_plan with MapSelection::finest. SplitScheme::optimal is logarithmic, pseudo_near and the
/// warp's axis are those of the mean view, and Partition::view_depth is the only one. Fit::stable serves
/// directional lights only where the cameras keep their places to each other.
/// Pure, allocates nothing, never throws. More than kMaxViews cameras, none, perspective mixed with
/// orthographic ones, or a broken one: PlanStatus::invalid_input with the field `cameras`, or as make_plan.
[[nodiscard]] ShadowPlan plan_views(std::span<const Camera> cameras, const Light& light,
                                    const SceneBounds& bounds, const PlanOptions& options = {}) noexcept;

}  // namespace gnomon
