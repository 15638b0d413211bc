// Which technique to take: the cheapest that meets an error, or the one with the least error within a budget.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/study/expected_error.hpp"

namespace gnomon {

/// Cost of a filter on some machine, and its error. Milliseconds are of the wall clock.
struct FilterCost {
  std::string_view name;                                                ///< as the caller knows the filter
  double prefilter_ms_per_map = 0.0, prefilter_ms_per_megatexel = 0.0;  ///< of stored texels
  double lookup_ms_per_megapixel = 0.0;                                 ///< of the frame
  double bytes_per_texel = 4.0;                                         ///< depth and stored texels together
  /// Where a share e of the pixels is expected to be misclassified with the kernel (expected_error), the
  /// filter misclassifies error_ratio * e^error_power.
  double error_ratio = 1.0, error_power = 1.0;
  /// Half side of the box of texels whose comparisons the filter averages, 0..kMaxKernelTexels; 0: it takes
  /// one texel.
  double kernel_texels = 0.0;
  /// PlanOptions::filter of the filter's plans, in place of that of the base or of PageSet::options. At most
  /// a quarter of the map, or of the texels that a page serves.
  FilterExtent extent = {};
};
/// Filters of a CostModel have at most so many different kernels: each costs another look at every plan.
inline constexpr std::size_t kMaxKernels = 8;

/// Work of drawing a caster.
struct CasterWork {
  std::uint32_t triangles = 0;  ///< of the caster
  bool alpha_tested = false;    ///< holes cut by a texture, which is read at every covered texel
  double area_world = 0.0;      ///< of its triangles, square world units; 0: as if they covered its box once
};

/// Work of drawing the depths of all maps, or pages, of a plan.
struct PlanWork {
  double maps = 0.0, megatexels = 0.0;          ///< counts, in the unit of their name; a page counts as a map
  double kilodraws = 0.0, megatriangles = 0.0;  ///< likewise
  /// Texels that casters cover, each as often as it is covered. Half of a caster's area faces across the
  /// light in the mean over all directions. Alpha-tested casters count apart.
  double megatexels_tested = 0.0, megatexels_covered = 0.0;
};

/// Milliseconds for each unit of PlanWork, and for the frame.
struct DrawingCosts {
  double per_frame = 0.0, per_map = 0.0, per_megatexel = 0.0;      ///< milliseconds
  double per_kilodraw = 0.0, per_megatriangle = 0.0;               ///< milliseconds
  double per_megatexel_tested = 0.0, per_megatexel_covered = 0.0;  ///< milliseconds
};

/// Costs of the techniques of one kind: maps, or pages.
struct TechniqueCosts {
  DrawingCosts drawing;                      ///< of their depths
  std::span<const FilterCost> filters = {};  ///< to choose from
};

/// Cost of a frame's shadows on some machine: a sum over the drawn work. `gnomon calibrate` measures it. The
/// costs themselves are those of maps, with at least one filter.
struct CostModel : TechniqueCosts {
  TechniqueCosts pages = {};  ///< with at least one filter where TechniqueSet::pages has any
};

/// Limits; 0 is none. Without target_error the least error within them is taken, or what is alike. With it
/// the cheapest technique that meets it is taken: by milliseconds, or by texels where all cost nothing by the
/// cost model.
struct Budget {
  std::int64_t texels = 0, bytes = 0;  ///< of all maps
  double milliseconds = 0.0;           ///< per frame
  double target_error = 0.0;           ///< Technique::error, in [0,1]
  /// Without target_error: errors above the least by no more than this share count as alike, and the cheapest
  /// of them is taken, >= 0. The default is about what the prediction is good to; less pays for errors that
  /// may be none.
  double alike = 0.1;
};

/// Page plans among the candidates, each with every filter of CostModel::pages.
struct PageSet {
  std::span<const PageOptions> options = {};  ///< candidates; none: maps alone
  /// Points of visible surfaces, as View::points_world. Maps are planned without them.
  std::span<const glm::dvec3> points_world = {};
  std::span<const std::uint8_t> feedback = {};  ///< on the points, as PageHistory::feedback
  /// The caller's, as long-lived as TechniqueChoice::pages: as many bytes as the largest of the options needs
  /// by page_memory.
  std::span<std::byte> memory = {};
};

/// Candidates: the product of all lists, and the pages. An empty list is the default named beside it.
struct TechniqueSet {
  std::span<const Warp* const> warps;   ///< none, lispsm, optimal
  std::span<const SplitScheme> splits;  ///< automatic
  std::span<const int> cascades;        ///< 1, 2, 3, 4; local lights ignore it
  std::span<const int> map_sizes;       ///< 256, 512, 1024, 2048, 4096
  PageSet pages = {};                   ///< beside that product
  /// Plans, pages first; what comes later is not tried. Filters of the same FilterCost::extent share them.
  static constexpr std::size_t kMost = 512;
};

/// One technique with what it would cost and err.
struct Technique {
  const Warp* warp = nullptr;                  ///< nullptr where there is none such
  SplitScheme split = SplitScheme::automatic;  ///< of the cascades
  int cascades = 0, map_size = 0;              ///< maps; texels along each side, of pages their slots
  int pages = -1;                              ///< index into PageSet::options; -1: maps
  int filter = 0;                      ///< index into the filters of its kind: CostModel, or its pages
  double error = 0.0;                  ///< share of the picture's pixels that it is to misclassify, in [0,1]
  double milliseconds = 0.0;           ///< predicted, per frame
  std::int64_t texels = 0, bytes = 0;  ///< of all maps, or resident pages
};

/// The choice and the trade it made.
struct TechniqueChoice {
  /// ok: plan and options are those of `chosen`. Otherwise the status of make_plan or plan_pages: there is
  /// nothing to choose.
  PlanStatus status = PlanStatus::invalid_input;
  /// That of make_plan or plan_pages, or "budget", "cost_model[.filters, .pages.filters]",
  /// "map_sizes", "shadow".
  std::string_view invalid_field;
  bool met = false;  ///< false: nothing fits, `chosen` is the nearest to fitting
  Technique chosen;  ///< map_size 0 where status is not ok
  /// Marginal trade-offs: the best choice at 80 % of the cost, and at 80 % of the error; map_size 0: there is
  /// none. Limits other than the traded one do not bind them.
  Technique cheaper, better;
  int tried = 0;        ///< techniques that were compared
  PlanOptions options;  ///< that make the plan; of pages those of PageOptions::plan
  ShadowPlan plan;      ///< the maps to draw; none where pages are chosen
  PagePlan pages;       ///< the pages to draw, in PageSet::memory; none where maps are chosen
};

/// Plans each technique, counts the pixels that its texels misclassify in `shadow` (expected_error), and
/// estimates its cost with every filter. For 320 x 180 pixels that takes some ten milliseconds a plan. So
/// call it when a scene, a view or a light is new, not in every frame. Pure, allocates nothing, never throws.
///
/// `shadow`: of the last frame or of rays, and of the same view. Without its occluders it should be as fine
/// as the texels. A large picture takes no longer: at most 65 536 of its pixels are counted, spread evenly.
/// `base` gives all options that are neither chosen nor a filter's. `casters`: one entry per box of
/// bounds.casters, in their order; missing ones cost nothing.
[[nodiscard]] TechniqueChoice choose_technique(const View& view, const ShadowPicture& shadow,
                                               const Light& light, const SceneBounds& bounds,
                                               std::span<const CasterWork> casters, const TechniqueSet& among,
                                               const Budget& budget, const CostModel& costs,
                                               const PlanOptions& base = {}) noexcept;

/// Milliseconds of drawing maps, filtering them, and looking up so many million pixels.
[[nodiscard]] double predicted_ms(const DrawingCosts& costs, const FilterCost& filter, const PlanWork& work,
                                  double megapixels) noexcept;

/// `every` of expected_error by which choose_technique counts a picture: at most 65 536 of its pixels.
[[nodiscard]] int pixels_between(const ShadowPicture& shadow) noexcept;

/// The work of drawing the plan's maps.
[[nodiscard]] PlanWork planned_work(const ShadowPlan& plan, const SceneBounds& bounds,
                                    std::span<const CasterWork> casters) noexcept;
/// The work of drawing the plan's pages.
[[nodiscard]] PlanWork planned_work(const PagePlan& plan, const SceneBounds& bounds,
                                    std::span<const CasterWork> casters) noexcept;

}  // namespace gnomon
