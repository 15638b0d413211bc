// Which pages of very large virtual shadow maps are worth drawing? A page plan: levels, and the pages of each
// that visible points need.
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

#include "gnomon/measure.hpp"
#include "gnomon/plan.hpp"

namespace gnomon {

struct PageContext;

/// One entry of the registry page_policies.def: how fine the page of each visible point is.
struct PagePolicy {
  std::string_view name;     ///< as in files
  std::string_view summary;  ///< one line
  /// Levels differ by a factor of two and have square texels in world units, on a grid that does not follow
  /// the camera.
  bool octaves;
  /// Points that a finer page holds need no page of their own level.
  bool shares_finer;
  /// The policy chooses pages for all points together: PageOptions::share and reach_texels have no effect,
  /// and PagePlan::omitted says so.
  bool chooses = false;
  /// PageFeedback bits that the policy reads.
  std::uint8_t feedback;
  /// Sets the level of every point; internal.
  void (*assign)(PageContext& context) noexcept;
};

/// All policies, in the order of page_policies.def.
[[nodiscard]] std::span<const PagePolicy* const> all_page_policies() noexcept;
/// nullptr where there is none of that name.
[[nodiscard]] const PagePolicy* find_page_policy(std::string_view name) noexcept;

namespace page_policies {
#define GNOMON_PAGE_POLICY(name) extern const PagePolicy name;
#include "gnomon/page_policies.def"
#undef GNOMON_PAGE_POLICY
}  // namespace page_policies

/// Bits that a renderer reports of a visible point, for policies that read the rendered image.
enum PageFeedback : std::uint8_t {
  kShadowEdge = 1,     ///< a shadow edge lies at the point or next to it: `edges`, `picture`
  kShadowChanged = 2,  ///< the last refinement changed whether the point is lit: `queried`
  kDepthEdge = 4,      ///< view depths jump at the point or next to it: `tiled`
};

/// One resident page.
struct Page {
  std::uint32_t level = 0;           ///< index into PagePlan::levels
  std::int32_t column = 0, row = 0;  ///< of the level's virtual map, from ndc (-1, -1)
  std::uint32_t slot = 0;            ///< place in the pool, below PagePlan::capacity
  std::uint32_t points = 0;          ///< visible points that this page was opened for
};

struct PagePlan;

/// The report of the last frame's image, for policies that read it.
struct PageHistory {
  /// The plan that the last frame was drawn with; nullptr: the first frame. Read by `queried`. It must not
  /// lie in the memory of the new plan.
  const PagePlan* last = nullptr;
  /// PageFeedback bits of View::points_world, or empty: nothing was reported.
  std::span<const std::uint8_t> feedback = {};
};

/// Least and largest side of a page, and the pages that a plan may have at most.
inline constexpr int kLeastPageTexels = 64, kMaxPageTexels = 256, kMaxPages = 1 << 20;
/// Largest side of a level's virtual map, texels.
inline constexpr int kMaxVirtualTexels = 1 << 26;
/// Most levels of one plan: six faces, or one map, of 26 octaves in up to four steps each.
inline constexpr std::size_t kMaxPageLevels = 6 * (26 * 4 + 1);

/// Options of plan_pages. Every default suits most scenes.
struct PageOptions {
  /// The base of the levels is planned with it: one map of make_plan for each part of the light. `fit` stable
  /// gives levels whose texels and pages stay at the same place in the world under camera motion, so that
  /// pages can be cached. Any other fit one map round the visible receivers. `warp.warp` warps that base;
  /// none is the default here, as levels already follow the view. `filter` sets the border. resolution,
  /// split, cascades, cadence and `warp.shape` have no effect.
  PlanOptions plan{};
  const PagePolicy* policy = nullptr;  ///< nullptr: page_policies::resolution
  /// Texels along each side that a page serves: 64, 128 or 256. Smaller pages follow the visible surfaces
  /// more closely; each costs a draw and a border. A page takes page_texels + 2 border_texels along each
  /// side.
  int page_texels = 128;
  /// Pages that the pool holds, 1..kMaxPages. Fewer than the target needs: all levels coarsen evenly.
  int capacity = 4096;
  /// Aliasing error m_s and m_t (screen pixels per texel, along each side of a texel) that no visible point
  /// exceeds.
  double target_m = 1.0;
  /// Share of the visible points that must meet the target, in (0, 1]. Below 1, pages that few points need
  /// are left to a level of twice the texel size. That ends where the pool is full: every point has a page.
  double share = 1.0;
  /// Steps in which texels halve, 1..4. More steps waste fewer texels, and take more look-ups.
  int levels_per_octave = 3;
  /// Positions of the levels' sizes that are tried to find the fewest pages, 1..16. Costs as many times the
  /// time. Stable levels never move, and try none.
  int trials = 1;
  /// Largest side of a level, texels, page_texels..kMaxVirtualTexels: the deepest level is the last below.
  int virtual_texels = 1 << 22;
  /// Each point requests pages this many texels of its level round it, 0..page_texels: for points read at a
  /// stride, and cameras that move.
  double reach_texels = 0.0;
  /// Resident pages of the coarsest level at every place, so that surfaces without a visible point of their
  /// own keep a shadow. At most four pages for each map of the base.
  bool fallback = false;
  /// Sine of the angle between surface and light ray below which normals count as the half vector: no level
  /// resolves surfaces edge-on to the light. Only with normals.
  double least_light_sine = 0.05;
};

/// Bytes that plan_pages needs for a pool of this capacity and this many visible points. Without points, it
/// takes as many samples of the receivers' boxes as there is room for: some ten thousand suffice.
[[nodiscard]] std::size_t page_memory(int capacity, std::size_t points) noexcept;

/// Where a point lies on the base of a light's part: rows x and y over row w, each applied to (point, 1).
/// Pages of stable levels are counted from place 0.
struct PagePlaces {
  glm::dvec4 x{0.0}, y{0.0}, w{0.0};  ///< rows; the unit is that of SnapKey::texel
};

/// The result of plan_pages: levels and resident pages, in the caller's memory.
struct PagePlan {
  PlanStatus status = PlanStatus::invalid_input;  ///< whether there are pages, and why not
  std::string_view invalid_field;                 ///< for invalid_input: which, e.g. "pages.capacity"
  glm::dvec3 origin_world{0.0};  ///< what clip_from_camera_relative is relative to: the camera position
  glm::dvec3 light_direction{0.0, -1.0, 0.0};  ///< as ShadowPlan::light_direction
  ClipSpace clip_space;                        ///< of all matrices of the plan
  BiasOptions bias;                            ///< of the options
  const PagePolicy* policy = nullptr;          ///< never nullptr in a valid plan
  int page_texels = 0;                         ///< served along each side of a page
  int border_texels = 0;                       ///< round them, in the page's slot: holds the filter's kernel
  int capacity = 0;                            ///< of the pool
  /// Grids of whole virtual maps, coarsest first: width and height are those of the whole map, up to
  /// PageOptions::virtual_texels. Levels without a page are not listed.
  /// Stable levels have a valid snap_key: column and row 0 begin at texel x, y of the base.
  std::span<const ShadowMap> levels;
  std::array<PagePlaces, 6> places{};    ///< of the base, by ShadowMap::cascade of a level
  std::span<const Page> pages;           ///< resident pages, coarsest level first
  std::span<const std::uint32_t> table;  ///< hash table over the pages, see page_at; shaders read it as it is
  /// Error that the levels were chosen for: larger than requested where the pool is too small. Policy
  /// `picture` then has it in pages that weigh as much as the mean.
  double target_m = 0.0;
  std::uint64_t points = 0;                   ///< visible points that pages serve
  std::uint64_t points_outside = 0;           ///< that lie beside all receivers or the light's range: lit
  std::uint64_t points_coarser = 0;           ///< left to a coarser level by PageOptions::share
  std::uint64_t points_capped = 0;            ///< that the deepest level does not suffice for
  Records<Omission, kMaxOmissions> omission;  ///< the first omission_count are used
  int omission_count = 0;                     ///< may exceed kMaxOmissions

