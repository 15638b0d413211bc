// From a camera, a light and bounds to the shadow maps worth drawing: the pipeline, stage by stage.
#include "gnomon/plan.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "light_positional.hpp"
#include "partition.hpp"
#include "plan_budget.hpp"
#include "plan_context.hpp"
#include "plan_input.hpp"
#include "plan_splits.hpp"
#include "vector.hpp"
#include "visible.hpp"

namespace gnomon {

void omit(ShadowPlan& plan, const Omission& omission) noexcept {
  if (plan.omission_count < kMaxOmissions)
    plan.omission[static_cast<std::size_t>(plan.omission_count)] = omission;
  ++plan.omission_count;
}

namespace {

std::int64_t texels_of(const PlanOptions& options) noexcept {
  return std::int64_t{options.map_size} * options.map_size;
}

/// Depths in front of `begin` that a cascade shows besides its own: none where the one before it ends sooner.
double overlap_before(const PlanContext& c, double begin) noexcept {
  if (c.plan.map_count == 0) return 0.0;
  const ShadowMap& before = c.plan.map[static_cast<std::size_t>(c.plan.map_count - 1)];
  return before.depth_end == begin ? c.options.split_overlap * (begin - before.depth_begin) : 0.0;
}

/// The part of `body` between two depths that holds receivers.
Polytope receivers_between(const PlanContext& c, const Polytope& body, double begin, double end) noexcept {
  Polytope part = body;
  clip(part, Plane{c.axes.forward, -begin});
  clip(part, Plane{-c.axes.forward, end});
  if (c.bounds.receivers.size() > 1 && !part.empty()) {
    clip(part, visible_bounds(part, c.bounds.receivers, c.camera.position));
  }
  return part;
}

/// `all` is the body of everything in view, [from, to] the depths between the neighbouring cascades.
void plan_cascade(const PlanContext& c, const Polytope& all, int cascade, double from, double to,
                  MapSizes::Size size) noexcept {
  auto [begin, end] = seen_between(c, from, to);
  // A single depth is a slice only where it is all there is.
  const bool covered = from == to && c.plan.map_count > 0;
  Polytope body;
  if (begin <= end && !covered) body = receivers_between(c, all, begin, end);
  const bool holds_nothing = body.empty();
  if (holds_nothing) {
    if (c.options.prune.has(PruneRule::empty_cascades) || !(from < to)) {
      omit(c.plan, {OmissionKind::cascade_without_receiver, cascade, from, to, texels_of(c.options)});
      return;
    }
    begin = from;
    end = to;
  }
  const double overlap = overlap_before(c, begin), low = begin - overlap;
  if (holds_nothing) {
    body = frustum_slice(c.camera, c.axes, low, end);
  } else if (overlap > 0.0) {
    body = receivers_between(c, all, low, end);
  }
  ShadowMap& map = c.plan.map[static_cast<std::size_t>(c.plan.map_count)];
  map = ShadowMap{};
  map.cascade = cascade;
  map.depth_begin = begin;
  map.depth_end = end;
  map.overlap = overlap;
  map.width = size.width;
  map.height = size.height;
  map.warp = &c.warp;
  const bool drawn =
      c.stable ? lay_stable_map(c, body, low, end, map) : lay_tight_map(c, body, low, end, map);
  if (drawn) {
    ++c.plan.map_count;
  } else {
    omit(c.plan, {OmissionKind::cascade_without_caster, cascade, begin, end, texels_of(c.options)});
  }
}

/// Replaces the plan's maps by so many cascades.
void plan_cascades(PlanContext& c, const Polytope& body, int cascades, const MapSizes& sizes) noexcept {
  c.plan.map_count = c.plan.omission_count = 0;
  if (c.stable && c.options.partition != Partition::view_depth)
    omit(c.plan, {OmissionKind::partition_in_stable_fit, -1, 0.0, 0.0, 0});
  if (c.stable && c.options.warp != nullptr && c.options.warp != &warps::none) {
    omit(c.plan, {OmissionKind::warp_in_stable_fit, -1, 0.0, 0.0, 0});
  }
  std::array<double, kMaxMaps + 1> edges{};
  choose_edges(c, body, {edges.data(), static_cast<std::size_t>(cascades + 1)});
  for (int i = 0; i < cascades; ++i) {
    const auto at = static_cast<std::size_t>(i);
    plan_cascade(c, body, i, edges[at], edges[at + 1], sizes.of[at]);
  }
}

/// The sizes of the last frame's maps, and how many there were.
MapSizes last_sizes(const PlanHistory& history, const PlanOptions& options) noexcept {
  const int least = least_budget_side(options);
  // Of a cascade that had no map: under steady edges it may get one that the trial did not.
  MapSizes sizes = equal_sizes(options.texel_budget > 0 ? least : options.map_size);
  for (std::size_t i = 0; i < history.map.size(); ++i) {
    if (history.map[i].width >= least) sizes.of[i] = {history.map[i].width, history.map[i].height};
  }
  return sizes;
}
bool last_sizes_serve(const PlanHistory& history, const ShadowPlan& laid,
                      const PlanOptions& options) noexcept {
  for (const ShadowMap& map : laid.maps()) {
    const PlanHistory::Map& last = history.map[static_cast<std::size_t>(map.cascade)];
    if (last.frame + 1 != history.frame || last.width < least_budget_side(options)) return false;
  }
  if (options.texel_budget == 0) return true;
  const MapSizes sizes = last_sizes(history, options);
  std::int64_t texels = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(history.edge_count - 1); ++i)
    texels += std::int64_t{sizes.of[i].width} * sizes.of[i].height;
  return texels <= options.texel_budget;
}

/// As many cascades, as large, as the target or the budget asks for. Errors go by 1 / size, so that maps of
/// any other size tell: one trial for each number of cascades, and the plan itself.
void plan_within(PlanContext& c, const Polytope& body) noexcept {
  const PlanOptions& options = c.options;
  PlanHistory* const history = c.history;
  // Trials leave nothing to remember.
  c.history = nullptr;
  const bool square = c.stable || options.fit == Fit::warped_stable || history != nullptr;
  // Errors closer than this are the same: the map more gains nothing.
  constexpr double kWorthAMap = 0.99;
  int best = options.cascades;
  double least = std::numeric_limits<double>::infinity();
  MapSizes sizes = equal_sizes(options.map_size);
  double before = std::numeric_limits<double>::infinity();
  // Given splits are of one number of cascades.
  for (int n = options.split == SplitScheme::given ? options.cascades : 1; n <= options.cascades; ++n) {
    const MapSizes equal = equal_sizes(options.map_size);
    plan_cascades(c, body, n, equal);
    const MapSizes trial = options.texel_budget > 0 ? budgeted_sizes(c.plan, options, n, square) : equal;
    const double m = largest_error(c.plan, options, trial);
    if (m < least * kWorthAMap) {
      best = n;
      least = m;
      sizes = trial;
    }
    if (history != nullptr && n == history->edge_count - 1 && last_sizes_serve(*history, c.plan, options))
      before = largest_error(c.plan, options, last_sizes(*history, options));
    if (m <= options.target_m) break;
  }
  c.history = history;
  c.prune_m = bound_of_pruning(options, history != nullptr);
  // Another size moves every texel: worth it only for errors this much smaller.
  constexpr double kWorthResizing = 0.8;
  if (std::isfinite(before) && least >= before * kWorthResizing) {
    best = history->edge_count - 1;
    sizes = last_sizes(*history, options);
  }
  plan_cascades(c, body, best, sizes);
}

/// A plan of one frame; `history` may be nullptr.
ShadowPlan plan_frame(const Camera& camera, const Light& light, const SceneBounds& bounds,
                      const PlanOptions& options, PlanHistory* history) noexcept {
  ShadowPlan plan;
  plan.invalid_field = first_invalid_field(camera, light, bounds, options);
  if (!plan.invalid_field.empty()) return plan;
  if (std::isinf(camera.far_depth)) {
    return plan_frame(with_finite_far(camera, bounds.receivers), light, bounds, options, history);
  }
  plan.origin_world = camera.position;
  plan.clip_space = options.clip_space;
  plan.bias = options.bias;
  const double prune_m = bound_of_pruning(options, history != nullptr);
  plan.sizes_vary = prune_m > 0.0 || options.texel_budget > 0;
  const auto* directional = std::get_if<DirectionalLight>(&light);
  if (directional == nullptr) {
    plan_positional(camera, light, bounds, options, prune_m, plan);
    return plan;
  }
  plan.light_direction = safe_normalize(directional->direction, {0.0, -1.0, 0.0});

  const CameraAxes axes = camera_axes(camera);
  const bool stable = options.fit == Fit::stable;
  const glm::dvec3 across = glm::cross(axes.forward, plan.light_direction);
  PlanContext context{
      camera,
      bounds,
      options,
      axes,
      plan.light_direction,
      stable ? fixed_frame(plan.light_direction) : view_aligned_frame(plan.light_direction, axes),
      stable,
      options.warp != nullptr ? *options.warp : warps::optimal,
      std::sqrt(glm::dot(across, across)),
      glm::dot(axes.forward, plan.light_direction),
      plan,
      history};
  Polytope body = frustum_slice(camera, axes, camera.near_depth, camera.far_depth);
  clip(body, visible_bounds(body, bounds.receivers, camera.position));
  if (body.empty()) {
    plan.status = PlanStatus::nothing_visible;
    return plan;
  }
  if (options.partition != Partition::view_depth && !stable) {
    context.prune_m = prune_m;
    std::array<double, 2> edges{};
    choose_edges(context, body, edges);
    plan_parts(context, body, edges[0], edges[1]);
  } else if (options.target_m > 0.0 || options.texel_budget > 0) {
    plan_within(context, body);
  } else {
    context.prune_m = prune_m;
    plan_cascades(context, body, options.cascades, equal_sizes(options.map_size));
  }
  plan.status = plan.map_count > 0 ? PlanStatus::ok : PlanStatus::no_caster;
  return plan;
}

}  // namespace

ShadowPlan make_plan(const Camera& camera, const Light& light, const SceneBounds& bounds,
                     const PlanOptions& options) noexcept {
  return plan_frame(camera, light, bounds, options, nullptr);
}

ShadowPlan make_plan(const Camera& camera, const Light& light, const SceneBounds& bounds,
                     const PlanOptions& options, PlanHistory& history) noexcept {
  history.event_count = 0;
  ShadowPlan plan = plan_frame(camera, light, bounds, options, &history);
  if (plan.status == PlanStatus::invalid_input) return plan;
  history.eye_world = camera.position;
  history.forward = camera_axes(camera).forward;
  history.light_direction = plan.light_direction;
  ++history.frame;
  return plan;
}

}  // namespace gnomon
