// From a camera, a light and bounds to the shadow maps worth drawing: the pipeline, stage by stage.
#include "gnomon/plan.hpp"
#include "gnomon/extend/body.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/light_axes.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "map/texel_shape.hpp"
#include "plan/cadence.hpp"
#include "plan/cascades.hpp"
#include "plan/frame.hpp"
#include "plan/input.hpp"
#include "plan/local.hpp"
#include "plan/parts.hpp"
#include "plan/receiver_planes.hpp"
#include "warp/registry.hpp"

namespace gnomon {
namespace {

/// Lists what was asked for and a partition other than by depth has no use for.
void report_ignored_by_parts(const PlanContext& c, const PlanHistory* history, ShadowPlan& plan) noexcept {
  const ResolutionOptions& r = c.options.resolution;
  if (r.texel_budget > 0) omit(plan, IgnoredOption::texel_budget);
  if (c.options.split.selection == MapSelection::finest) omit(plan, IgnoredOption::selection);
  if (c.options.split.overlap > 0.0) omit(plan, IgnoredOption::split_overlap);
  if (history != nullptr) omit(plan, IgnoredOption::history);
}

/// What a stable fit does without, and the status.
void finish_parallel(const PlanContext& c, ShadowPlan& plan) noexcept {
  const PlanOptions& options = c.options;
  if (c.stable && divides_parallel(options.split.partition))
    omit(plan, {OmissionKind::partition_in_stable_fit, -1, 0.0, 0.0, 0});
  if (c.stable && options.warp.warp != nullptr && !is_unwarped(*options.warp.warp))
    omit(plan, {OmissionKind::warp_in_stable_fit, -1, 0.0, 0.0, 0});
  if (options.split.partition == Partition::tetrahedron) omit(plan, IgnoredOption::partition);
  if (ignores_shape(c, false)) omit(plan, IgnoredOption::shape);
  if (options.warp.has_planes() && !takes_planes(c)) omit(plan, IgnoredOption::planes);
  plan.status = plan.map_count > 0 ? PlanStatus::ok : PlanStatus::no_caster;
}

/// What of the receivers is in view, and its depths.
struct VisibleReceivers {
  Polytope body;
  DepthRange depths{};  // where there is a body

