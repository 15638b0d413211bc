// Which options does make_plan take? Grouped by the question that each group decides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string_view>

#include "gnomon/bounds.hpp"
#include "gnomon/clip_space.hpp"

namespace gnomon {

enum class Fit : std::uint8_t {
  tight,    ///< the smallest rectangle round the slice's receivers: best texels, a grid that moves with
            ///< the camera
  rotated,  ///< as tight, and the rectangle may turn: the least area where that lowers the objective
  stable,   ///< a rectangle that holds the slice's receivers wherever the camera looks, snapped to whole
            ///< texels: a stable grid. Its sides depend on the slice, the light and the bounds of all
            ///< receivers, in steps. So give all of them, not those in view alone, and a PlanHistory where
            ///< receivers move
  warped_stable,  ///< as tight with room to spare, and kept as it is while the view stays inside. With a
                  ///< PlanHistory (motion.hpp) a warped grid that rarely changes
};
[[nodiscard]] std::string_view to_string(Fit fit) noexcept;
/// True and `fit` set where `name` is one of tight, rotated, stable, warped_stable.
[[nodiscard]] bool fit_from_name(std::string_view name, Fit& fit) noexcept;

enum class Partition : std::uint8_t {
  view_depth,        ///< cascades along the view
  frustum_faces,     ///< a map for each face of the camera's frustum that the light enters by, or leaves by.
                     ///< Whichever set lowers the objective; up to 5, whatever the number of cascades, and up
                     ///< to kMaxMaps with SplitOptions::face_slices
  separating_plane,  ///< two maps, parted by a plane parallel to the light where the warped map's texels grow
                     ///< beyond those of a uniform one. Warped before it, uniform behind
  tetrahedron,  ///< point lights: four maps in place of a cube's six, a triangle of directions each. Fewer
                ///< passes and longer texels (up to 9 times a texel's area in the corners, a cube's 5.2).
                ///< Based on: Liao, "Shadow Mapping for Omnidirectional Light Using Tetrahedron Mapping",
                ///< GPU Pro, 2010
  receiver_clusters,  ///< groups of receiver boxes with room between them, parted by planes along the axes of
                      ///< the world and across the view. As many maps as PlanOptions::cascades. Islands side
                      ///< by side get maps of their own, which cascades never give them. Based on: Forsyth,
                      ///< "Extremely Practical Shadows", 2006, with planes in place of marks on objects
};
// frustum_faces, separating_plane and receiver_clusters divide the receivers of directional lights, and only
// where that lowers the objective; else one map takes all (receiver_clusters: as many cascades, where they
// are better), and the plan lists an omission. Fit::stable, whose grid must not follow the view, keeps
// view_depth, and a PlanHistory does not steady the parts. Every other partition leaves a point light the
// faces of a cube. Spot lights have one cone or a cube: under a texel_budget by the view (docs/lights.md).

/// True for the partitions that divide what a directional light lights other than by view depth.
[[nodiscard]] constexpr bool divides_parallel(Partition partition) noexcept {
  return partition == Partition::frustum_faces || partition == Partition::separating_plane ||
         partition == Partition::receiver_clusters;
}

[[nodiscard]] std::string_view to_string(Partition partition) noexcept;
/// True and `partition` set where `name` is one of view_depth, frustum_faces, separating_plane,
/// tetrahedron, receiver_clusters.
[[nodiscard]] bool partition_from_name(std::string_view name, Partition& partition) noexcept;

inline constexpr int kMaxMaps = 8;  ///< cascades of one plan; beyond 8 no published figure gains anything

/// `optimal` needs the receivers and is made by the plan: it minimises the plan's objective over the actual
/// body, and costs some hundred microseconds. By Objective::picture it is `automatic`. It is logarithmic with
/// Fit::stable, whose edges must not follow what is in view. `automatic` is logarithmic over the receivers'
/// depths, where that is close to the best, and practical with Fit::stable, whose range begins at the near
/// plane. split_depths() treats both as logarithmic. `given` takes the caller's own depths.
enum class SplitScheme : std::uint8_t {
  uniform,
  logarithmic,
  practical,
  pseudo_near,
  optimal,
  automatic,
  given
};
/// Which depths SplitOptions divides: SplitOptions::range says what each of them is.
enum class SplitRange : std::uint8_t { automatic, receivers, camera };

[[nodiscard]] std::string_view to_string(SplitScheme scheme) noexcept;
/// True and `scheme` set where `name` is one of uniform, logarithmic, practical, pseudo_near, optimal, auto,
/// given.
[[nodiscard]] bool split_scheme_from_name(std::string_view name, SplitScheme& scheme) noexcept;

/// How a point finds its map.
enum class MapSelection : std::uint8_t {
  view_depth,     ///< the cascade whose view depths hold the point; maps do not overlap in depth
  first_holding,  ///< the first map that holds the point (map_holds), at any depth; no option
  finest,         ///< of the maps that hold the point, the one with the smallest texels there
};
[[nodiscard]] std::string_view to_string(MapSelection selection) noexcept;
/// True and `selection` set where `name` is one of view_depth, finest.
[[nodiscard]] bool map_selection_from_name(std::string_view name, MapSelection& selection) noexcept;

/// Where one cascade ends and the next begins. Directional lights only.
struct SplitOptions {
  SplitScheme scheme = SplitScheme::automatic;  ///< how depths are divided
  /// practical: blend of uniform (0) and logarithmic (1) splits, 0..1.
  double lambda = 0.7;
  /// View depth, world units, from which error counts: nearer surfaces keep their shadow and do not draw
  /// texels towards the eye. SplitScheme::pseudo_near begins its logarithmic splits there. 0: the near plane
  /// itself.
  double pseudo_near = 0.0;
  /// Which depths are divided: those that hold receivers in view, or the camera's whole range. `automatic`
  /// takes the receivers', but for Fit::stable and cascades that CadenceOptions keep: these must not depend
  /// on what is in view. They end where no receiver can lie farther, however the camera turns:
  /// with_finite_far.
  SplitRange range = SplitRange::automatic;
  /// given: the cascades - 1 view depths between neighbouring cascades, ascending, world units. They are
  /// clamped to the depths that are divided; a cascade without any depth left is omitted. Those after them
  /// are not read.
  std::array<double, kMaxMaps - 1> given = endless_splits();
  /// Width of the blend band before a cascade, as a share of the previous cascade's depths, 0..1. The cascade
  /// behind also covers it, with all casters. A wider band hides the step between their texels better and
  /// takes texels from the map behind. Partition::view_depth only.
  double overlap = 0.0;
  /// How a point finds its map among the cascades of a directional light: view_depth, the default and the
  /// cheaper look-up, or finest. `finest` lowers the error
  /// where nearer maps reach behind their depths, most under a light along the view. Their casters and light
  /// depths are widened to all receivers in the map, and a look-up evaluates every map. There is no blend
  /// band. Based on: Zhang, Zaprjagaev, Bentham, "Practical Cascaded Shadow Maps", ShaderX7, 2009.
  MapSelection selection = MapSelection::view_depth;
  /// Division of the receivers among the maps. Partitions other than view_depth ignore cascades and splits,
  /// but for face_slices.
  Partition partition = Partition::view_depth;
  /// Partition::frustum_faces: most slices along the view that each of the frustum's four side faces is
  /// divided into, each with a map of its own, 1..kMaxMaps. Default 1: a map for each face. More slices need
  /// fewer texels for the same error and cost a pass each. `scheme` divides the depths at the face; automatic
  /// and optimal count as logarithmic. A face has fewer where another one does not lower the objective, or
  /// where the plan has kMaxMaps maps already. The face that gains the most gets the next slice, and the plan
  /// lists an omission. Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006.
  int face_slices = 1;

