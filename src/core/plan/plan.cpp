// From a camera, a light and bounds to the shadow maps worth drawing: the pipeline, stage by stage.
#include "gnomon/plan.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/first_hits.hpp"
#include "geometry/light_axes.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "gnomon/extend/body.hpp"
#include "map/shared_views.hpp"
#include "plan/cascades.hpp"
#include "plan/input.hpp"
#include "plan/local.hpp"
#include "plan/parts.hpp"
#include "plan/receiver_planes.hpp"
#include "resolve/resolve.hpp"

namespace gnomon {
namespace {

/// What of the receivers is in view, and its depths.
struct VisibleReceivers {
  Polytope body;
  DepthRange depths{};  // where there is a body

  /// Out of line: what follows need not make room for the bodies on the way.
  [[gnu::noinline]] explicit VisibleReceivers(const PlanContext& c) noexcept : body(view_body(c)) {
    const auto receive = [&](Polytope& part) {
      clip(part, visible_bounds(part, c.bounds.receivers, c.camera.position));
    };
    // Of several views each part is cut to them already: another cut might lose a thin one to rounding.
    if (c.views.empty()) receive(body);
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

void plan_along_view(const PlanContext& c, const ParallelScene& scene, const Resolved& resolved,
                     PlanHistory* history, ShadowPlan& plan) noexcept {
  const ResolutionOptions& resolution = c.options.resolution;
  if (resolution.max_error > 0.0 || resolution.texel_budget > 0) {
    plan_within(c, scene, resolved.square, history, plan);
  } else {
    plan_cascades(c, scene, c.options.cascades, equal_sizes(resolution.max_size), history, plan);
  }
}

/// Out of line: a plan without planes need not make room for their maps.
[[gnu::noinline]] void plan_with_planes(const PlanContext& c, const ParallelScene& scene,
                                        const Resolved& resolved, PlanHistory* history,
                                        ShadowPlan& plan) noexcept {
  const PlaneMaps planes = plane_maps(c, scene);
  const ParallelScene rest{scene.body, scene.depths, scene.space, scene.warp,
                           planes.count > 0 ? &planes : nullptr};
  plan_along_view(c, rest, resolved, history, plan);
  add_plane_maps(c, planes, plan);
}

/// Out of line: maps need not make room for the way there.
[[gnu::noinline]] void find_receiver_bounds(PlanContext& c) noexcept {
  c.receivers = casters_inside({}, c.bounds.receivers, glm::dvec3(0.0), {0.0, 0.0, 1.0}).bounds;
}

void plan_parallel(PlanContext& c, const DirectionalLight& light, const Resolved& resolved,
                   const VisibleDepths* visible, PlanHistory* history, ShadowPlan& plan) noexcept {
  plan.light_direction = safe_normalize(light.direction, {0.0, -1.0, 0.0});
  const VisibleReceivers visible_receivers(c);
  if (visible_receivers.body.empty()) {
    plan.status = PlanStatus::nothing_visible;
    return;
  }
  ParallelScene scene{visible_receivers.body,
                      c.views.empty() ? visible_receivers.depths : receiver_depths(c.views),
                      {},
                      *c.how.warp};
  scene.space.frame =
      c.how.stable ? grid_frame(plan.light_direction) : view_aligned_frame(plan.light_direction, c.axes);
  if (c.how.stable) find_receiver_bounds(c);
  if (resolved.follows_depths) c.visible_depths = usable_depths(c, scene.depths, visible);
  if (resolved.parts) {
    plan_parts(c, scene, plan);
  } else {
    plan.selection = c.options.split.selection;
    if (resolved.planes) {
      plan_with_planes(c, scene, resolved, history, plan);
    } else {
      plan_along_view(c, scene, resolved, history, plan);
    }
  }
  omit(plan, resolved.of_maps);
  plan.status = plan.map_count > 0 ? PlanStatus::ok : PlanStatus::no_caster;
}

glm::dvec4 light_of(const Light& light) noexcept {
  if (const auto* sun = std::get_if<DirectionalLight>(&light))
    return glm::dvec4(-safe_normalize(sun->direction, {0.0, -1.0, 0.0}), 0.0);
  if (const auto* spot = std::get_if<SpotLight>(&light)) return glm::dvec4(spot->position, 1.0);
  const auto* point = std::get_if<PointLight>(&light);
  return point != nullptr ? glm::dvec4(point->position, 1.0) : glm::dvec4(0.0);
}

/// The context that input and options give, and the plan's fields that need no map.
PlanContext begin_plan(const Camera& camera, const SceneBounds& bounds, const Resolved& resolved,
                       ShadowPlan& plan) noexcept {
  const PlanOptions& options = resolved.options;
  plan.origin_world = camera.position;
  plan.clip_space = options.clip_space;
  plan.bias = options.bias;
  plan.sizes_vary = resolved.conduct.error_bound > 0.0 || options.resolution.texel_budget > 0;
  PlanContext context{camera, bounds, options, camera_axes(camera), resolved.conduct};
  if (options.warp.objective != Objective::picture) return context;
  const CasterReach casters = casters_inside({}, bounds.casters, camera.position, context.axes.up);
  if (casters.any)
    context.caster_reach =
        max_of(largest_component(casters.bounds.min), largest_component(casters.bounds.max));
  return context;
}

/// The least view depth of a receiver in view, where warps are judged by a body that begins well before it;
/// else 0. Out of line: most plans need no room for the frustum.
[[gnu::noinline]] double nearest_receiver(const PlanContext& c) noexcept {
  const Camera& camera = c.camera;
  const bool by_body = c.options.warp.objective != Objective::picture && c.how.warp != &warps::none;
  if (!by_body || camera.orthographic || !several(c.bounds.receivers)) return 0.0;
  const Polytope frustum = frustum_slice(camera, c.axes, camera.near_depth, camera.far_depth);
  const double nearest =
      nearest_inside({frustum.plane.data(), static_cast<std::size_t>(frustum.face_count)}, frustum,
                     c.bounds.receivers, camera.position, -c.axes.forward, glm::dvec3(0.0), 0.0)
          .nearest;
  constexpr double kWellBefore = 1.05, kRounding = 1.0 - 1e-9;
  return nearest > kWellBefore * camera.near_depth && nearest < camera.far_depth ? nearest * kRounding : 0.0;
}

/// Forgets what was planned with other options: maps that are cached, and where searches begin.
void forget_other_options(const PlanOptions& options, PlanHistory& history) noexcept {
  if (options == history.options) return;
  for (PlanHistory::KeptMap& kept : history.kept) kept.frame = -1;
  // A map of another warp is no start: who asks for none counts on depths that are not divided by w.
  const bool other_warp = options.warp.warp != history.options.warp.warp;
  for (PlanHistory::Map& map : history.map) {
    map.searched.until = -1;
    if (other_warp) map.frame = -1;
  }
  history.searched_edges.until = -1;
  history.options = options;
}

/// Takes up what the last frame left.
void resume(const Light& light, PlanHistory& history, PlanContext& c) noexcept {
  forget_other_options(c.options, history);
  c.history = &history;
  // Maps of another place are no start, and no reason to go slowly; a turning sun's are.
  const glm::dvec4 now = light_of(light), before = history.light_world;
  c.same_light = now == before;
  if (now.w == before.w && (now.w == 0.0 || now == before)) return;
  for (PlanHistory::Map& map : history.map) map.frame = -1;
}

void plan_by_light(PlanContext& c, const Light& light, const Resolved& resolved, const VisibleDepths* visible,
                   PlanHistory* history, ShadowPlan& plan) noexcept {
  if (const auto* sun = std::get_if<DirectionalLight>(&light)) {
    plan_parallel(c, *sun, resolved, visible, history, plan);
  } else {
    plan_local(c, light, resolved, history, plan);
  }
}

/// Out of line: other plans need not make room for the points.
[[gnu::noinline]] void plan_by_seen(PlanContext& c, const View& view, const Light& light,
                                    const Resolved& resolved, PlanHistory* history,
                                    ShadowPlan& plan) noexcept {
  const SeenPoints seen = view.points_world.empty() ? first_hits(view.camera, c.axes, c.bounds.receivers)
                                                    : some_of(view, c.axes, light_of(light));
  c.seen = seen.points();
  plan_by_light(c, light, resolved, view.depths, history, plan);
}

/// Whether errors are counted where boxes are: one box is the body.
bool counts_held(const PlanContext& c) noexcept {
  const Objective objective = c.options.warp.objective;
  return (objective == Objective::p95 || objective == Objective::max) && c.how.warp != &warps::none &&
         !c.camera.orthographic && several(c.bounds.receivers);
}

/// Out of line, too.
[[gnu::noinline]] void plan_by_held(PlanContext& c, const View& view, const Light& light,
                                    const Resolved& resolved, PlanHistory* history,
                                    ShadowPlan& plan) noexcept {
  const HeldDepths held = held_depths(c.camera, c.axes, c.bounds.receivers, c.nearest_receiver);
  c.held = &held;
  plan_by_light(c, light, resolved, view.depths, history, plan);
}

/// Fills in the plan of one frame whose camera sees to a finite depth; `history` may be nullptr. `views`: as
/// PlanCase.
[[gnu::noinline]] void plan_finite(const View& view, const Light& light, const SceneBounds& bounds,
                                   const PlanOptions& options, std::size_t views, PlanHistory* history,
                                   ShadowPlan& plan) noexcept {
  const bool has_depths = view.depths != nullptr && !view.depths->empty();
  const Resolved resolved = resolve(options, {light, view.camera.orthographic, views, history != nullptr,
                                              has_depths, !view.points_world.empty()});
  PlanContext context = begin_plan(view.camera, bounds, resolved, plan);
  if (history != nullptr) resume(light, *history, context);
  if (views <= 1) context.nearest_receiver = nearest_receiver(context);
  if (resolved.follows_points) context.visible_points = view.points_world;
  if (resolved.counts_seen) {
    plan_by_seen(context, view, light, resolved, history, plan);
  } else if (views <= 1 && counts_held(context)) {
    plan_by_held(context, view, light, resolved, history, plan);
  } else {
    plan_by_light(context, light, resolved, view.depths, history, plan);
  }
  omit(plan, resolved.of_plan);
}

/// The same for any camera.
void plan_frame(const View& view, const Light& light, const SceneBounds& bounds, const PlanOptions& options,
                std::size_t views, PlanHistory* history, ShadowPlan& plan) noexcept {
  plan.invalid_field = first_invalid_field(view, light, bounds, options);
  if (!plan.invalid_field.empty()) return;
  if (!std::isinf(view.camera.far_depth)) {
    plan_finite(view, light, bounds, options, views, history, plan);
    return;
  }
  View finite = view;
  finite.camera = with_finite_far(view.camera, bounds.receivers);
  plan.invalid_field = first_invalid_field(finite, light, bounds, options);
  if (plan.invalid_field.empty()) plan_finite(finite, light, bounds, options, views, history, plan);
}

/// The first broken field of any camera, or of what they share.
std::string_view first_invalid_field(std::span<const Camera> cameras, const Light& light,
                                     const SceneBounds& bounds, const PlanOptions& options) noexcept {
  if (cameras.empty() || cameras.size() > kMaxViews) return "cameras";
  // Bounds may be many: they are looked at once.
  const auto field = first_invalid_field(cameras[0], light, bounds, options);
  if (!field.empty()) return field;
  for (const Camera& camera : cameras.subspan(1)) {
    if (camera.orthographic != cameras[0].orthographic) return "cameras";
    const auto of_camera = first_invalid_field(camera, light, SceneBounds{}, options);
    if (!of_camera.empty()) return of_camera;
  }
  return {};
}

glm::dvec3 mean_eye(std::span<const Camera> cameras) noexcept {
  glm::dvec3 sum(0.0);
  for (const Camera& camera : cameras) sum += camera.position / static_cast<double>(cameras.size());
  return sum;
}

/// False where the camera sees no receiver.
bool sees_receivers(const Camera& camera, const SceneBounds& bounds, const glm::dvec3& origin,
                    SharedView& view) noexcept {
  view.camera = with_finite_far(camera, bounds.receivers);
  view.axes = camera_axes(camera);
  view.eye = camera.position - origin;
  view.body = view_slice(view, view.camera.near_depth, view.camera.far_depth);
  clip(view.body, visible_bounds(view.body, bounds.receivers, origin));
  return !view.body.empty();
}

/// The plan that `views` share, all of which see receivers. `mean`: a camera in their middle, at the plan's
/// origin.
void plan_shared(std::span<const SharedView> views, const Camera& mean, const Light& light,
                 const SceneBounds& bounds, const Resolved& resolved, ShadowPlan& plan) noexcept {
  PlanContext context = begin_plan(mean, bounds, resolved, plan);
  context.views = views;
  plan_by_light(context, light, resolved, nullptr, nullptr, plan);
}

}  // namespace

ShadowPlan make_plan(const View& view, const Light& light, const SceneBounds& bounds,
                     const PlanOptions& options, PlanHistory* history) noexcept {
  ShadowPlan plan;
  if (history != nullptr) history->event_count = 0;
  plan_frame(view, light, bounds, options, 0, history, plan);
  if (history == nullptr || plan.status == PlanStatus::invalid_input) return plan;
  history->eye_world = view.camera.position;
  history->forward = camera_axes(view.camera).forward;
  history->light_world = light_of(light);
  ++history->frame;
  return plan;
}

ShadowPlan plan_views(std::span<const Camera> cameras, const Light& light, const SceneBounds& bounds,
                      const PlanOptions& options) noexcept {
  ShadowPlan plan;
  plan.invalid_field = first_invalid_field(cameras, light, bounds, options);
  if (!plan.invalid_field.empty()) return plan;
  if (cameras.size() == 1) {
    plan_frame(cameras[0], light, bounds, options, 1, nullptr, plan);
    return plan;
  }
  const Resolved resolved = resolve(options, {light, cameras[0].orthographic, cameras.size()});
  const glm::dvec3 origin = mean_eye(cameras);
  std::array<SharedView, kMaxViews> seeing;
  std::array<int, kMaxViews> blind{};
  std::size_t seeing_count = 0, blind_count = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (sees_receivers(cameras[i], bounds, origin, seeing[seeing_count])) {
      ++seeing_count;
    } else {
      blind[blind_count++] = static_cast<int>(i);
    }
  }
  const std::span<const SharedView> views{seeing.data(), seeing_count};
  if (views.empty()) {
    plan.status = PlanStatus::nothing_visible;
    plan.origin_world = origin;
    plan.clip_space = options.clip_space;
  } else {
    plan_shared(views, mean_camera(views, origin), light, bounds, resolved, plan);
  }
  for (std::size_t i = 0; i < blind_count; ++i)
    omit(plan, {OmissionKind::view_without_receiver, -1, static_cast<double>(blind[i]), 0.0, 0});
  omit(plan, resolved.of_plan);
  return plan;
}

}  // namespace gnomon
