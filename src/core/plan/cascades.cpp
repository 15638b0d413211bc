// The maps of parallel light along the view.
// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010 (bounds of a partition's
// samples in light space).
#include "plan/cascades.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/body.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/motion.hpp"
#include "map/shared_views.hpp"
#include "plan/cadence.hpp"
#include "plan/receiver_planes.hpp"

namespace gnomon {
namespace {

// Callers read some pixels of many: surfaces go on up to the next one read, which may be so many pixels away.
constexpr double kPixelsBetween = 16.0;

/// Whether a cut of the scene's body at `begin` takes anything off it: not what is rounding of depths.
bool cuts_front(const ParallelScene& scene, double begin) noexcept {
  constexpr double kRounding = 1e-14;
  return begin - scene.depths.begin > kRounding * max_of(begin, scene.depths.end - begin);
}

/// The part of the scene's body between two depths that holds receivers: the body itself, or `part`.
const Polytope& receivers_between(const PlanContext& c, const ParallelScene& scene, double begin, double end,
                                  Polytope& part) noexcept {
  if (cut_from_afar(c, scene.depths.end, end)) {
    const double from = max_of(begin, scene.depths.begin);
    part = frustum_slice(c.camera, c.axes, min_of(from, end), end);
    if (from > end) part.vertex_count = 0;
    clip(part, visible_bounds(part, c.bounds.receivers, c.camera.position));
    return part;
  }
  const bool whole = !cuts_front(scene, begin) && !(end < scene.depths.end);
  if (whole && !several(c.bounds.receivers)) return scene.body;
  part = scene.body;
  if (!whole) clip_to_slab(part, c.axes.forward, begin, end);
  clip_part(part, c.bounds.receivers, c.camera.position);
  return part;
}

/// The receivers of one cascade, and the depths that its map serves.
struct Slice {
  Polytope own;  // storage of the body, where it is not the scene's
  const Polytope* body = &own;
  double begin = 0.0, end = 0.0;  // without the blend band
  double overlap = 0.0;
  double room = 0.0;  // for motion, world units
  bool wanted = false;
  ViewedPoints* viewed = nullptr;  // of several cameras: what they see