  /// Texels along each side of a page's slot.
  [[nodiscard]] int slot_texels() const noexcept { return page_texels + 2 * border_texels; }
  /// The omissions, at most kMaxOmissions.
  [[nodiscard]] std::span<const Omission> omitted() const noexcept {
    return {omission.data(),
            static_cast<std::size_t>(omission_count < kMaxOmissions ? omission_count : kMaxOmissions)};
  }
};

/// Chooses the pages that visible points need. Pure: the same input gives the same bits. Allocates nothing,
/// never throws; broken input comes back as PlanStatus::invalid_input with the field.
///
/// Without View::points_world the receivers' boxes are sampled as volumes, which needs five times the pages.
/// Without normals a point's surface faces the half vector of eye and light. View::depths are not read.
///
/// `memory`: at least page_memory(capacity, points) bytes, the caller's, and as long-lived as the plan.
///
/// A point is served by the page of the last level in the list that has one there (page_serving). Texels
/// halve from level to level along both axes together, so that a finer level is finer along both.
/// PageOptions::policy decides each point's level. Takes time in proportion to the points.
/// Based on: Lefohn, Sengupta, Owens, "Resolution-Matched Shadow Maps", 2007; Giegl, Wimmer, "Fitted Virtual
/// Shadow Maps", 2007. The levels' sizes between powers of two are this project's.
[[nodiscard]] PagePlan plan_pages(const View& view, const Light& light, const SceneBounds& bounds,
                                  const PageOptions& options, std::span<std::byte> memory,
                                  const PageHistory* history = nullptr) noexcept;

/// Index of the resident page at a column and row of a level, or -1.
[[nodiscard]] int page_at(const PagePlan& plan, std::uint32_t level, std::int32_t column,
                          std::int32_t row) noexcept;
/// Index of the page that serves a point, or -1: of the last level that has a resident page there.
[[nodiscard]] int page_serving(const PagePlan& plan, const glm::dvec3& point_world) noexcept;

/// A page as a map of its own, slot_texels along each side, with the border as filter_margin_texels. It
/// serves to draw it, read it, and cull its casters. Its cull planes hold every caster that its texels can
/// show. The matrix of a page of a stable level has the same bits in every plan of the same light and bounds.
[[nodiscard]] ShadowMap page_map(const PagePlan& plan, const Page& page) noexcept;

/// One slot of a pool that keeps pages from frame to frame. Plain data; as made, it holds nothing.
struct PageSlot {
  glm::dmat4 clip_from_world{0.0};  ///< of the page_map that was drawn into it
  int texels = 0;                   ///< along each side of the slot
  /// Count of the last keep_pages that used it; 0: it holds nothing. Aligned as on 64-bit processors.
  alignas(8) std::uint64_t used = 0;
  bool behind = false;  ///< a caster of `moving_world` reached it since its moving casters were last drawn
};
/// Where one page of a plan lies in a pool.
struct KeptPage {
  std::uint32_t slot = 0;  ///< of the pool, in place of Page::slot
  bool draw = true;        ///< false: the slot holds the page already
  bool compose = false;    ///< only its moving casters are to be drawn, over its static ones; `draw` is false
};
/// Counts of keep_pages.
struct KeptPages {
  bool fits = false;           ///< false: the pool or the memory is too small, and nothing was changed
  std::uint64_t kept = 0;      ///< pages that are not drawn
  std::uint64_t drawn = 0;     ///< pages to draw
  std::uint64_t composed = 0;  ///< pages of which moving casters alone are to be drawn
  std::uint64_t touched = 0;   ///< slots whose pages a caster of `moved_world` touched, resident or not
};
/// Entries of the table that keep_pages needs for a pool of this many slots.
[[nodiscard]] std::size_t page_table_size(int slots) noexcept;
/// Finds the pages of a plan that a pool still holds, and a slot for each of the others. Empty ones first,
/// then the least recently used. A page is kept where its matrix and size have the same bits and no moved
/// bounds reach it. Then a redraw would give the same texels. Pages that leave a plan stay in their slot
/// until it is needed. PlanOptions::fit stable, or policy clipmap, keeps pages while the camera moves.
///
/// `moved_world`: bounds of casters that changed since the last call, where they were and where they are.
/// `slots`: the pool, at least as many as pages. The caller's from call to call, and emptied where texels are
/// lost or the scene changes otherwise. `table`: working memory, page_table_size(slots.size()) entries.
/// `out`: one for each page of the plan. `moving_world`: the same bounds of casters that are drawn apart,
/// over a second copy of the page that holds the static casters alone. They empty no slot; the pages that
/// they reach are composed (KeptPage::compose), those outside of the plan once they come back. Allocates
/// nothing. Takes time in proportion to slots and moved bounds.
[[nodiscard]] KeptPages keep_pages(const PagePlan& plan, std::span<const Box> moved_world,
                                   std::span<PageSlot> slots, std::span<std::uint32_t> table,
                                   std::span<KeptPage> out, std::span<const Box> moving_world = {}) noexcept;

/// The decision of hold_sun.
struct HeldSun {
  glm::dvec3 direction{0.0};  ///< to plan with: the held one, or the sun's own, with the bits of the argument
  /// Largest error of the points read before the decision, screen pixels. Where the sun is held, it holds for
  /// all points that are not capped.
  double error_pixels = 0.0;
  double turned_pixels = 0.0;       ///< error of the point that turned it, above the bound; 0: none did
  std::uint64_t points_capped = 0;  ///< read, but not evaluated: least_light_sine
};
/// Keeps the direction of a sun that turns until a shadow edge could lie more than `most_pixels` from its
/// true place. Then takes the sun's own. Pages of stable levels keep their bits under a held direction; a
/// turn draws all of them. A point's error is how far the shadow of the farthest place in `casters` along its
/// light ray moves. It moves on the plane of the point's surface, as the camera sees it. Nearer casters err
/// less.
///
/// `held`: the direction of the last frame; any without length, or at a right angle or more to `sun`, gives
/// `sun`. `casters`: bounds of all casters; broken ones do not hold. Points without normals count as surfaces
/// that face the half vector. Without points it does not hold, as nothing bounds the error.
/// `most_pixels`: 0 never holds, larger holds longer; a quarter is below what a texel of m = 1 can show.
/// `least_light_sine`: as PageOptions::least_light_sine; edges on surfaces that the light grazes more are not
/// bounded. Penumbrae that a filter widens count as the edge. Allocates nothing; takes time in proportion to
/// the points.
[[nodiscard]] HeldSun hold_sun(const View& view, const glm::dvec3& held, const glm::dvec3& sun,
                               const Box& casters, double most_pixels = 0.25,
                               double least_light_sine = 0.05) noexcept;

/// The error over the points that a page plan serves.
struct PageStats {
  AliasingStats m;                ///< of m_max; storage is that of the pages, borders included
  double worst_side = 0.0;        ///< largest m_s or m_t
  double p95_side = 0.0;          ///< error that 95 % of the points stay below, of the larger of m_s and m_t
  double texels_per_pixel = 0.0;  ///< pages, without borders, over the pixels of the camera
  double border_share = 0.0;      ///< texels of borders over those of pages without them
};
/// The error in the pages that serve what the view sees, as of a ShadowPlan. With normals at their surfaces;
/// points that face away are not counted. MeasureOptions::map is not read. Allocates nothing; plans without
/// pages give zeros.
[[nodiscard]] PageStats measure(const PagePlan& plan, const View& view, const SceneBounds& bounds,
                                const MeasureOptions& options = {}) noexcept;

}  // namespace gnomon
