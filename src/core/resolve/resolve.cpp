// Which options hold for this light, history and number of cameras, and which are ignored?
#include "resolve/resolve.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace gnomon {
namespace {

bool tight(Fit fit) noexcept {
  return fit == Fit::tight || fit == Fit::rotated;
}

/// Maps are as large as their error requires, or share a budget by it: it is reckoned for texels of one size.
bool sizes_follow_error(const ResolutionOptions& r) noexcept {
  return r.max_error > 0.0 || r.texel_budget > 0;
}

bool is_unwarped(const Warp* warp) noexcept {
  return warp == nullptr || warp == &warps::none;
}

/// The bound that maps shrink to: max_error, or prune_error where PruneRule::metric_resolution is on. 0 where
/// neither applies, or a grid must not change.
double error_bound(const PlanOptions& o) noexcept {
  const ResolutionOptions& r = o.resolution;
  if (!tight(o.fit)) return 0.0;
  const bool prunes = o.prune.has(PruneRule::metric_resolution);
  if (!(r.max_error > 0.0)) return prunes ? r.prune_error : 0.0;
  return std::max(prunes ? std::min(r.max_error, r.prune_error) : r.max_error, kLeastError);
}

/// The default warp goes with the shape that holds: with one that undoes the viewer's perspective along the
/// view, the whole of that perspective.
const Warp* warp_of(const PlanOptions& o) noexcept {
  if (o.fit == Fit::stable) return &warps::none;
  if (o.warp.warp != nullptr) return o.warp.warp;
  if (o.warp.shape->round != nullptr) return &warps::none;
  return undoes_warps(*o.warp.shape) ? &warps::psm : &warps::optimal;
}

/// Several views: a point has one view depth for each, but one place in the world.
void share(std::size_t views, Resolved& r) noexcept {
  SplitOptions& split = r.options.split;
  split.selection = MapSelection::finest;
  if (divides_parallel(split.partition)) {
    if (views > 1) r.of_plan.add(IgnoredOption::partition);
    split.partition = Partition::view_depth;
  }
  if (split.scheme == SplitScheme::optimal) split.scheme = SplitScheme::logarithmic;
}

/// Splits that do not follow what is in view.
void fix(SplitOptions& split) noexcept {
  if (split.range == SplitRange::receivers) split.range = SplitRange::automatic;
  if (split.scheme == SplitScheme::automatic || split.scheme == SplitScheme::optimal)
    split.scheme = SplitScheme::practical;
}

/// The same for a grid that stays, of schemes that can.
void steady(SplitOptions& split) noexcept {
  if (split.scheme == SplitScheme::automatic) split.scheme = SplitScheme::practical;
  if (split.scheme == SplitScheme::optimal) split.scheme = SplitScheme::logarithmic;
}

/// A stable grid takes no warp.
void drop_warp(Resolved& r) noexcept {
  if (!r.conduct.stable) return;
  if (!is_unwarped(r.options.warp.warp)) r.of_maps.add(OmissionKind::warp_in_stable_fit);
  r.options.warp.warp = nullptr;
}

/// Shapes are fitted to maps that are neither cached nor turned, and serve or round texels of one size.
bool shape_holds(const PlanCase& plan, const Resolved& r, bool local_light) noexcept {
  const PlanOptions& o = r.options;
  const Shape& shape = *o.warp.shape;
  if (shape.affine) return true;
  if (o.fit != Fit::tight || r.conduct.has_history) return false;
  if (undoes_warps(shape)) return true;
  if (sizes_follow_error(o.resolution)) return false;
  if (shape.round != nullptr) return local_light;
  return r.follows_points && plan.views <= 1 && o.filter.world == 0.0;
}

void drop_shape(const PlanCase& plan, bool local_light, Resolved& r) noexcept {
  if (r.options.warp.shape == nullptr) r.options.warp.shape = &shapes::linear;
  if (shape_holds(plan, r, local_light)) return;
  r.of_maps.add(IgnoredOption::shape);
  r.options.warp.shape = &shapes::linear;
}

void drop_planes(Resolved& r) noexcept {
  if (!r.options.warp.has_planes()) return;
  r.of_maps.add(IgnoredOption::planes);
  r.options.warp.planes = {};
}

void drop_selection(Resolved& r) noexcept {
  if (r.options.split.selection != MapSelection::finest) return;
  r.of_maps.add(IgnoredOption::selection);
  r.options.split.selection = MapSelection::view_depth;
}

void drop_overlap(Resolved& r) noexcept {
  if (!(r.options.split.overlap > 0.0)) return;
  r.of_maps.add(IgnoredOption::split_overlap);
  r.options.split.overlap = 0.0;
}

void drop_partition(Resolved& r) noexcept {
  r.of_maps.add(IgnoredOption::partition);
  r.options.split.partition = Partition::view_depth;
}

/// Parts follow the view in no steady way, and their maps have one size.
void drop_for_parts(const PlanCase& plan, Resolved& r) noexcept {
  SplitOptions& split = r.options.split;
  if (r.options.resolution.texel_budget > 0) r.of_maps.add(IgnoredOption::texel_budget);
  r.options.resolution.texel_budget = 0;
  // Cascades may take the place of any other parts, and have blend bands.
  const bool rivals = split.partition != Partition::frustum_faces && split.selection != MapSelection::finest;
  const double overlap = rivals ? split.overlap : 0.0;
  drop_selection(r);
  drop_overlap(r);
  split.overlap = overlap;
  if (plan.has_history) r.of_maps.add(IgnoredOption::history);
}

void resolve_parallel(const PlanCase& plan, Resolved& r) noexcept {
  PlanOptions& o = r.options;
  Conduct& how = r.conduct;
  const bool divides = divides_parallel(o.split.partition);
  r.parts = divides && !how.stable;
  if (r.counts_seen && o.split.scheme == SplitScheme::optimal) {
    r.of_maps.add(IgnoredOption::split_scheme);
    o.split.scheme = SplitScheme::automatic;
  }
  how.has_history = plan.has_history && !r.parts;
  how.caches_cascades = o.cadence.frames > 1 && how.has_history && !sizes_follow_error(o.resolution);
  if (how.caches_cascades) fix(o.split);
  r.follows_points = plan.has_points && !how.stable && !how.caches_maps && !how.caches_cascades && !divides;
  r.follows_depths = plan.has_depths && !plan.orthographic && o.split.range != SplitRange::camera;
  if (how.stable) steady(o.split);
  how.divides_reach = (how.stable || how.caches_cascades) && o.split.range == SplitRange::automatic;
  r.planes =
      o.warp.has_planes() && tight(o.fit) && !r.parts && plan.views <= 1 && o.resolution.texel_budget == 0;

  if (r.parts) drop_for_parts(plan, r);
  if (plan.has_points && !r.follows_points && !r.counts_seen) r.of_maps.add(IgnoredOption::visible_points);
  // A point takes the finest map, or beside planes the first that holds it, not two.
  if (o.split.selection == MapSelection::finest || r.planes) drop_overlap(r);
  if (how.stable && divides) {
    r.of_maps.add(OmissionKind::partition_in_stable_fit);
    o.split.partition = Partition::view_depth;
  }
  drop_warp(r);
  if (o.split.partition == Partition::tetrahedron) drop_partition(r);
  drop_shape(plan, false, r);
  if (!r.planes) drop_planes(r);
}

void resolve_local(const PlanCase& plan, Resolved& r) noexcept {
  SplitOptions& split = r.options.split;
  r.conduct.has_history = plan.has_history;
  r.tetrahedron = split.partition == Partition::tetrahedron && std::holds_alternative<PointLight>(plan.light);
  if (split.partition != Partition::view_depth && !r.tetrahedron) drop_partition(r);
  if (split.scheme != SplitScheme::automatic && split.scheme != SplitScheme::practical)
    r.of_maps.add(IgnoredOption::split_scheme);
  split.scheme = SplitScheme::automatic;
  drop_overlap(r);
  drop_planes(r);
  drop_selection(r);
  if (plan.has_depths) r.of_maps.add(IgnoredOption::visible_depths);
  drop_warp(r);
  drop_shape(plan, true, r);
  if (plan.has_points && !r.counts_seen) r.of_plan.add(IgnoredOption::visible_points);
}

bool chooses_warp(const PlanOptions& options) noexcept {
  return options.warp.warp != &warps::none;
}
bool splits_by_seen(const PlanOptions& options) noexcept {
  const SplitScheme scheme = options.split.scheme;
  return options.cascades > 1 && (scheme == SplitScheme::automatic || scheme == SplitScheme::optimal);
}

}  // namespace