  /// The value of `given` where none is given: infinities.
  [[nodiscard]] static constexpr std::array<double, kMaxMaps - 1> endless_splits() noexcept {
    std::array<double, kMaxMaps - 1> all{};
    for (double& depth : all) depth = std::numeric_limits<double>::infinity();
    return all;
  }
  /// Equal in all members.
  bool operator==(const SplitOptions&) const = default;
};

/// Error that a parametrization minimises. It counts from the nearest receiver on, where there are several.
enum class Objective : std::uint8_t {
  storage,  ///< max m_s times max m_t: texels needed per pixel for m <= 1 along both axes everywhere
  max,      ///< the worst texel
  p95,  ///< the error that 95 % of the visible points stay below: pixels evenly, depths by their logarithm
  /// The mean error at points of surfaces that the camera sees, across an edge of any direction. The area of
  /// misclassified pixels along shadows' edges grows with it. The points are View::points_world, and
  /// automatic splits are then where their error is least. Without points, each ray of a fan gives one, in
  /// one of the first receiver boxes that it meets. Automatic splits are then logarithmic from the nearest of
  /// them on, and take the place of optimal ones. Air in front of all boxes never counts. Searched warps of
  /// parallel light are bounded: depths of the smallest texel must survive in single precision at the
  /// farthest caster. Maps with fewer than six points go by `storage`. So do Fit::stable, views that share
  /// maps, and partitions of parallel light other than view_depth.
  picture,
};
[[nodiscard]] std::string_view to_string(Objective objective) noexcept;
[[nodiscard]] bool objective_from_name(std::string_view name, Objective& objective) noexcept;

struct WarpInput;
struct WarpChoice;

/// One entry of the registry warps.def. Authors of warps: extend/warp.hpp.
struct Warp {
  std::string_view name;     ///< as in files and on command lines
  std::string_view summary;  ///< one line
  /// Finds axis, strength and centre for a body.
  WarpChoice (*choose)(const WarpInput& input) noexcept;
  /// True where the plan may drop the warp because it does not lower the objective. False only for warps kept
  /// to reproduce a paper as it stands.
  bool drop_without_gain;
  /// True where the search begins at WarpInput::start, if there is one.
  bool follows_start = false;
};

/// All warps, in the order of warps.def.
[[nodiscard]] std::span<const Warp* const> all_warps() noexcept;
/// nullptr where there is none of that name.
[[nodiscard]] const Warp* find_warp(std::string_view name) noexcept;

namespace warps {
#define GNOMON_WARP(name) extern const Warp name;
#include "gnomon/warps.def"
#undef GNOMON_WARP
}  // namespace warps

struct RoundShape;
struct ServingShape;
struct ShapedPoint;
struct ShapeRectangle;
struct TexelNeeds;

/// Numbers that a shape is set by; what they mean is the shape's own. All 0: linear texels. At most fifteen,
/// so that shaders get them in one matrix, behind the shape's place in shapes.def.
using ShapeParameters = std::array<double, 15>;

/// One entry of the registry shapes.def. Authors of shapes: extend/shape.hpp. `size`: width and height of the
/// map in texels. Either texel coordinate grows with the ndc coordinate of the same name. Every function
/// takes any finite place. Off the square -1..1 the shape goes on as its formula does, or along its tangent
/// where the formula ends.
struct Shape {
  std::string_view name;     ///< as in files
  std::string_view summary;  ///< one line
  /// True where the derivative is the same everywhere. Straight lines stay straight, so that triangles are
  /// drawn as they are, and a map may be scrolled.
  bool affine;
  /// Where a place in ndc lies in the map.
  ShapedPoint (*place)(const ShapeParameters& parameters, const glm::dvec2& size,
                       const glm::dvec2& ndc) noexcept;
  /// The inverse: which place in ndc lies at a place in the map.
  glm::dvec2 (*ndc_of)(const ShapeParameters& parameters, const glm::dvec2& size,
                       const glm::dvec2& texel) noexcept;
  /// The smallest rectangle of texels round the image of a rectangle of ndc.
  ShapeRectangle (*texel_bounds)(const ShapeParameters& parameters, const glm::dvec2& size,
                                 const ShapeRectangle& ndc) noexcept;
  /// The smallest rectangle of ndc whose image holds a rectangle of texels.
  ShapeRectangle (*ndc_bounds)(const ShapeParameters& parameters, const glm::dvec2& size,
                               const ShapeRectangle& texels) noexcept;
  /// Parameters under which rows of texels undo the warp of a map whose w grows by exp(log_growth) from ndc y
  /// -1 to 1. Any value; beyond kMaxLogGrowth and where it is not a number the shape goes as far as it can.
  ShapeParameters (*undoing)(double log_growth) noexcept;
  /// Parameters of the same shape seen in a mirror: over ndc x (`x`), ndc y (`y`) of the other sign.
  ShapeParameters (*mirrored)(const ShapeParameters& parameters, bool x, bool y) noexcept;
  /// How many of the parameters it has; the others are 0.
  int parameter_count = 0;
  /// Parameters under which the largest of the needs is as small as it gets; nullptr for shapes that do not
  /// follow visible points. Needs without a number above 0 give linear texels.
  ServingShape (*serving)(const TexelNeeds& needs) noexcept = nullptr;
  /// Parameters for a local light's rays; nullptr for shapes that do not follow them. `slopes`: those off the
  /// light's axis that receivers have, none empty; `size`: of the map, texels, more than two margins.
  RoundShape (*round)(const ShapeRectangle& slopes, const glm::dvec2& size,
                      int margin_texels) noexcept = nullptr;
};

/// All shapes, in the order of shapes.def.
[[nodiscard]] std::span<const Shape* const> all_shapes() noexcept;
/// nullptr where there is none of that name.
[[nodiscard]] const Shape* find_shape(std::string_view name) noexcept;

namespace shapes {
#define GNOMON_SHAPE(name) extern const Shape name;
#include "gnomon/shapes.def"
#undef GNOMON_SHAPE
}  // namespace shapes

/// In texels of the map at the point that is shaded, so that one setting serves every cascade and every warp.
/// A texel's extent there is world units from the map's own Jacobian; under a warp it grows with w along x
/// and w^2 along y.
struct BiasOptions {
  /// Along the light, in texels, everywhere. Covers depth rounding and relief that is thinner than that.
  double constant_texels = 0.15;
  /// Along the light, in texels times tan(angle between normal and light). 0.5 covers a texel sampled at its
  /// centre.
  double slope_texels = 0.5;
  /// Along the surface normal, in texels times sin(angle between normal and light). At grazing light more of
  /// it lifts look-ups over the casters of their shadows.
  double normal_offset_texels = 0.1;
  /// Cap of tan(angle) in the slope term: at grazing light it would move shadows off their casters. The plane
  /// of the receiver, which every look-up follows, is exact beyond it (kSteepestPlane).
  double max_slope = 4.0;
  /// Equal in all members.
  bool operator==(const BiasOptions&) const = default;
};

enum class PruneRule : std::uint8_t {
#define GNOMON_PRUNE_RULE(name, certainty, source, what, premise, proof) name,
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
};
inline constexpr std::size_t kPruneRuleCount = 0
#define GNOMON_PRUNE_RULE(name, certainty, source, what, premise, proof) +1
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
    ;

enum class PruneCertainty : std::uint8_t {
  exact,    ///< the shadow mask is the same to the last bit
  bounded,  ///< it may differ, by no more than PruneRuleInfo::proof says
};

enum class PruneSource : std::uint8_t {
  this_frame,  ///< the rule prunes from what this frame alone knows
  last_frame,  ///< the rule reuses what the last frame drew: a frame drawn alone has none of it
};

/// One entry of the registry prune_rules.def.
struct PruneRuleInfo {
  PruneRule rule{};            ///< the rule
  std::string_view name;       ///< as in files and on command lines
  PruneCertainty certainty{};  ///< exact or bounded
  PruneSource source{};        ///< the frame that the rule draws from
  std::string_view what;       ///< the rule omits
  std::string_view premise;    ///< where this does not hold, the rule does nothing
  std::string_view proof;      ///< that no pixel changes; of bounded rules: the bound
};
/// All rules, in the order in which a frame applies them.
[[nodiscard]] std::span<const PruneRuleInfo, kPruneRuleCount> prune_rules() noexcept;

/// Which of them are on.
struct PruneRules {
  static constexpr std::uint32_t kAll =
      (std::uint32_t{1} << kPruneRuleCount) - 1;  ///< every bit that a rule has
  std::uint32_t bits = kAll;                      ///< bit i stands for the rule of value i

