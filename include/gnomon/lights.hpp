// How do many lights share one pool of texels, and which of them can light a pixel? Sizes, rectangles and a
// refresh interval for each light's maps; lists of lights for tiles of the image, parted along view depth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "gnomon/atlas.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/view.hpp"

namespace gnomon {

/// Most lights of one plan.
inline constexpr std::size_t kMaxLights = 4096;
/// LightOptions::texel_budget for all texels of the pool.
inline constexpr std::int64_t kWholePool = INT64_MAX;  // no max(): a macro of windows.h

/// One light of plan_lights.
struct LightRequest {
  Light light;          ///< directional, spot or point
  double weight = 1.0;  ///< counts its error so many times, >= 0: brightness, or what a player looks at
  /// Its casters moved, or its maps are lost: they are due in this frame. A light that moved itself is
  /// noticed.
  bool changed = false;
  /// Work of drawing all its maps once, >= 0, as far as known: LightOptions::millisecond_budget counts it.
  double draws = 0.0, triangles = 0.0;
};

/// Costs of drawing maps on one machine, milliseconds, all >= 0: DrawingCosts of study/technique.hpp,
/// which `gnomon calibrate` measures.
struct LightCosts {
  double per_map = 0.0, per_megatexel = 0.0;          ///< of maps, by their number and size
  double per_kilodraw = 0.0, per_megatriangle = 0.0;  ///< of LightRequest::draws and triangles
  /// Equal in all members.
  bool operator==(const LightCosts&) const = default;
};

/// Options of plan_lights. Every default suits most scenes.
struct LightOptions {
  /// The plans of all lights are made with it (light_options). Sizes, errors and budgets of resolution are
  /// not read.
  PlanOptions plan{};
  /// Texels of the pool's sides, multiples of most_size, up to 2^16.
  int pool_width = 4096, pool_height = 4096;
  /// Most texels that all maps may have together, at least 1. More than the pool has: the pool.
  std::int64_t texel_budget = kWholePool;
  /// Most pages that all maps may cover together, >= 0; 0: no such budget. With one, maps have at least
  /// page_texels along each side, so that none shares a page.
  int page_budget = 0;
  int page_texels = 128;  ///< side of a page, a power of two up to most_size; read with a page_budget alone
  /// Most milliseconds per frame that drawing the maps may take by `costs`, >= 0; 0: no such budget. Counted
  /// in the mean over frames: maps of a light that is due every n-th frame cost an n-th. Frames with new or
  /// moved lights cost more (LightPlan::due_milliseconds).
  double millisecond_budget = 0.0;
  LightCosts costs{};  ///< of millisecond_budget; LightPlan has the sums in any case
  /// Side of the smallest maps, texels, a power of two up to most_size. Smaller ones only where the budget
  /// does not suffice for all lights: never below least_budget_side, rounded up to a power of two.
  int least_size = 64;
  /// Side of the largest maps, texels, a power of two up to kMaxMapSize.
  int most_size = 1024;
  /// Error m (screen pixels per texel, mean over what the light lights) that suffices, >= 0. Maps of a light
  /// that has it are not enlarged beyond least_size. 0: none, the budget is used up.
  double enough_m = 0.0;
  /// Most frames from one drawing of a light's maps to the next, 1..kMaxCadenceFrames.
  int most_frames = 8;
  /// Share of the picture from which on a light is refreshed every frame, in (0, 1]. Each halving below
  /// doubles the frames in between, up to most_frames.
  double full_share = 1.0 / 64.0;
  /// With a history: factor by which a light's last size is favoured, >= 1. Larger: sizes change less often.
  double keep_gain = 1.5;
  /// Equal in all members.
  bool operator==(const LightOptions&) const = default;
};

/// The outcome for one light.
enum class LightOutcome : std::uint8_t {
  mapped,            ///< it has maps of at least LightOptions::least_size
  below_least_size,  ///< it has smaller maps: the budget does not suffice for all lights
  without_receiver,  ///< no map: it lights no receiver in view
  without_caster,    ///< no map: nothing within its range casts shadows
};

/// The maps of one light in the pool.
struct LightMaps {
  LightOutcome outcome = LightOutcome::without_receiver;  ///< why there are maps, or none
  /// Texels along each side of each map; 0: none. PlanOptions::resolution.max_size of the light's own plan.
  int size = 0;
  /// Maps that have a place: cascades of a sun, one for a spot, up to six faces. The light's plan has no
  /// more.
  int map_count = 0;
  /// Places of the maps in the pool, by index of the map in the light's plan; map_count are used.
  std::array<TexelRect, kMaxMaps> place{};
  /// Part of the picture that the light may light, in [0, 1]: of the visible points, or of rays through the
  /// receivers' boxes.
  double share = 0.0;
  /// Mean of m over that part at this size, screen pixels per texel.
  double m = 0.0;
  int frames = 1;    ///< from one drawing to the next, a power of two unless it is LightOptions::most_frames
  bool due = false;  ///< plan and draw its maps in this frame
};
/// Writes "what" and "why" of the outcome as two lines of English; no heap.
[[nodiscard]] OmissionText describe(const LightMaps& maps, const LightOptions& options) noexcept;

/// State that plan_lights keeps of one light. Plain data; as made, it remembers nothing.
struct LightState {
  Light light;                                  ///< of the frame in which its maps were drawn
  std::int64_t frame = -1;                      ///< that frame; -1: it has no maps
  int size = 0, map_count = 0;                  ///< as LightMaps
  std::array<std::uint32_t, kMaxMaps> place{};  ///< in the pool, in squares of the smallest size
};
/// State of plan_lights from frame to frame. Keep one per pool and camera.
struct LightHistory {
  /// The caller's, one for each light, in the order of the lights. Move them along with the lights where that
  /// order changes.
  std::span<LightState> lights;
  std::int64_t frame = 0;  ///< of the next plan
  LightOptions options;    ///< of the last plan: under another pool or other sizes, all places are new
  int least_side = 0;      ///< of the last plan, texels: what places are counted in
};

/// Bytes that plan_lights needs for this many lights and visible points.
[[nodiscard]] std::size_t light_memory(std::size_t lights, std::size_t points) noexcept;

/// The result of plan_lights; its list lies in the caller's memory.
struct LightPlan {
  PlanStatus status = PlanStatus::invalid_input;  ///< whether there are maps, and why not
  std::string_view invalid_field;                 ///< for invalid_input: which, e.g. "lights.most_size"
  int invalid_light = -1;                         ///< index of the light that it is about; -1: of none
  std::span<const LightMaps> lights;              ///< in the order of the requests; empty for invalid_input
  int pool_width = 0, pool_height = 0;            ///< texels
  std::int64_t texels = 0;                        ///< of all maps
  std::int64_t due_texels = 0;                    ///< of the maps that are due
  std::int64_t pages = 0;                         ///< of all maps; 0 without LightOptions::page_budget
  double milliseconds = 0.0;                      ///< by LightOptions::costs, per frame in the mean
  double due_milliseconds = 0.0;                  ///< the same, of what is due in this frame
  int mapped = 0;                                 ///< lights that have maps
  int due = 0;                                    ///< of them, to be planned and drawn in this frame
  /// The sum over the lights of weight * share * m: what the sizes minimise.
  double error = 0.0;
  /// True where free texels were too scattered for a larger map, so that all maps were placed again.
  bool repacked = false;
};

/// Distributes the texels of one pool among lights. Pure: the same input gives the same bits. Allocates
/// nothing, never throws; broken input, no light too many among it, comes back as PlanStatus::invalid_input.
///
/// The error of a light is the mean of m over the part of the picture that it may light, as measure() takes
/// it. m is a texel's extent over a pixel's. It is that of a map of the whole cone or face, and falls as one
/// over the size. A sun's is that of make_plan with LightOptions::plan. Sizes are powers of two and minimise
/// the sum of weight * share * m. Step by step, that light is enlarged whose error falls most per texel.
/// Every light in view that has casters gets maps; other lights are listed with the reason.
///
/// Maps are placed as in a quadtree, so that any sizes within the budget fit. With a history, sizes and
/// places change only where that pays, and only some lights are due. Those with a large share are due
/// every frame, small ones every n-th, a new, moved or changed one at once. Draw all that are due; the
/// history counts them as drawn.
///
/// Budgets of texels, pages and milliseconds hold together. Where milliseconds decide, that light is enlarged
/// whose error falls most per millisecond. A budget in which not even the smallest maps of all lights fit is
/// refused.
///
/// A due light is planned by make_plan with light_options and the view with its points, or with
/// camera_round for a light of several frames. Its maps must serve what later frames see.
///
/// With View::points_world, shares and errors are those of these points; without, rays are sampled through
/// the receivers' boxes. Takes time in proportion to lights times points, and to lights times boxes where
/// these are lists (CasterSet: hardly any). View::depths and normals are not read.
///
/// `memory`: at least light_memory(lights, points) bytes, the caller's, and as long-lived as the plan.
///
/// Based on: Everett, "Generalized Lagrange Multiplier Method for Solving Problems of Optimum Allocation of
/// Resources", 1963 (steps by gain per cost). Samet, "The Quadtree and Related Hierarchical Data Structures",
/// 1984 (places).
[[nodiscard]] LightPlan plan_lights(const View& view, std::span<const LightRequest> lights,
                                    const SceneBounds& bounds, const LightOptions& options,
                                    std::span<std::byte> memory, LightHistory* history = nullptr) noexcept;

/// PlanOptions for the plan of one light of a LightPlan: maps of its size, without a budget of their own. A
/// point light has the faces of a cube, also with Partition::tetrahedron.
[[nodiscard]] PlanOptions light_options(const LightOptions& options, const LightMaps& maps) noexcept;

/// A camera that sees all that a spot or point light can light. A plan for it does not follow the viewer, so
/// that its maps serve any later frame; take its matrices rebased() to the eye. Its errors are not the
/// viewer's. For a directional light: `camera` itself.
[[nodiscard]] Camera camera_round(const Light& light, const Camera& camera) noexcept;

/// The pool as an atlas of one light's maps, for atlas_from_clip: its maps have their places, others none.
[[nodiscard]] Atlas light_atlas(const LightPlan& plan, std::size_t light) noexcept;

/// Most slices of ClusterOptions.
inline constexpr int kMaxDepthSlices = 256;
/// Most clusters of an image: with more, tiles are taken twice as wide.
inline constexpr std::size_t kMaxClusters = std::size_t{1} << 22;

/// Options of cluster_lights.
struct ClusterOptions {
  int tile_pixels = 64;   ///< side of a tile, pixels, at least 1. Smaller: shorter lists, more of them
  int depth_slices = 48;  ///< parts of the view depth, 1..kMaxDepthSlices. More: shorter lists
  /// Equal in all members.
  bool operator==(const ClusterOptions&) const = default;
};

/// One light in one cluster. Working memory of cluster_lights.
struct ClusterEntry {
  std::uint32_t cluster;  ///< index of the cluster
  std::uint32_t light;    ///< index of the light
};

/// Memory that cluster_lights writes to; the caller's. `begin` and `lights` are as long-lived as the result.
struct ClusterMemory {
  std::span<std::uint32_t> begin;   ///< at least cluster_count() + 1
  std::span<std::uint32_t> lights;  ///< at least as many as lights. More: finer clusters, if they need it
  std::span<ClusterEntry> work;     ///< at least as many as lights; entries up to the shorter one are used
};

/// The lists of cluster_lights.
struct LightClusters {
  PlanStatus status = PlanStatus::invalid_input;  ///< ok, or invalid_input
  std::string_view invalid_field;                 ///< for invalid_input: which, e.g. "clusters.tile_pixels"
  int columns = 0, rows = 0, slices = 0;          ///< clusters along the image's sides and along depth
  int tile_pixels = 0;  ///< of these clusters: larger than the option where the memory holds no finer ones
  /// Slice of a surface: floor(depth_scale * log2(view depth) + depth_offset), of the view depth itself for
  /// an orthographic camera, clamped to 0..slices - 1.
  double depth_scale = 0.0;
  double depth_offset = 0.0;  ///< see depth_scale
  bool orthographic = false;  ///< of the camera
  /// Cluster (column, row, slice) has the lights lights[begin[i]] .. lights[begin[i + 1] - 1] in ascending
  /// order; i = (slice * rows + row) * columns + column. Row 0 is the lowest of the image.
  std::span<const std::uint32_t> begin;
  std::span<const std::uint32_t> lights;  ///< indices into the lights of the call
};

/// Clusters of an image with these options, before any of them is widened. 0 for options or sizes out of
/// range.
[[nodiscard]] std::size_t cluster_count(const Camera& camera, const ClusterOptions& options) noexcept;

/// Lists the lights that can light a surface in each cluster of the view. Pure, allocates nothing, never
/// throws.
///
/// A light is missing from a cluster only where its range, or its cone, does not reach into it. Shading by
/// the lists gives the same light as shading by all lights, as long as a light is zero beyond its range and
/// cone. Suns are in every list. A light whose range is zero or less lights nothing.
///
/// Lists have any length. Where the memory does not hold all of them, tiles become twice as wide and slices
/// half as many until it does. A single cluster of all lights always fits.
///
/// Slices are even in the logarithm of depth, over the last thousandfold of the depths that local lights
/// reach (orthographic: even in depth). The last one holds everything beyond.
///
/// Based on: Olsson, Billeter, Assarsson, "Clustered Deferred and Forward Shading", 2012.
[[nodiscard]] LightClusters cluster_lights(const Camera& camera, std::span<const Light> lights,
                                           const ClusterOptions& options,
                                           const ClusterMemory& memory) noexcept;

/// Index of the cluster of a pixel, counted from the lower left corner, at a view depth. Both are clamped to
/// the clusters. `clusters` must be of status ok.
[[nodiscard]] std::size_t cluster_at(const LightClusters& clusters, int pixel_x, int pixel_y,
                                     double view_depth) noexcept;

}  // namespace gnomon