  explicit VisibleReceivers(const PlanContext& c) noexcept : body(view_body(c)) {
    const auto receive = [&](Polytope& part) {
      clip(part, visible_bounds(part, c.bounds.receivers, c.camera.position));
    };
    receive(body);
    if (body.empty()) return;
    depths = depths_of(body, c.axes.forward);
    if (!cut_from_afar(c, c.camera.far_depth, depths.end)) return;
    // Twice the depth has room for the first cut's rounding.
    Polytope nearer =
        frustum_slice(c.camera, c.axes, c.camera.near_depth, min_of(2.0 * depths.end, c.camera.far_depth));
    receive(nearer);
    if (nearer.empty()) return;
    body = nearer;
    depths = depths_of(body, c.axes.forward);
  }
};

void plan_along_view(const PlanContext& c, const ParallelScene& scene, PlanHistory* history,
                     ShadowPlan& plan) noexcept {
  const ResolutionOptions& resolution = c.options.resolution;
  if (resolution.max_error > 0.0 || resolution.texel_budget > 0) {
    plan_within(c, scene, history, plan);
  } else {
    plan_cascades(c, scene, c.options.cascades, equal_sizes(resolution.max_size), history, plan);
  }
}

/// Out of line: a plan without planes need not make room for their maps.
[[gnu::noinline]] void plan_with_planes(const PlanContext& c, const ParallelScene& scene,
                                        PlanHistory* history, ShadowPlan& plan) noexcept {
  const PlaneMaps planes = plane_maps(c, scene);
  const ParallelScene rest{scene.body, scene.depths, scene.space, scene.warp,
                           planes.count > 0 ? &planes : nullptr};
  plan_along_view(c, rest, history, plan);
  add_plane_maps(c, planes, plan);
}

void plan_parallel(PlanContext& c, const DirectionalLight& light, const VisibleDepths* visible,
                   PlanHistory* history, ShadowPlan& plan) noexcept {
  const PlanOptions& options = c.options;
  plan.light_direction = safe_normalize(light.direction, {0.0, -1.0, 0.0});
  const VisibleReceivers visible_receivers(c);
  if (visible_receivers.body.empty()) {
    plan.status = PlanStatus::nothing_visible;
    return;
  }
  ParallelScene scene{visible_receivers.body,
                      c.views.empty() ? visible_receivers.depths : depths_seen(c.views),
                      {},
                      requested_warp(options)};
  scene.space.frame =
      c.stable ? fixed_frame(plan.light_direction) : view_aligned_frame(plan.light_direction, c.axes);
  c.seen = usable_depths(c, scene.depths, visible);
  const bool parts = divides_parallel(options.split.partition);
  const bool follows_points = !c.stable && !parts && !c.keeps && options.fit != Fit::warped_stable;
  const bool ignores_points = !c.seen_points.empty() && !follows_points;
  if (ignores_points) c.seen_points = {};
  if (parts && !c.stable) {
    // Parts follow the view in no steady way.
    c.remembers = false;
    plan_parts(c, scene, plan);
    report_ignored_by_parts(c, history, plan);
    if (ignores_points) omit(plan, IgnoredOption::visible_points);
    return finish_parallel(c, plan);
  }
  plan.selection = options.split.selection;
  if (takes_planes(c)) {
    plan_with_planes(c, scene, history, plan);
  } else {
    plan_along_view(c, scene, history, plan);
  }
  if (ignores_points) omit(plan, IgnoredOption::visible_points);
  if (plan.selection != MapSelection::view_depth && options.split.overlap > 0.0)
    omit(plan, IgnoredOption::split_overlap);
  finish_parallel(c, plan);
}

glm::dvec4 light_of(const Light& light) noexcept {
  if (const auto* sun = std::get_if<DirectionalLight>(&light))
    return glm::dvec4(-safe_normalize(sun->direction, {0.0, -1.0, 0.0}), 0.0);
  if (const auto* spot = std::get_if<SpotLight>(&light)) return glm::dvec4(spot->position, 1.0);
  const auto* point = std::get_if<PointLight>(&light);
  return point != nullptr ? glm::dvec4(point->position, 1.0) : glm::dvec4(0.0);
}

/// The context that input and options give, and the plan's fields that need no map.
PlanContext begin_plan(const Camera& camera, const SceneBounds& bounds, const PlanOptions& options,
                       bool remembers, ShadowPlan& plan) noexcept {
  plan.origin_world = camera.position;
  plan.clip_space = options.clip_space;
  plan.bias = options.bias;
  PlanContext context{camera, bounds, options, camera_axes(camera)};
  context.stable = options.fit == Fit::stable;
  context.error_bound = error_bound(options, remembers);
  context.remembers = remembers;
  plan.sizes_vary = context.error_bound > 0.0 || options.resolution.texel_budget > 0;
  return context;
}

/// Forgets what was planned with other options: maps that are kept as they are, and where searches begin.
void remember_options(const PlanOptions& options, PlanHistory& history) noexcept {
  if (options == history.options) return;
  for (PlanHistory::KeptMap& kept : history.kept) kept.frame = -1;
  for (PlanHistory::Map& map : history.map) map.searched.until = -1;
  history.searched_edges.until = -1;
  history.options = options;
}

/// Fills in the plan of one frame; `history` may be nullptr.
void plan_frame(const View& view, const Light& light, const SceneBounds& bounds, const PlanOptions& options,
                PlanHistory* history, ShadowPlan& plan) noexcept {
  plan.invalid_field = first_invalid_field(view, light, bounds, options);
  if (!plan.invalid_field.empty()) return;
  if (std::isinf(view.camera.far_depth)) {
    View finite = view;
    finite.camera = with_finite_far(view.camera, bounds.receivers);
    plan_frame(finite, light, bounds, options, history, plan);
    return;
  }
  PlanContext context = begin_plan(view.camera, bounds, options, history != nullptr, plan);
  context.keeps = keeps_cascades(light, options, history != nullptr);
  context.seen_points = view.points_world;
  if (history != nullptr) {
    remember_options(options, *history);
    context.frame = history->frame;
    context.last_eye = history->eye_world;
    context.last_forward = history->forward;
    // Maps of another place are no start, and no reason to go slowly; a turning sun's are.
    const glm::dvec4 now = light_of(light), before = history->light_world;
    context.same_light = now == before;
    if (now.w != before.w || (now.w != 0.0 && now != before)) {
      for (PlanHistory::Map& map : history->map) map.frame = -1;
    }
  }
  if (const auto* sun = std::get_if<DirectionalLight>(&light)) {
    plan_parallel(context, *sun, view.depths, history, plan);
  } else {
    context.seen = view.depths;
    context.seen_points = {};
    plan_local(context, light, history, plan);
    if (!view.points_world.empty()) omit(plan, IgnoredOption::visible_points);
  }
  if (options.cadence.frames > 1 && !context.keeps) omit(plan, IgnoredOption::cadence);
}

}  // namespace

ShadowPlan plan_shared(std::span<const SharedView> views, const Camera& mean, const Light& light,
                       const SceneBounds& bounds, const PlanOptions& options) noexcept {
  ShadowPlan plan;
  PlanContext context = begin_plan(mean, bounds, options, false, plan);
  context.views = views;
  if (const auto* sun = std::get_if<DirectionalLight>(&light)) {
    plan_parallel(context, *sun, nullptr, nullptr, plan);
  } else {
    plan_local(context, light, nullptr, plan);
  }
  return plan;
}

ShadowPlan make_plan(const View& view, const Light& light, const SceneBounds& bounds,
                     const PlanOptions& options, PlanHistory* history) noexcept {
  ShadowPlan plan;
  if (history == nullptr) {
    plan_frame(view, light, bounds, options, nullptr, plan);
    return plan;
  }
  history->event_count = 0;
  if (keeps_cascades(light, options, true)) {
    plan_frame(view, light, bounds, with_fixed_splits(options), history, plan);
  } else {
    plan_frame(view, light, bounds, options, history, plan);
  }
  if (plan.status == PlanStatus::invalid_input) return plan;
  history->eye_world = view.camera.position;
  history->forward = camera_axes(view.camera).forward;
  history->light_world = light_of(light);
  ++history->frame;
  return plan;
}

}  // namespace gnomon