  /// Exact and bounded rules.
  [[nodiscard]] static constexpr PruneRules all() noexcept { return {kAll}; }

  /// True where the rule is on.
  [[nodiscard]] constexpr bool has(PruneRule rule) const noexcept {
    return (bits >> static_cast<unsigned>(rule) & 1u) != 0;
  }
  /// These rules and `rule`.
  [[nodiscard]] constexpr PruneRules with(PruneRule rule) const noexcept {
    return {bits | (std::uint32_t{1} << static_cast<unsigned>(rule))};
  }
  /// These rules except `rule`.
  [[nodiscard]] constexpr PruneRules without(PruneRule rule) const noexcept {
    return {bits & ~(std::uint32_t{1} << static_cast<unsigned>(rule))};
  }
  /// The same rules are on.
  bool operator==(const PruneRules&) const = default;
};
inline constexpr PruneRules kPruneNothing{0};
/// The rules that change no bit of the shadow mask.
[[nodiscard]] constexpr PruneRules exact_prune_rules() noexcept {
  PruneRules rules = kPruneNothing;
#define GNOMON_PRUNE_RULE(name, certainty, source, what, premise, proof) \
  if (PruneCertainty::certainty == PruneCertainty::exact) rules = rules.with(PruneRule::name);
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
  return rules;
}
/// The exact rules, light_depths and equal_cascades: texels stay, and depths are only stored in other steps.
[[nodiscard]] constexpr PruneRules default_prune_rules() noexcept {
  return exact_prune_rules().with(PruneRule::light_depths).with(PruneRule::equal_cascades);
}
/// The rules that draw from this source.
[[nodiscard]] PruneRules prune_rules_of(PruneSource source) noexcept;
/// The rule of this name; nullptr where there is none.
[[nodiscard]] const PruneRuleInfo* find_prune_rule(std::string_view name) noexcept;

/// Reads "default", "all", "none", "exact" or names divided by commas. False, and `rules` unchanged, where a
/// name is unknown.
[[nodiscard]] bool parse_prune_rules(std::string_view text, PruneRules& rules) noexcept;

/// Work that a rule saved in one frame.
struct PruneSaving {
  std::uint64_t texels = 0;     ///< of shadow maps, not drawn
  std::uint64_t triangles = 0;  ///< not drawn into maps
  std::uint64_t instances = 0;  ///< the same
  std::uint64_t maps = 0;       ///< cascades that were omitted, or maps that were not drawn at all
  std::uint64_t filtered = 0;   ///< texels that a filter did not store and blur
};

/// Texels along a side of a map: fewer cannot hold a filter's border, more exceed what drivers accept.
inline constexpr int kLeastMapSize = 4, kMaxMapSize = 16384;

/// Least bound of the aliasing error that maps can be sized for, screen pixels per texel.
inline constexpr double kLeastError = 1e-9;

/// Sides of maps that the plan sizes are multiples of this: a tile that rasterizers handle well.
inline constexpr int kSizeStep = 16;

/// Bounds of PlanOptions::light_near_share: nearer, no depth has any precision; farther, the map begins in
/// the middle of what it shows.
inline constexpr double kLeastLightNearShare = 1e-7, kMaxLightNearShare = 0.5;

/// Most frames between two plans of a cascade: in more, a map outlives what it was planned for.
inline constexpr int kMaxCadenceFrames = 64;

/// How many texels each map gets.
struct ResolutionOptions {
  /// Texels along each side of each map, kLeastMapSize..kMaxMapSize. Doubling it halves the error and costs
  /// four times the memory. Maps are exactly this large unless max_error or texel_budget is set, or
  /// PruneRule::metric_resolution is on; they are never larger unless texel_budget is set.
  int max_size = 1024;
  /// Aliasing error m (screen pixels per texel) that suffices; 0: none, all cascades are used. Above 0, the
  /// plan takes the fewest cascades whose m_max bound is at or below it, else those with the least bound. It
  /// makes each map as small as that allows. Objective::max meets more bounds than the default, which does
  /// not count air. Costs up to `cascades` times as much to plan.
  double max_error = 0.0;
  /// Most texels that all maps may have together; 0: no budget. By Objective::picture, texels are distributed
  /// so that the mean error over visible points, given or guessed, is least: maps that show more get more.
  /// Otherwise all maps have the same worst-case error. A side has up to kMaxMapSize. Sides may differ with
  /// Fit::tight and Fit::rotated, and stay equal elsewhere and with a history. The number of cascades, up to
  /// `cascades`, is the one with the least error. At least least_budget_side() squared for each cascade
  /// (local lights: for each of six faces). Partitions other than view_depth ignore it, and the plan reports
  /// that.
  std::int64_t texel_budget = 0;
  /// Bound of m that PruneRule::metric_resolution shrinks maps to, at least kLeastError. A larger bound gives
  /// smaller maps whose texels show.
  double prune_error = 1.0;
  /// Different world sizes per octave that a map of Fit::stable may have, 1..1024. Fewer keep the texel grid
  /// unchanged through a zoom or a change of the splits, and enlarge texels by up to 1 / steps.
  int stable_size_steps = 1024;
  /// Equal in all members.
  bool operator==(const ResolutionOptions&) const = default;
};

/// Most planes of WarpOptions::planes.
inline constexpr int kMaxWarpPlanes = 3;

/// A plane with receivers that matter: a floor, a table top, a wall.
struct WarpPlane {
  glm::dvec3 point_world{0.0};       ///< any point on it
  glm::dvec3 normal{0.0, 1.0, 0.0};  ///< world axes, any length above 0, to either side
  /// How far receivers may lie off the plane, to each side, world units. 0, the default: there is no plane.
  /// More takes in rough ground and low objects, whose texels are then no longer one pixel each.
  double thickness = 0.0;
  /// Equal in all members.
  bool operator==(const WarpPlane&) const = default;
};

/// Which perspective warp a map gets, and what it is chosen by.
struct WarpOptions {
  /// The warp; nullptr lets the plan choose the one with the largest measured gain. Fit::stable has none.
  /// `optimal_thorough` needs the fewest texels, and is for plans that serve many frames: it searches up to
  /// nine times as long as `optimal`.
  const Warp* warp = nullptr;
  /// How texels lie along the warp (extend/shape.hpp). `logarithmic` evens out the error along the view that
  /// the warp's perspective leaves, and is drawn by bounding rectangles, which costs time. Taken where it
  /// lowers the error of a map whose rows lie across its warp. Linear elsewhere, and with fits other than
  /// tight or with a history. With it, a `warp` of nullptr is psm, which it goes best with, where both
  /// together lower the objective. `rectilinear` makes columns and rows narrow where visible points need it.
  /// Maps are linear without such points, for local lights, with several views, kernels in world units, or
  /// sizes that follow the error. So they are with fits other than tight or a history. Receivers that are not
  /// among the points get texels up to 16 times longer. `paraboloid` evens out the angles between a local
  /// light's texels, without a warp, with a tight fit. It takes no history, and sizes that do not follow the
  /// error. Directional lights have linear texels. nullptr counts as linear.
  const Shape* shape = &shapes::linear;
  /// The error that a warp must lower to be used.
  Objective objective = Objective::picture;
  /// World-space box whose error counts `focus_weight` times: a hero, a cockpit, a table top. Everything else
  /// stays in the map, with larger texels. A box that is small in the view holds few of the points that
  /// count, and may gain nothing. An empty box, the default, means none.
  Box focus{};
  double focus_weight = 4.0;  ///< 1..1e6
  /// Planes that get a map each, besides the cascades, in which every texel is one pixel's image on the plane
  /// (warps::plane_optimal); default none. Receivers near a plane take its map and all others the cascades,
  /// so that each plane costs one more map to draw. A plane without receiver or caster in view gets none. The
  /// map's `cascade` is PlanOptions::cascades plus the plane's index, which must be below kMaxMaps.
  std::array<WarpPlane, kMaxWarpPlanes> planes{};
  /// True where there is a plane.
  [[nodiscard]] bool has_planes() const noexcept {
    for (const WarpPlane& plane : planes)
      if (plane.thickness != 0.0) return true;
    return false;
  }
  /// Equal in all members.
  bool operator==(const WarpOptions&) const = default;
};

/// How far the widest filter kernel reaches from a texel. A border this wide is reserved for filtering:
/// receivers stay off it, casters in it are still drawn.
struct FilterExtent {
  /// Kernel radius in texels, 0..max_size/4.
  double texels = 1.0;
  /// Kernel radius in world units across the light, >= 0. The border is as wide as the kernel gets where the
  /// map's texels are smallest, at most a quarter of the map. The wider of the two radii counts. With
  /// Fit::stable under a local light, it is that of the nearest power of two below the nearest surface in
  /// view.
  double world = 0.0;
  /// Equal in all members.
  bool operator==(const FilterExtent&) const = default;
};

/// How often the cascades behind the first are planned. Between two plans of a cascade its map keeps its
/// matrix, with room for the motion in between, and needs no drawing: reuse() returns `identical`.
/// Needs a PlanHistory, a directional light and unmoved bounds. A cascade is planned at once where the camera
/// moved farther than promised, or its lens, the light or any option changed.
/// With more than one frame, cascades divide the depths where receivers may lie, however the camera turns, by
/// `practical` in place of `automatic` and `optimal`. Visible points do not move their splits.
struct CadenceOptions {
  /// Frames from one plan of a cascade to its next, 1..kMaxCadenceFrames. 1, the default: every frame.
  /// Cascades take turns.
  int frames = 1;
  /// Largest step of the eye from one frame to the next, world units, >= 0; default 0. A larger one enlarges
  /// the kept maps by frames - 1 steps on each side.
  double largest_step = 0.0;
  /// Largest turn of the camera from one frame to the next, radians, 0..pi; default 0. Room is a turn's arc
  /// at the cascade's far end.
  double largest_turn = 0.0;
  /// Equal in all members.
  bool operator==(const CadenceOptions&) const = default;
};

/// Options of make_plan. Every default suits most scenes.
struct PlanOptions {
  /// Maps along the view, 1..kMaxMaps. More maps lower the error far away and cost one pass each. Directional
  /// lights only. A spot light has one map. A point light, or a wide spot light, has up to six, the faces of
  /// a cube. A spot is wide from 66 degrees of half angle on. There five faces need fewer texels than one map
  /// for the same error. With the shape paraboloid it is wide from 85 degrees on.
  int cascades = 4;
  /// How many texels each map gets.
  ResolutionOptions resolution{};
  /// How a map's rectangle is fitted to its slice: tight for the smallest texels, stable against shimmering.
  Fit fit = Fit::tight;
  /// Where one cascade ends and the next begins.
  SplitOptions split{};
  /// The perspective warp, and the error that it must lower.
  WarpOptions warp{};
  /// How often the cascades behind the first are planned.
  CadenceOptions cadence{};
  /// How far filter kernels reach.
  FilterExtent filter{};
  /// How far depths are moved off the surface, in texels.
  BiasOptions bias{};
  /// Local lights: distance at which maps begin, over that of the farthest receiver. Read where the scene's
  /// boxes leave it open, as those of a room that holds its light do. In
  /// kLeastLightNearShare..kMaxLightNearShare. Nearer casters then cast no shadow; nearer boxes that do not
  /// hold the light are still shown. At 2^-13 a float's steps of depth are as long as texels at the far end,
  /// and such rooms have acne. 2^-10 keeps clear of that. Depths that are linear along the light work down to
  /// 2^-17 (docs/bias.md).
  double light_near_share = 0x1p-10;
  /// Clip space of the matrices in the plan.
  ClipSpace clip_space{};
  /// Work that may be omitted. Default: the exact rules of prune_rules.def, light_depths and equal_cascades.
  /// PruneRules::all() adds the other bounded rules: among others, maps shrink to the size that their error
  /// bound needs.
  PruneRules prune = default_prune_rules();
  /// Equal in all members.
  bool operator==(const PlanOptions&) const = default;
};

/// The shortest side that a texel budget gives: kSizeStep, or four filter radii.
[[nodiscard]] int least_budget_side(const PlanOptions& options) noexcept;

}  // namespace gnomon
