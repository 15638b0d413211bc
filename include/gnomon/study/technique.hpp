// Which technique to take: the cheapest that meets an error, or the one with the least error within a budget.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/plan.hpp"

namespace gnomon {

/// What a filter costs on some machine, and how it errs. Milliseconds are of the wall clock.
struct FilterCost {
  std::string_view name;
  double prefilter_ms_per_map = 0.0, prefilter_ms_per_megatexel = 0.0;
  double lookup_ms_per_megapixel = 0.0;  ///< of the frame
  double bytes_per_texel = 4.0;          ///< depth and stored texels together
  /// It makes as many wrong pixels in maps of error m as a filter with ratio and power 1 does in maps of
  /// error_ratio * m^error_power: a filter that smooths is better in coarse maps than in fine ones.
  double error_ratio = 1.0, error_power = 1.0;
};

/// What drawing a caster takes.
struct CasterWork {
  std::uint32_t triangles = 0;
  bool alpha_tested = false;  ///< holes cut by a texture: each texel that it covers is asked
};

/// What drawing the depths of a plan's maps takes, over all of them.
struct PlanWork {
  double maps = 0.0, megatexels = 0.0, kilodraws = 0.0, megatriangles = 0.0;
  /// A map's, times the share of alpha-tested triangles among all that it draws.
  double megatexels_tested = 0.0;
};

/// Milliseconds for each unit of PlanWork, and for the frame.
struct DrawingCosts {
  double per_frame = 0.0, per_map = 0.0, per_megatexel = 0.0, per_kilodraw = 0.0, per_megatriangle = 0.0;
  double per_megatexel_tested = 0.0;
};

/// What a frame's shadows cost on some machine: a sum over what is drawn. `gnomon calibrate` measures it.
struct CostModel {
  DrawingCosts drawing;
  std::span<const FilterCost> filters;  ///< to choose from, at least one
};

/// What is known of a scene beyond its bounds.
struct SceneDetail {
  /// Of bounds.casters, in their order; missing entries cost nothing.
  std::span<const CasterWork> work;
  /// Points that the camera sees: of a depth buffer read at every tenth pixel, or of rays
  /// (trace::seen_points). Some thousand do. Empty: anywhere in the receivers' boxes, which misjudges warps
  /// and splits where the boxes are mostly air.
  std::span<const glm::dvec3> seen_world;
  /// View depths at which the camera sees a surface, as make_plan takes them; nullptr: unknown.
  const VisibleDepths* visible_depths = nullptr;
};

/// Limits; 0 is none. Without target_error the least error within them is taken, or what is alike; with it
/// the cheapest technique that meets it: by milliseconds, or by texels where the cost model says all cost
/// nothing.
struct Budget {
  std::int64_t texels = 0, bytes = 0;
  double milliseconds = 0.0;
  double target_error = 0.0;  ///< Technique::error, screen pixels per texel
  /// Without target_error: errors above the least by no more than this share count as alike, and the cheapest
  /// of them is taken, >= 0. The default is about what the prediction is good to; less pays for errors that
  /// may be none.
  double alike = 0.1;
};

/// What is tried: the product of all lists. An empty list is the default named beside it.
struct TechniqueSet {
  std::span<const Warp* const> warps;        ///< none, lispsm, optimal
  std::span<const SplitScheme> splits;       ///< automatic
  std::span<const int> cascades;             ///< 1, 2, 3, 4; a light with a position has the maps it has
  std::span<const int> map_sizes;            ///< 256, 512, 1024, 2048, 4096
  static constexpr std::size_t kMost = 512;  ///< of warps x splits x cascades; what comes later is not tried
};

/// One technique with what it would cost and err.
struct Technique {
  const Warp* warp = nullptr;
  SplitScheme split = SplitScheme::automatic;
  int cascades = 0, map_size = 0;
  int filter = 0;  ///< index into CostModel::filters
  /// The mean of m over what is seen, screen pixels per texel, as it would have to be of a filter with
  /// error_ratio and error_power 1 to make as many wrong pixels.
  double error = 0.0;
  double milliseconds = 0.0;
  std::int64_t texels = 0, bytes = 0;
};

/// The choice and the trade it made.
struct TechniqueChoice {
  /// ok: plan and options are those of `chosen`. Otherwise what make_plan answered: there is nothing to
  /// choose.
  PlanStatus status = PlanStatus::invalid_input;
  std::string_view invalid_field;  ///< of make_plan, or "budget", "cost_model[.filters]", "map_sizes"
  bool met = false;                ///< false: nothing fits, `chosen` is the nearest to fitting
  Technique chosen;
  /// What a fifth less would have cost in error, and what a fifth less error would cost; map_size 0: there is
  /// none such. Limits other than the one traded do not bind them.
  Technique cheaper, better;
  int tried = 0;  ///< techniques that were priced
  PlanOptions options;
  ShadowPlan plan;
};

/// Plans each parametrization once, judges it (planned_error), and prices it at every size with every filter:
/// some 0.1 ms a parametrization. For when a scene, a view or a light is new, not for every frame. `base`
/// gives all options that are not chosen. Pure, allocates nothing, never throws.
[[nodiscard]] TechniqueChoice choose_technique(const Camera& camera, const Light& light,
                                               const SceneBounds& bounds, const SceneDetail& detail,
                                               const TechniqueSet& among, const Budget& budget,
                                               const CostModel& costs, const PlanOptions& base = {}) noexcept;

/// What choose_technique knows of a plan: the mean of m over what is seen, and what drawing takes.
[[nodiscard]] double planned_error(const ShadowPlan& plan, const Camera& camera, const SceneBounds& bounds,
                                   const SceneDetail& detail) noexcept;
[[nodiscard]] PlanWork planned_work(const ShadowPlan& plan, const SceneBounds& bounds,
                                    const SceneDetail& detail) noexcept;

}  // namespace gnomon
