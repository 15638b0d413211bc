// From a camera, a light and bounds to the shadow maps worth drawing: the pipeline, stage by stage.
#include "gnomon/plan.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "light_positional.hpp"
#include "partition.hpp"
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

/// `all` is the body of everything in view, [from, to] the depths between the neighbouring cascades.
void plan_cascade(const PlanContext& c, const Polytope& all, int cascade, double from, double to) noexcept {
  const auto [begin, end] = seen_between(c, from, to);
  Polytope body = all;
  // A single depth is a slice only where it is all there is.
  const bool covered = from == to && c.plan.map_count > 0;
  if (!(begin <= end) || covered) body.vertex_count = 0;
  clip(body, Plane{c.axes.forward, -begin});
  clip(body, Plane{-c.axes.forward, end});
  if (c.bounds.receivers.size() > 1 && !body.empty()) {
    clip(body, visible_bounds(body, c.bounds.receivers, c.camera.position));
  }
  if (body.empty()) {
    omit(c.plan, {OmissionKind::cascade_without_receiver, cascade, from, to, texels_of(c.options)});
    return;
  }
  ShadowMap& map = c.plan.map[static_cast<std::size_t>(c.plan.map_count)];
  map = ShadowMap{};
  map.cascade = cascade;
  map.depth_begin = begin;
  map.depth_end = end;
  map.width = map.height = c.options.map_size;
  map.warp = &c.warp;
  const bool drawn =
      c.stable ? lay_stable_map(c, body, begin, end, map) : lay_tight_map(c, body, begin, end, map);
  if (drawn) {
    ++c.plan.map_count;
  } else {
    omit(c.plan, {OmissionKind::cascade_without_caster, cascade, begin, end, texels_of(c.options)});
  }
}

}  // namespace

namespace {

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
  const auto* directional = std::get_if<DirectionalLight>(&light);
  if (directional == nullptr) {
    plan_positional(camera, light, bounds, options, plan);
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
  if (stable && options.partition != Partition::view_depth)
    omit(plan, {OmissionKind::partition_in_stable_fit, -1, 0.0, 0.0, 0});
  if (stable && options.warp != nullptr && options.warp != &warps::none) {
    omit(plan, {OmissionKind::warp_in_stable_fit, -1, 0.0, 0.0, 0});
  }
  std::array<double, kMaxMaps + 1> edges{};
  if (options.partition != Partition::view_depth && !stable) {
    choose_edges(context, body, {edges.data(), 2});
    plan_parts(context, body, edges[0], edges[1]);
    plan.status = plan.map_count > 0 ? PlanStatus::ok : PlanStatus::no_caster;
    return plan;
  }
  choose_edges(context, body, {edges.data(), static_cast<std::size_t>(options.cascades + 1)});
  for (int i = 0; i < options.cascades; ++i) {
    const double from = edges[static_cast<std::size_t>(i)], to = edges[static_cast<std::size_t>(i) + 1];
    plan_cascade(context, body, i, from, to);
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
