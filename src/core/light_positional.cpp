// Which frusta a spot or point light is divided into, and what of the visible receivers each of them holds.
#include "light_positional.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "elementary.hpp"
#include "plan_context.hpp"
#include "vector.hpp"
#include "visible.hpp"

namespace gnomon {
namespace {

// Half angle up to which one perspective map serves a spot, 85 degrees: at 90 its image plane is at infinity.
constexpr double kWidestSingle = 1.4835298641951802;
// Half angle below which a cone leaves the face behind it dark: 180 degrees less the face's corner, at slope
// sqrt(2), less the faces' overlap.
constexpr double kLeavesBackDark = 2.184;
// Neighbouring faces of a cube share this much, as a slope: rounding in a shader must not open a seam.
constexpr double kFaceOverlap = 1.0 / 512.0;
// Slope of the narrowest cone: narrower ones get a map this wide.
constexpr double kNarrowest = 1e-6;

/// Keeps what is `slope` or less along `side` per unit of distance along the axis.
Plane slope_plane(const LightFrustum& frustum, const glm::dvec3& side, double slope) noexcept {
  const glm::dvec3 normal = safe_normalize(-frustum.frame.z * slope - side, -frustum.frame.z);
  return {normal, -glm::dot(normal, frustum.apex)};
}
/// Keeps what is at least `distance` along the axis.
Plane distance_plane(const LightFrustum& frustum, double distance) noexcept {
  return {-frustum.frame.z, glm::dot(frustum.frame.z, frustum.apex) - distance};
}

void clip_to_sides(Polytope& body, const LightFrustum& frustum) noexcept {
  for (const glm::dvec3& side : {frustum.frame.x, -frustum.frame.x, frustum.frame.y, -frustum.frame.y}) {
    clip(body, slope_plane(frustum, side, frustum.slope));
  }
}

/// Cuts off the apex, which has no slope, and everything farther than the range or too near to tell depths
/// apart.
void clip_to_distances(Polytope& body, const LightFrustum& frustum, double range) noexcept {
  Plane far_plane = distance_plane(frustum, range);
  clip(body, {-far_plane.normal, -far_plane.offset});
  double farthest = 0.0, offset = largest_component(frustum.apex);
  for (const Polytope::Vertex& v : body.vertices()) {
    farthest = max_of(farthest, frustum.distance(v.position));
    offset = max_of(offset, largest_component(v.position));
  }
  // In the light's own plane, all but the rounding of positions: nothing there has a slope.
  constexpr double kRounding = 1e-13;
  if (!(farthest > kRounding * offset)) {
    body.vertex_count = 0;
    return;
  }
  clip(body, distance_plane(frustum, kNearestShare * farthest));
}

/// The receivers among what is left, where there are several: their common box is smaller here.
void clip_to_receivers(Polytope& body, const PositionalLight& light) noexcept {
  if (body.empty() || light.bounds.receivers.size() < 2) return;
  clip(body, visible_bounds(body, light.bounds.receivers, light.eye_world));
}

ShadowMap& next_map(const PositionalLight& light, int face, ShadowPlan& plan) noexcept {
  ShadowMap& map = plan.map[static_cast<std::size_t>(plan.map_count)];
  map = ShadowMap{};
  map.cascade = face;
  map.width = light.sizes.of[static_cast<std::size_t>(face)].width;
  map.height = light.sizes.of[static_cast<std::size_t>(face)].height;
  const Warp* asked = light.options.warp != nullptr ? light.options.warp : &warps::optimal;
  // The others' formulas are about parallel light; LiSPSM's axis with the strength searched stands for them.
  const bool known = asked == &warps::none || asked == &warps::lispsm04 || asked == &warps::optimal;
  map.warp = known ? asked : &warps::lispsm;
  return map;
}

void plan_cone(const PositionalLight& light, const glm::dvec3& direction, double outer,
               ShadowPlan& plan) noexcept {
  const LightFrustum frustum{light.apex, fixed_frame(direction), max_of(elementary::tan(outer), kNarrowest)};
  Polytope body = light.lit;
  clip_to_sides(body, frustum);
  // Four more planes round the cone cut the square's corners off.
  const glm::dvec3 a = (frustum.frame.x + frustum.frame.y) * std::sqrt(0.5);
  const glm::dvec3 b = (frustum.frame.x - frustum.frame.y) * std::sqrt(0.5);
  for (const glm::dvec3& side : {a, -a, b, -b}) clip(body, slope_plane(frustum, side, frustum.slope));
  if (!body.empty()) clip_to_distances(body, frustum, light.range);
  clip_to_receivers(body, light);
  if (body.empty()) {
    plan.status = PlanStatus::nothing_visible;
    return;
  }
  ShadowMap& map = next_map(light, 0, plan);
  if (lay_positional_map(light, frustum, body, false, plan, map)) ++plan.map_count;
  plan.status = plan.map_count > 0 ? PlanStatus::ok : PlanStatus::no_caster;
}

/// The cone that a cube is clipped by; without one everything is lit.
struct Cone {
  glm::dvec3 direction;
  double outer;
};

/// Clips a face that looks sideways from the cone's direction: along it, the cone's rim is at a slope of
/// cot(outer) where it is nearest to the direction (up to 90 degrees) or farthest from it (beyond).
void clip_to_cone(Polytope& body, const LightFrustum& face, const Cone& cone) noexcept {
  const double cotangent = elementary::cos(cone.outer) / elementary::sin(cone.outer);
  const double slope = cotangent > 0.0 ? cotangent : cotangent * (std::sqrt(2.0) + kFaceOverlap);
  if (slope <= -face.slope) return;
  clip(body, slope_plane(face, -cone.direction, -slope));
}

/// All that a face shows, for a map that no receiver asks for.
Polytope whole_face(const PositionalLight& light, const LightFrustum& face) noexcept {
  Polytope body = box_polytope({light.apex - glm::dvec3(light.range), light.apex + glm::dvec3(light.range)});
  clip_to_sides(body, face);
  if (!body.empty()) clip_to_distances(body, face, light.range);
  return body;
}

/// Six faces in the order +x -x +y -y +z -z of `base`.
void plan_cube(const PositionalLight& light, const LightFrame& base, const Cone* cone,
               ShadowPlan& plan) noexcept {
  const glm::dvec3 axis[3] = {base.x, base.y, base.z};
  bool any_receiver = false;
  for (int face = 0; face < 6; ++face) {
    const auto k = static_cast<std::size_t>(face / 2);
    const double sign = face % 2 == 0 ? 1.0 : -1.0;
    const glm::dvec3 z = axis[k] * -sign, y = axis[(k + 2) % 3];
    const LightFrustum frustum{light.apex, {glm::cross(y, z), y, z}, 1.0 + kFaceOverlap};
    // Face 5 looks along the cone's direction, face 4 away from it.
    const bool dark = cone != nullptr && face == 4 && cone->outer < kLeavesBackDark;
    Polytope body = light.lit;
    if (dark) body.vertex_count = 0;
    clip_to_sides(body, frustum);
    if (cone != nullptr && face < 4) clip_to_cone(body, frustum, *cone);
    if (!body.empty()) clip_to_distances(body, frustum, light.range);
    clip_to_receivers(body, light);
    const std::int64_t texels = std::int64_t{light.options.map_size} * light.options.map_size;
    if (body.empty() && !dark && !light.options.prune.has(PruneRule::empty_faces))
      body = whole_face(light, frustum);
    if (body.empty()) {
      omit(plan, {OmissionKind::face_without_receiver, face, 0.0, 0.0, texels});
      continue;
    }
    any_receiver = true;
    ShadowMap& map = next_map(light, face, plan);
    if (lay_positional_map(light, frustum, body, true, plan, map)) {
      ++plan.map_count;
    } else {
      omit(plan, {OmissionKind::face_without_caster, face, 0.0, 0.0, texels});
    }
  }
  plan.status = plan.map_count > 0 ? PlanStatus::ok
                : any_receiver     ? PlanStatus::no_caster
                                   : PlanStatus::nothing_visible;
}

/// Replaces the plan's maps.
void plan_frusta(const PositionalLight& p, const Light& light, ShadowPlan& plan) noexcept {
  plan.map_count = plan.omission_count = 0;
  const PlanOptions& options = p.options;
  if (options.fit == Fit::stable && options.warp != nullptr && options.warp != &warps::none)
    omit(plan, {OmissionKind::warp_in_stable_fit, -1, 0.0, 0.0, 0});
  const auto* spot = std::get_if<SpotLight>(&light);
  if (spot == nullptr) {
    plan_cube(p, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, nullptr, plan);
  } else if (spot->outer_radians < kWidestSingle) {
    plan_cone(p, plan.light_direction, spot->outer_radians, plan);
  } else {
    const Cone cone{plan.light_direction, spot->outer_radians};
    plan_cube(p, fixed_frame(plan.light_direction), &cone, plan);
  }
}

}  // namespace

void plan_positional(const Camera& camera, const Light& light, const SceneBounds& bounds,
                     const PlanOptions& options, double prune_m, ShadowPlan& plan) noexcept {
  const auto* spot = std::get_if<SpotLight>(&light);
  const auto* point = std::get_if<PointLight>(&light);
  if (spot == nullptr && point == nullptr) return;
  Camera eye = camera;
  eye.position = glm::dvec3(0.0);
  const CameraAxes axes = camera_axes(camera);
  PositionalLight p{(spot != nullptr ? spot->position : point->position) - camera.position,
                    spot != nullptr ? spot->range : point->range,
                    frustum_slice(camera, axes, camera.near_depth, camera.far_depth),
                    eye,
                    axes,
                    camera.position,
                    bounds,
                    options,
                    equal_sizes(options.map_size),
                    prune_m};
  plan.select_by_map = true;
  // A light whose whole range is rounding of its position reaches no pixel.
  constexpr double kLeastRange = 1e-12;
  if (p.range <= kLeastRange * largest_component(p.apex)) p.lit.vertex_count = 0;
  clip(p.lit, Box{p.apex - glm::dvec3(p.range), p.apex + glm::dvec3(p.range)});
  if (!p.lit.empty()) clip(p.lit, visible_bounds(p.lit, bounds.receivers, camera.position));
  plan.light_direction = spot != nullptr ? safe_normalize(spot->direction, {0.0, -1.0, 0.0})
                                         : safe_normalize(-p.apex, axes.forward);
  if (p.lit.empty()) {
    plan.status = PlanStatus::nothing_visible;
    return;
  }
  plan_frusta(p, light, plan);
  if (options.texel_budget == 0) return;
  p.sizes = budgeted_sizes(plan, options, 6, true);
  plan_frusta(p, light, plan);
}

bool map_holds(const ShadowPlan& plan, const ShadowMap& map, const glm::dvec3& point) noexcept {
  for (int i = 0; i < map.select_plane_count; ++i) {
    const glm::dvec4& plane = map.select_planes[static_cast<std::size_t>(i)];
    if (!(glm::dot(glm::dvec3(plane), point) + plane.w >= 0.0)) return false;
  }
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(point, 1.0);
  // A quarter texel of the rim is left to rounding; no kernel tells it apart.
  constexpr double kRounding = 0.5;
  const double inner_x = 1.0 - (2.0 * map.filter_margin_texels - kRounding) / map.width;
  const double inner_y = 1.0 - (2.0 * map.filter_margin_texels - kRounding) / map.height;
  const double lowest = plan.clip_space.ndc_depth == NdcDepth::zero_to_one ? 0.0 : -1.0;
  return clip.w > 0.0 && std::abs(clip.x) <= inner_x * clip.w && std::abs(clip.y) <= inner_y * clip.w &&
         clip.z >= lowest * clip.w && clip.z <= clip.w;
}

int map_serving(const ShadowPlan& plan, const glm::dvec3& point, double depth) noexcept {
  if (plan.select_by_map) {
    for (int i = 0; i < plan.map_count; ++i) {
      if (map_holds(plan, plan.map[static_cast<std::size_t>(i)], point)) return i;
    }
    return -1;
  }
  for (int i = 0; i < plan.map_count; ++i) {
    const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    if (depth >= map.depth_begin && depth <= map.depth_end) return i;
  }
  // Who computes the depth of a corner on the last map's end gets there but for rounding: of the depth
  // itself, and of the position it was computed from.
  constexpr double kDepthRounding = 1e-12, kPositionRounding = 4e-13;
  const double slack =
      kDepthRounding * std::abs(depth) +
      kPositionRounding * max_of(largest_component(point), largest_component(plan.origin_world));
  for (int i = 0; i < plan.map_count; ++i) {
    const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    if (depth >= map.depth_begin - slack && depth <= map.depth_end + slack) return i;
  }
  return -1;
}

}  // namespace gnomon