  Slice() noexcept = default;
  Slice(const Slice&) = delete;
  Slice& operator=(const Slice&) = delete;
};

/// The receivers between two depths, of all cameras, whose error counts from the depth `counted_from` on.
void fill_body(const PlanContext& c, const ParallelScene& scene, double begin, double end,
               double counted_from, Slice& slice) noexcept {
  slice.body = &slice.own;
  if (slice.room > 0.0) {
    slice.own = receivers_with_room(c, begin, end, slice.room);
    return;
  }
  if (c.views.empty()) {
    slice.body = &receivers_between(c, scene, begin, end, slice.own);
    return;
  }
  *slice.viewed = viewed_between(c, begin, end, counted_from, slice.own);
}

/// All that the cameras' frusta hold between two depths, where no receiver is. Out of line: other slices need
/// not make room for the frusta.
[[gnu::noinline]] void fill_with_frusta(const PlanContext& c, double begin, double end,
                                        Slice& slice) noexcept {
  slice.body = &slice.own;
  if (c.views.empty()) {
    slice.own = frustum_slice(c.camera, c.axes, begin, end);
    return;
  }
  std::array<Polytope, kMaxViews> frusta;
  for (std::size_t i = 0; i < c.views.size(); ++i) frusta[i] = view_slice(c.views[i], begin, end);
  slice.own = hull_of({frusta.data(), c.views.size()});
}

/// Depths in front of `begin` that a cascade shows besides its own: none where the one before it ends sooner.
double overlap_before(const PlanContext& c, const ShadowPlan& plan, double begin) noexcept {
  if (plan.map_count == 0) return 0.0;
  const ShadowMap& before = plan.map[static_cast<std::size_t>(plan.map_count - 1)];
  return before.depth_end == begin ? c.options.split.overlap * (begin - before.depth_begin) : 0.0;
}

/// [from, to]: the depths between the neighbouring cascades.
[[gnu::noinline]] void slice_between(const PlanContext& c, const ParallelScene& scene, const ShadowPlan& plan,
                                     double from, double to, Slice& slice) noexcept {
  const DepthRange visible =
      c.visible_depths == nullptr ? DepthRange{from, to} : visible_range(*c.visible_depths, from, to);
  // A single depth is a slice only where it is all there is.
  const bool covered = from == to && plan.map_count > 0;
  const double pseudo_near = c.options.split.pseudo_near;
  if (!visible.empty() && !covered) fill_body(c, scene, visible.begin, visible.end, pseudo_near, slice);
  const bool holds_nothing = slice.body->empty();
  slice.wanted = !holds_nothing || (!c.options.prune.has(PruneRule::empty_cascades) && from < to);
  if (!slice.wanted) return;
  slice.begin = holds_nothing ? from : visible.begin;
  slice.end = holds_nothing ? to : visible.end;
  slice.overlap = overlap_before(c, plan, slice.begin);
  if (holds_nothing) {
    fill_with_frusta(c, slice.begin - slice.overlap, slice.end, slice);
  } else if (slice.overlap > 0.0) {
    fill_body(c, scene, slice.begin - slice.overlap, slice.end, max_of(pseudo_near, slice.begin), slice);
  }
  if (c.visible_points.empty()) return;
  if (slice.body != &slice.own) slice.own = *slice.body;
  slice.body = &slice.own;
  clip_to_points(c, scene.space.frame, slice.begin - slice.overlap, slice.end, slice.own);
}

/// Adds a map of an earlier frame, for this frame's eye.
void add_cached(const PlanContext& c, const PlanHistory::KeptMap& cached, PlanHistory& history,
                ShadowPlan& plan) noexcept {
  if (!cached.drawn) {
    omit(plan, {OmissionKind::cascade_without_caster, cached.map.cascade, cached.map.depth_begin,
                cached.map.depth_end, texels_asked(c.options)});
    return;
  }
  const ShadowMap& map = plan.map[static_cast<std::size_t>(plan.map_count++)] =
      rebased(cached.map, c.camera.position);
  PlanHistory::Map& last = history.map[static_cast<std::size_t>(map.cascade)];
  last = {history.frame, cached.gl_from_world,     map.width,
          map.height,    map.filter_margin_texels, last.searched};
}

/// What later frames may take up.
PlanHistory::KeptMap cascade_to_cache(const PlanContext& c, const MapResult& result,
                                      std::int64_t frame) noexcept {
  return {frame, result.drawn, result.map, result.gl_from_world, c.camera};
}

void fit_cascade(const PlanContext& c, const MapRequest& request, MapResult& result) noexcept {
  if (c.how.stable) {
    stable_map(c, request, result);
  } else {
    focused_map(c, request, result);
  }
}

/// A cascade that is cached while the camera moves serves what will be in view. Out of line: others need not
/// make room for that.
[[gnu::noinline]] void fit_with_room(const PlanContext& c, MapRequest& request, MapResult& result) noexcept {
  const Polytope moving = receivers_with_room(c, c.camera.near_depth, c.camera.far_depth, request.room);
  if (!moving.empty()) request.all_receivers = &moving;
  fit_cascade(c, request, result);
}

/// `viewed`: room for what several cameras see; nullptr where there is one.
[[gnu::noinline]] void plan_cascade(const PlanContext& c, const ParallelScene& scene, int cascade,
                                    DepthRange between, MapSizes::Size size, PlanHistory* history,
                                    ViewedPoints* viewed, ShadowPlan& plan) noexcept {
  const bool caches = c.how.caches_cascades && cascade > 0;
  if (caches) {
    const PlanHistory::KeptMap* const cached =
        cached_cascade(c, *history, {cascade, between.begin, between.end});
    if (cached != nullptr) return add_cached(c, *cached, *history, plan);
  }
  Slice slice;
  slice.viewed = viewed;
  if (caches) slice.room = room_for_motion(c, between.end);
  slice_between(c, scene, plan, between.begin, between.end, slice);
  const bool on_planes = scene.planes != nullptr && slice.wanted && !slice.body->empty() &&
                         c.options.prune.has(PruneRule::empty_cascades) && scene.planes->serve(*slice.body);
  if (on_planes) {
    omit(plan, {OmissionKind::cascade_on_planes, cascade, slice.begin, slice.end, texels_asked(c.options)});
    return;
  }
  if (!slice.wanted) {
    omit(plan, {OmissionKind::cascade_without_receiver, cascade, between.begin, between.end,
                texels_asked(c.options)});
    return;
  }
  MapRequest request = request_for(scene, *slice.body, slice.begin - slice.overlap, slice.end);
  request.slot.cascade = cascade;
  request.slot.width = size.width;
  request.slot.height = size.height;
  request.slot.depth_begin = slice.begin;
  request.slot.depth_end = slice.end;
  request.slot.overlap = slice.overlap;
  request.without_casters = !c.options.prune.has(PruneRule::casterless_cascades);
  request.last = last_map(history, cascade);
  if (plan.selection == MapSelection::finest) request.all_receivers = &scene.body;
  if (slice.viewed != nullptr) request.viewed = slice.viewed->points();
  request.room = slice.room;
  MapResult result(next_map(plan));
  if (request.all_receivers != nullptr && request.room > 0.0) {
    fit_with_room(c, request, result);
  } else {
    fit_cascade(c, request, result);
  }
  if (caches) history->kept[static_cast<std::size_t>(cascade)] = cascade_to_cache(c, result, history->frame);
  merge(result,
        {OmissionKind::cascade_without_caster, cascade, slice.begin, slice.end, texels_asked(c.options)},
        history, plan);
}

/// Leaves a cascade's depths to the next one where the map of both has the same texels. Out of line: maps
/// need not make room for what is compared.
[[gnu::noinline]] void leave_to_next(const PlanContext& c, const ParallelScene& scene, const MapSizes& sizes,
                                     CascadeEdges& edges, ShadowPlan& plan) noexcept {
  if (!c.how.stable || c.how.caches_cascades || !c.views.empty() || c.visible_depths != nullptr ||
      !c.options.prune.has(PruneRule::equal_cascades))
    return;
  for (int cascade = 0; cascade + 2 < edges.count; ++cascade) {
    const auto at = static_cast<std::size_t>(cascade);
    const MapSizes::Size &own = sizes.of[at], &next = sizes.of[at + 1];
    const double begin = edges.depth[at], end = edges.depth[at + 1];
    if (own.width != next.width || own.height != next.height ||
        !stable_map_serves_both(c, scene.space.frame, begin, end, edges.depth[at + 2]))
      continue;
    omit(plan, {OmissionKind::cascade_without_gain, cascade, begin, end, texels_asked(c.options)});
    edges.depth[at + 1] = begin;
    edges.left_to_next |= 1u << at;
  }
}

/// Out of line: cascades of one view need not make room for the points of several.
[[gnu::noinline]] void plan_viewed_cascade(const PlanContext& c, const ParallelScene& scene, int cascade,
                                           DepthRange between, MapSizes::Size size, PlanHistory* history,
                                           ShadowPlan& plan) noexcept {
  ViewedPoints viewed;
  plan_cascade(c, scene, cascade, between, size, history, &viewed, plan);
}

/// The sizes of the last frame's maps, and how many there were.
MapSizes last_sizes(const PlanHistory& history, const PlanOptions& options) noexcept {
  const int least = least_budget_side(options);
  // Of a cascade that had no map: under steady edges it may get one that the trial did not.
  MapSizes sizes = equal_sizes(options.resolution.texel_budget > 0 ? least : options.resolution.max_size);
  for (std::size_t i = 0; i < history.map.size(); ++i) {
    if (history.map[i].width >= least) sizes.of[i] = {history.map[i].width, history.map[i].height};
  }
  return sizes;
}
bool last_sizes_serve(const PlanHistory& history, const ShadowPlan& fitted,
                      const PlanOptions& options) noexcept {
  for (const ShadowMap& map : fitted.maps()) {
    const PlanHistory::Map& last = history.map[static_cast<std::size_t>(map.cascade)];
    if (last.frame + 1 != history.frame || last.width < least_budget_side(options)) return false;
  }
  if (options.resolution.texel_budget == 0) return true;
  const MapSizes sizes = last_sizes(history, options);
  std::int64_t texels = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(history.edge_count - 1); ++i)
    texels += std::int64_t{sizes.of[i].width} * sizes.of[i].height;
  return texels <= options.resolution.texel_budget;
}

}  // namespace

