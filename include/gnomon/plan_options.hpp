// Which options does make_plan take? Grouped by the question that each group decides.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "gnomon/bias.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/clip_space.hpp"
#include "gnomon/fit.hpp"
#include "gnomon/partition.hpp"
#include "gnomon/prune.hpp"
#include "gnomon/shape.hpp"
#include "gnomon/split.hpp"
#include "gnomon/warp.hpp"

namespace gnomon {

/// Texels along a side of a map: fewer cannot hold a filter's border, more exceed what drivers accept.
inline constexpr int kLeastMapSize = 4, kMostMapSize = 16384;

/// Least bound of the aliasing error that maps can be sized for, screen pixels per texel.
inline constexpr double kLeastError = 1e-9;

/// Sides of maps that the plan sizes are multiples of this: a tile that rasterizers handle well.
inline constexpr int kSizeStep = 16;

/// Bounds of PlanOptions::light_near_share: nearer, no depth has any precision; farther, the map begins in
/// the middle of what it shows.
inline constexpr double kLeastLightNearShare = 1e-7, kMostLightNearShare = 0.5;

/// Most frames between two plans of a cascade: in more, a map outlives what it was planned for.
inline constexpr int kMostCadenceFrames = 64;

/// How many texels each map gets.
struct ResolutionOptions {
  /// Texels along each side of each map, kLeastMapSize..kMostMapSize. Doubling it halves the error and costs
  /// four times the memory. Maps are exactly this large unless max_error or texel_budget is set, or
  /// PruneRule::metric_resolution is on; they are never larger unless texel_budget is set.
  int max_size = 1024;
  /// Aliasing error m (screen pixels per texel) that suffices; 0: none, all cascades are used. Above 0, the
  /// plan takes the fewest cascades whose m_max bound is at or below it. Where none are, it takes those with
  /// the least bound. It makes each map as small as the bound allows. Costs up to `cascades` times as much to
  /// plan.
  double max_error = 0.0;
  /// Most texels that all maps may have together; 0: no budget. Texels are distributed so that all maps have
  /// the same worst-case error, up to kMostMapSize along a side. Sides may differ with Fit::tight and
  /// Fit::rotated, and stay equal elsewhere and with a history. The number of cascades, up to `cascades`, is
  /// the one with the least error. At least least_budget_side() squared for each cascade (local lights: for
  /// each of six faces). Partitions other than view_depth ignore it, and the plan reports that.
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
  /// How texels lie along the warp (shape.hpp): `logarithmic` evens out the error along the view that the
  /// warp's perspective leaves, and is drawn by bounding rectangles, which costs time. Taken where it lowers
  /// the error of a map whose rows lie across its warp; linear elsewhere, and with fits other than tight or
  /// with a history. With it, a `warp` of nullptr is psm, which it goes best with, where both together lower
  /// the objective. `rectilinear` makes columns and rows narrow where visible points need it; maps are linear
  /// without such points, for local lights, with several views, kernels in world units, sizes that follow the
  /// error, and fits other than tight or a history. Receivers that are not among the points get texels up to
  /// 16 times longer. `paraboloid` evens out the angles between a local light's texels, without a warp, with
  /// a tight fit, no history, and sizes that do not follow the error; directional lights have linear texels.
  /// nullptr counts as linear.
  const Shape* shape = &shapes::linear;
  /// The error that a warp must lower to be used.
  Objective objective = Objective::storage;
  /// World-space box whose error counts `focus_weight` times: a hero, a cockpit, a table top. Everything else
  /// stays in the map, with larger texels. An empty box, the default, means none.
  Box focus;
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
  /// map's texels are smallest, at most a quarter of the map. The wider of the two radii counts.
  double world = 0.0;
  /// Equal in all members.
  bool operator==(const FilterExtent&) const = default;
};

/// How often the cascades behind the first are planned. Between two plans of a cascade its map keeps its
/// matrix, with room for the motion in between, and needs no drawing: reuse() returns `identical`.
/// Needs a PlanHistory, a directional light and unmoved bounds. A cascade is planned at once where the camera
/// moved farther than promised, or its lens, the light or any option changed.
/// With more than one frame, cascades divide the camera's whole depths, by `practical` in place of
/// `automatic` and `optimal`, and visible depths and points are ignored.
struct CadenceOptions {
  /// Frames from one plan of a cascade to its next, 1..kMostCadenceFrames. 1, the default: every frame.
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
  /// lights only: a spot light has one map, a point light or a spot light of 85 degrees and more half angle
  /// up to six, the faces of a cube.
  int cascades = 4;
  /// How many texels each map gets.
  ResolutionOptions resolution;
  /// How a map's rectangle is fitted to its slice: tight for the smallest texels, stable against shimmering.
  Fit fit = Fit::tight;
  /// Where one cascade ends and the next begins.
  SplitOptions split;
  /// The perspective warp, and the error that it must lower.
  WarpOptions warp;
  /// How often the cascades behind the first are planned.
  CadenceOptions cadence;
  /// How far filter kernels reach.
  FilterExtent filter;
  /// How far depths are moved off the surface, in texels (bias.hpp).
  BiasOptions bias;
  /// Local lights: distance at which maps begin, over that of the farthest receiver, where the scene's boxes
  /// leave it open, as those of a room that holds its light do; kLeastLightNearShare..kMostLightNearShare.
  /// Nearer casters then cast no shadow; nearer boxes that do not hold the light are still shown. At 2^-13 a
  /// float's steps of depth are as long as texels at the far end, and such rooms have acne: 2^-10 keeps clear
  /// of that. Depths that are linear along the light work down to 2^-17 (docs/bias.md).
  double light_near_share = 0x1p-10;
  /// Clip space of the matrices in the plan.
  ClipSpace clip_space;
  /// Work that may be omitted: by default such that no pixel changes. PruneRules::all() adds the bounded
  /// rules of prune_rules.def: among others, maps shrink to the size that their error bound needs.
  PruneRules prune = default_prune_rules();
  /// Equal in all members.
  bool operator==(const PlanOptions&) const = default;
};

/// The shortest side that a texel budget gives: kSizeStep, or four filter radii.
[[nodiscard]] int least_budget_side(const PlanOptions& options) noexcept;

}  // namespace gnomon