Resolved resolve(const PlanOptions& options, const PlanCase& plan) noexcept {
  Resolved r;
  r.options = options;
  Conduct& how = r.conduct;
  how.stable = options.fit == Fit::stable;
  how.rotated = options.fit == Fit::rotated;
  how.caches_maps = options.fit == Fit::warped_stable;
  const bool parallel = std::holds_alternative<DirectionalLight>(plan.light);
  // Several views, and one that is planned as they are, divide by view depth alone.
  const bool divides = parallel && plan.views == 0 && divides_parallel(options.split.partition);
  r.counts_seen = options.warp.objective == Objective::picture && !how.stable && plan.views <= 1 &&
                  !divides && (chooses_warp(options) || (parallel && splits_by_seen(options)));
  if (options.warp.objective == Objective::picture && !r.counts_seen)
    r.options.warp.objective = Objective::storage;
  if (plan.views > 0) share(plan.views, r);
  if (parallel) {
    resolve_parallel(plan, r);
  } else {
    resolve_local(plan, r);
  }
  how.warp = warp_of(r.options);
  how.shape = r.options.warp.shape;
  // Parts that ignore a texel budget keep their size.
  const bool sized = how.has_history || options.resolution.texel_budget > 0;
  how.error_bound = sized ? 0.0 : error_bound(r.options);
  how.steady = how.has_history && tight(options.fit);
  r.square = !tight(options.fit) || how.has_history;
  if (options.cadence.frames > 1 && !how.caches_cascades) {
    r.of_plan.add(IgnoredOption::cadence);
    r.options.cadence = {};
  }
  return r;
}