void clip_to_points(const PlanContext& c, const LightFrame& frame, double begin, double end,
                    Polytope& body) noexcept {
  Box bounds;  // along the frame's axes
  double farthest = 0.0;
  // Depths of points on the slice's ends are rounded, and so are the points. A point far beside the view's
  // axis has a depth that is far less than what it is the sum of.
  constexpr double kRounding = 1e-9, kSumRounding = 1e-12;
  const double slice_slack =
      kRounding * (max_of(std::abs(begin), std::abs(end)) + largest_component(c.camera.position));
  for (const glm::dvec3& point : c.visible_points) {
    const glm::dvec3 p = point - c.camera.position;
    const double depth = glm::dot(c.axes.forward, p);
    const double slack = slice_slack + kSumRounding * largest_component(p);
    if (!(depth >= begin - slack && depth <= end + slack)) continue;
    bounds.extend(frame.turned(p));
    farthest = max_of(farthest, depth);
  }
  if (bounds.empty() || body.empty()) return;
  const Camera& camera = c.camera;
  const double pixel =
      max_of((camera.right - camera.left) / camera.width, (camera.top - camera.bottom) / camera.height);
  const double extent = max_of(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
  const double room = kPointSafety * extent + kPixelsBetween * pixel * (camera.orthographic ? 1.0 : farthest);
  Polytope part = body;
  clip(part, {frame.x, room - bounds.min.x});
  clip(part, {-frame.x, room + bounds.max.x});
  clip(part, {frame.y, room - bounds.min.y});
  clip(part, {-frame.y, room + bounds.max.y});
  // Points beside all receivers are of another scene.
  if (!part.empty()) body = part;
}

bool cut_from_afar(const PlanContext& c, double far, double end) noexcept {
  // A cut leaves 1e-13 of the largest distance to rounding: a millionth of what is this much nearer.
  constexpr double kAfar = 1e-7;
  return c.views.empty() && !c.camera.orthographic && end < kAfar * far && end > c.camera.near_depth;
}

MapRequest request_for(const ParallelScene& scene, const Polytope& body, double begin, double end) noexcept {
  return {{}, body, scene.space, scene.warp, begin, end, {}, 0.0, 0.0, 0.0, false, {}};
}

void plan_cascades(const PlanContext& c, const ParallelScene& scene, int cascades, const MapSizes& sizes,
                   PlanHistory* history, ShadowPlan& plan) noexcept {
  plan.map_count = plan.omission_count = 0;
  CascadeEdges edges = cascade_edges(c, scene, cascades, history);
  for (int i = 0; i < edges.omission_count; ++i) omit(plan, edges.omission[static_cast<std::size_t>(i)]);
  if (history != nullptr && !c.how.stable) {
    history->edge = edges.depth;
    history->edge_count = edges.count;
  }
  leave_to_next(c, scene, sizes, edges, plan);
  for (int i = 0; i < cascades; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if ((edges.left_to_next >> at & 1u) != 0) continue;
    const DepthRange between{edges.depth[at], edges.depth[at + 1]};
    if (c.views.empty()) {
      plan_cascade(c, scene, i, between, sizes.of[at], history, nullptr, plan);
    } else {
      plan_viewed_cascade(c, scene, i, between, sizes.of[at], history, plan);
    }
  }
}

// Errors go by 1 / size, so that maps of any other size tell: one trial for each number of cascades, and the
// plan itself.
void plan_within(const PlanContext& c, const ParallelScene& scene, bool square, PlanHistory* history,
                 ShadowPlan& plan) noexcept {
  const PlanOptions& options = c.options;
  // Trials keep their size, and leave nothing to a history.
  PlanContext trial_context = c;
  trial_context.how.error_bound = 0.0;
  trial_context.how.forget();
  // Errors closer than this are the same: the map more gains nothing.
  constexpr double kWorthAMap = 0.99;
  int best = options.cascades;
  double least = std::numeric_limits<double>::infinity(), before = least;
  const MapSizes equal = equal_sizes(options.resolution.max_size);
  MapSizes sizes = equal;
  // Given splits are of one number of cascades.
  for (int n = options.split.scheme == SplitScheme::given ? options.cascades : 1; n <= options.cascades;
       ++n) {
    plan_cascades(trial_context, scene, n, equal, nullptr, plan);
    const TexelDemands demands(c, plan, square);
    const MapSizes trial = options.resolution.texel_budget > 0 ? demands.within_budget(n) : equal;
    const double m = demands.error(trial);
    if (m < least * kWorthAMap) {
      best = n;
      least = m;
      sizes = trial;
    }
    if (history != nullptr && n == history->edge_count - 1 && last_sizes_serve(*history, plan, options))
      before = demands.error(last_sizes(*history, options));
    if (!(demands.largest_error(trial) <= options.resolution.max_error)) continue;
    if (options.resolution.texel_budget == 0) break;
    // Other sizes have other borders, and with them another warp.
    plan_cascades(trial_context, scene, n, trial, nullptr, plan);
    if (TexelDemands(c, plan, square).largest_error(trial) <= options.resolution.max_error) break;
  }
  // Another size moves every texel: worth it only for errors this much smaller.
  constexpr double kWorthResizing = 0.8;
  if (std::isfinite(before) && least >= before * kWorthResizing) {
    best = history->edge_count - 1;
    sizes = last_sizes(*history, options);
  }
  plan_cascades(c, scene, best, sizes, history, plan);
}

}  // namespace gnomon