PlanOptions resolve_lights(const PlanOptions& options, int side) noexcept {
  PlanOptions resolved = options;
  resolved.resolution.max_size = side;
  resolved.resolution.max_error = 0.0;
  resolved.resolution.texel_budget = 0;
  if (resolved.split.partition == Partition::tetrahedron) resolved.split.partition = Partition::view_depth;
  return resolved;
}

ResolvedPages resolve_pages(const PageOptions& asked) noexcept {
  // Pages have their own sizes, so that any number of texels serves.
  constexpr int kBaseTexels = 1024;
  ResolvedPages pages;
  pages.options = asked;
  const PlanOptions& options = asked.plan;
  const PagePolicy& policy = *asked.policy;
  if (policy.chooses) {
    if (asked.share < 1.0) pages.ignored.add(IgnoredOption::page_share);
    if (asked.reach_texels > 0.0) pages.ignored.add(IgnoredOption::page_reach);
    pages.options.share = PageOptions{}.share;
    pages.options.reach_texels = PageOptions{}.reach_texels;
  }
  const bool stable = options.fit == Fit::stable || policy.octaves;
  PlanOptions& o = pages.base;
  o.cascades = 1;
  o.resolution.max_size = kBaseTexels;
  o.fit = stable ? Fit::stable : Fit::tight;
  o.warp = options.warp;
  if (stable || o.warp.warp == nullptr) o.warp.warp = &warps::none;
  if (options.warp.has_planes()) pages.ignored.add(IgnoredOption::planes);
  o.warp.planes = {};
  // Levels are grids of even texels.
  if (options.warp.shape != nullptr && options.warp.shape != &shapes::linear)
    pages.ignored.add(IgnoredOption::shape);
  o.warp.shape = &shapes::linear;
  o.bias = options.bias;
  o.clip_space = options.clip_space;
  o.prune = options.prune.without(PruneRule::metric_resolution);
  // The coarsest page shows the whole base: casters in its border are among the base's.
  const double border = std::ceil(kBaseTexels * std::ceil(options.filter.texels) / asked.page_texels);
  o.filter.texels = std::min(0.25 * kBaseTexels, border);
  return pages;
}

}  // namespace gnomon
