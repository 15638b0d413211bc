// The map of one frustum of a light with a position: focused on the body it shows, warped where that gains.
// Based on: Wimmer, Scherzer, "Robust Shadow Mapping with Light-Space Perspective Shadow Maps", ShaderX4,
// 2006; Brabec, Annen, Seidel, "Practical Shadow Mapping", 2002 (focusing).
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "light_map.hpp"
#include "light_positional.hpp"
#include "map_parts.hpp"
#include "plan_context.hpp"
#include "spot_draft.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

// Room beyond the nearest and farthest distance, relative to them, for float rounding.
constexpr double kDistancePadding = 1.0 / 1024.0;
// Narrowest rectangle, as a slope: below it positions are rounding.
constexpr double kLeastSlope = 1e-8;
// The rim may reach no farther than where the far end's texels are twice as long again.
constexpr double kRimGrowth = 0.5;
// Near over far distance of a map whose depths are not pulled to what is there: 2^10, as engines tend to ask
// for.
constexpr double kLooseNear = 0x1p-10;
// Rounding of positions, relative to their distance from the origin of the world.
constexpr double kPositionRounding = 1e-14;

/// All that the frustum shows.
void whole_frustum(const LightFrustum& frustum, SlopeBody& slopes) noexcept {
  slopes.count = 4;
  for (int i = 0; i < 4; ++i) {
    slopes.point[static_cast<std::size_t>(i)] = {(i & 1) ? frustum.slope : -frustum.slope,
                                                 (i & 2) ? frustum.slope : -frustum.slope, 0.0, 1.0};
  }
}

/// Vertices as slopes; the whole frustum's where rounding has taken a vertex out of it.
SlopeBody in_slopes(const LightFrustum& frustum, const Polytope& body) noexcept {
  SlopeBody result;
  result.nearest = std::numeric_limits<double>::infinity();
  for (const Polytope::Vertex& v : body.vertices())
    result.farthest = max_of(result.farthest, frustum.distance(v.position));
  constexpr double kRounding = 1.0 + 1e-3;
  bool usable = true;
  for (const Polytope::Vertex& v : body.vertices()) {
    const double distance = frustum.distance(v.position);
    usable = usable && distance >= 0.5 * kNearestShare * result.farthest;
    result.nearest = min_of(result.nearest, max_of(distance, kNearestShare * result.farthest));
    if (!usable) continue;
    const glm::dvec2 at = frustum.slopes(v.position);
    usable = max_of(std::abs(at.x), std::abs(at.y)) <= frustum.slope * kRounding;
    result.point[static_cast<std::size_t>(result.count++)] = {at.x, at.y, 0.0, 1.0};
  }
  if (!usable) whole_frustum(frustum, result);
  return result;
}

/// The view direction as the light sees it at the body's point nearest to the viewer, and that point.
struct ViewInSlopes {
  glm::dvec2 axis, nearest;
  double depth;
};

ViewInSlopes view_in_slopes(const Draft& d) noexcept {
  ViewInSlopes result{{0.0, 1.0}, {0.0, 0.0}, std::numeric_limits<double>::infinity()};
  glm::dvec3 nearest(0.0);
  const glm::dvec3 forward = d.light.axes.forward;
  for (const Polytope::Vertex& v : d.body.vertices()) {
    const double depth = glm::dot(forward, v.position);
    if (!(depth < result.depth)) continue;
    result.depth = depth;
    nearest = v.position;
  }
  const LightFrame& frame = d.frustum.frame;
  if (!(d.frustum.distance(nearest) > 0.0)) return result;
  result.nearest = d.frustum.slopes(nearest);
  const double along_z = glm::dot(frame.z, forward);
  const glm::dvec2 move{glm::dot(frame.x, forward) + along_z * result.nearest.x,
                        glm::dot(frame.y, forward) + along_z * result.nearest.y};
  const double length = std::sqrt(glm::dot(move, move));
  // Looking along the light's own ray: below this the axis is noise.
  constexpr double kParallelSine = 1e-3;
  if (length > kParallelSine) result.axis = move / length;
  return result;
}

/// Stretch of the published formula: square root of how much deeper in view the body's far end is than its
/// near end, both at the distance from the light where the line through the nearest point meets its depth.
double published_stretch(const Draft& d, const ViewInSlopes& view) noexcept {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const WarpInput::Point& p : d.slopes.points()) {
    const double u = p.x * view.axis.x + p.y * view.axis.y;
    low = min_of(low, u);
    high = max_of(high, u);
  }
  const double s = view.nearest.x * view.axis.y - view.nearest.y * view.axis.x;
  const auto ray = [&](double u) {
    return d.frustum.ray(view.axis.x * u + view.axis.y * s, view.axis.y * u - view.axis.x * s);
  };
  const glm::dvec3 forward = d.light.axes.forward;
  const double light_depth = glm::dot(forward, d.frustum.apex);
  const double distance = (view.depth - light_depth) / glm::dot(forward, ray(low));
  const double far_depth = light_depth + distance * glm::dot(forward, ray(high));
  const bool usable = distance > 0.0 && view.depth > 0.0 && far_depth > view.depth &&
                      far_depth <= view.depth / std::numeric_limits<float>::epsilon();
  return usable ? std::sqrt(far_depth / view.depth) : 1.0;
}

/// How far a kernel's step of one world unit moves a point in the rectangle as it is now, as a share of its
/// side. A step across the ray at a distance is, as a slope, at most this step over the distance over the
/// cosine to the light's axis.
double share_of_unit(const Draft& d) noexcept {
  if (!(d.light.options.filter_radius_world > 0.0)) return 0.0;
  double steepest = 0.0;
  for (const WarpInput::Point& p : d.slopes.points()) steepest = max_of(steepest, p.x * p.x + p.y * p.y);
  const double slope_per_unit = std::sqrt(1.0 + steepest) / max_of(d.slopes.nearest, d.near_distance);
  return share_per_unit(d.plane, d.slopes.points()) * slope_per_unit;
}

/// The rim that kernels need round the rectangle as it is now.
void lay_rim(Draft& d, ShadowMap& map) noexcept {
  map.filter_margin_texels = margin_texels(d.light.options, map.width, share_of_unit(d));
  d.rim = static_cast<double>(map.filter_margin_texels) / map.width;
}

/// The rectangle round the body's image, as wide as rounding needs it.
PlaneMap rectangle(const Draft& d, const WarpChoice& choice) noexcept {
  PlaneMap plane = plane_map(d.slopes.points(), choice);
  double offset = 0.0;
  for (const Polytope::Vertex& v : d.body.vertices()) offset = max_of(offset, largest_component(v.position));
  const double least = max_of(kLeastSlope, kLeastOfOffset * offset / d.slopes.farthest) / plane.stretch;
  widen(plane.a_min, plane.a_max, least);
  widen(plane.b_min, plane.b_max, least);
  return plane;
}

/// Makes the map as small as light.prune_m lets it. What it shows does not depend on its size, but for a
/// warp, which must not bring the rim any nearer to its horizon than it may be, or is.
void shrink(Draft& d, double texels, ShadowMap& map) noexcept {
  const double share = share_of_unit(d);
  const auto rim = [&](int size) { return margin_texels(d.light.options, size, share); };
  const double beyond = d.plane.stretch - 1.0, now = d.margin();
  const double most =
      beyond > 0.0 ? max_of(now, kRimGrowth / beyond) : std::numeric_limits<double>::infinity();
  // From a share of what the rim surrounds to one of the side.
  const double most_rim = std::isfinite(most) ? most / (1.0 + 2.0 * most) : 0.5;
  map.width = map.height = least_side({texels, d.light.prune_m, most_rim}, map.width, d.light.options, rim);
}

/// The map's bounds of the error, and the size that they ask for.
void judge(Draft& d, const WarpChoice& choice, double least_depth, ShadowMap& map) noexcept {
  // At vertices and edges, whatever the warp was judged by.
  SlopeError extremes(d.light.camera, d.light.axes, d.frustum, d.body, Objective::storage, least_depth);
  (void)extremes.value(choice, d.slopes.points());
  if (d.light.prune_m > 0.0) {
    const double texels = max_of(extremes.m_s(), extremes.m_t());
    d.m_at_full_size = texels / (map.width - 2.0 * map.filter_margin_texels);
    shrink(d, texels, map);
    lay_rim(d, map);
  }
  const double usable = map.width - 2.0 * map.filter_margin_texels;
  map.m_s_max = extremes.m_s() / usable;
  map.m_t_max = extremes.m_t() / usable;
  map.storage = map.m_s_max * map.m_t_max * static_cast<double>(map.width) * map.height /
                (static_cast<double>(d.light.camera.width) * d.light.camera.height);
}

/// The rectangle and its warp; fills in the map's size and its bounds of the error.
void choose_rectangle(Draft& d, bool along_view, ShadowPlan& plan, ShadowMap& map) noexcept {
  const PlanOptions& options = d.light.options;
  const ViewInSlopes view = view_in_slopes(d);
  WarpChoice unwarped;
  if (along_view && options.fit != Fit::stable) unwarped.axis = view.axis;
  WarpChoice choice = unwarped;
  d.plane = rectangle(d, unwarped);
  lay_rim(d, map);
  const double least_depth = max_of(d.light.camera.near_depth, options.near_hint);
  SlopeError error(d.light.camera, d.light.axes, d.frustum, d.body, options.objective, least_depth);
  if (options.fit == Fit::stable) {
    map.warp = &warps::none;
  } else if (map.warp != &warps::none) {
    const double most = 1.0 + kRimGrowth / max_of(d.margin(), 1e-4);
    const FoundWarp found = find_slope_warp(
        error, {d.slopes.points(), unwarped, view.axis, view.nearest, published_stretch(d, view), most},
        *map.warp);
    // A warp that gains less is not worth the depth precision it takes.
    constexpr double kLeastGain = 0.005;
    const bool taken =
        found.choice.kappa > 0.0 && (found.ratio < 1.0 - kLeastGain || !map.warp->drop_without_gain);
    if (taken) {
      choice = found.choice;
    } else {
      omit(plan, {OmissionKind::warp_without_gain, map.cascade, found.ratio, 0.0, 0});
      map.warp = &warps::none;
    }
  }
  d.plane = rectangle(d, choice);
  lay_rim(d, map);
  judge(d, choice, least_depth, map);
}

/// OpenGL clip space from points relative to the camera. Depth: 1 - s (1 / distance - 1 / far) / w, with w of
/// the warp, is -1 at the near plane where w is least.
glm::dmat4 matrix_of(const Draft& d) noexcept {
  // Over (x, y, 1) of the slopes, which is (x, y, distance) of the light frame.
  const glm::dmat4 flat = clip_from_light(d.plane, {0.0, 1.0}, d.rim);
  // Past the near end by the rim, w falls to this; on the body it is at least 1.
  const double least_w = 1.0 / (1.0 + d.margin());
  const double s = 2.0 * least_w / (1.0 / d.near_distance - 1.0 / d.far_distance);
  glm::dmat4 m(0.0);
  m[0] = {flat[0][0], flat[0][1], flat[0][3], flat[0][3]};
  m[1] = {flat[1][0], flat[1][1], flat[1][3], flat[1][3]};
  m[2] = {-flat[3][0], -flat[3][1], -flat[3][3] - s / d.far_distance, -flat[3][3]};
  m[3] = {0.0, 0.0, -s, 0.0};
  glm::dmat4 light_from_relative(1.0);
  const LightFrame& frame = d.frustum.frame;
  for (int column = 0; column < 3; ++column)
    light_from_relative[column] = {frame.x[column], frame.y[column], frame.z[column], 0.0};
  const glm::dvec3 apex = d.frustum.apex;
  light_from_relative[3] = {-glm::dot(frame.x, apex), -glm::dot(frame.y, apex), -glm::dot(frame.z, apex),
                            1.0};
  return m * light_from_relative;
}

Plane near_plane(const LightFrustum& frustum, double distance) noexcept {
  return {-frustum.frame.z, glm::dot(frustum.frame.z, frustum.apex) - distance};
}

/// Depths in whole powers of two, so that the stored ones hold still while the nearest caster moves a little.
void snap_depths(Draft& d, ShadowMap& map) noexcept {
  const int exponent = std::ilogb(d.near_distance);
  d.near_distance = std::ldexp(1.0, exponent);
  d.far_distance = max_of(d.far_distance, d.light.range * (1.0 + kDistancePadding));
  map.snap_key.depth_near = exponent;
  // A texel one world unit from the light.
  map.snap_key.texel = (d.plane.a_max - d.plane.a_min) / (map.width - 2 * map.filter_margin_texels);
  map.snap_key.valid = true;
}

/// Everything that follows from the matrix.
void finish(const Draft& d, const Reach& reach, const glm::dmat4& gl_from_relative, ShadowMap& map) noexcept {
  const PositionalLight& light = d.light;
  for (int i = 0; i < reach.count; ++i) {
    const Plane& p = reach.plane[static_cast<std::size_t>(i)];
    map.cull_planes[static_cast<std::size_t>(i)] =
        glm::dvec4(p.normal, p.offset - glm::dot(p.normal, light.eye_world));
  }
  map.cull_plane_count = reach.count;
  map.kappa = d.plane.choice.kappa;
  const glm::dmat4 from_relative = clip_from_gl_clip(light.options.clip_space) * gl_from_relative;
  map.clip_from_camera_relative = glm::mat4(from_relative);
  map.clip_from_world = from_relative;
  map.clip_from_world[3] = from_relative * glm::dvec4(-light.eye_world, 1.0);
  map.light_world = glm::dvec4(d.frustum.apex + light.eye_world, 1.0);
  map.depth_range_world = d.far_distance - d.near_distance;
  glm::dvec3 centre(0.0);
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  const auto texel_at = [&](const glm::dvec3& p) {
    return texel_extent_world(gl_from_relative, map.width, map.height,
                              safe_normalize(p - d.frustum.apex, -d.frustum.frame.z), p);
  };
  for (const Polytope::Vertex& v : d.body.vertices()) {
    centre += v.position;
    const double depth = glm::dot(light.axes.forward, v.position);
    begin = min_of(begin, depth);
    end = max_of(end, depth);
    // Nearer than the near plane is only rounding.
    if (!(d.frustum.distance(v.position) >= d.near_distance)) continue;
    const glm::dvec2 texel = texel_at(v.position);
    map.texel_world_max = {max_of(map.texel_world_max.x, texel.x), max_of(map.texel_world_max.y, texel.y)};
  }
  centre /= static_cast<double>(d.body.vertex_count);
  map.depth_begin = clamp_to(begin, light.camera.near_depth, light.camera.far_depth);
  map.depth_end = clamp_to(end, map.depth_begin, light.camera.far_depth);
  map.texel_world = texel_at(centre);
  map.texel_world_max = {max_of(map.texel_world_max.x, map.texel_world.x),
                         max_of(map.texel_world_max.y, map.texel_world.y)};
  const double texel = max_of(map.texel_world.x, map.texel_world.y);
  const BiasOptions& bias = light.options.bias;
  map.bias_world = {bias.constant_texels * texel, bias.slope_texels * texel,
                    bias.normal_offset_texels * texel};
}

}  // namespace

bool lay_positional_map(const PositionalLight& light, const LightFrustum& frustum, const Polytope& body,
                        bool in_cube, ShadowPlan& plan, ShadowMap& map) noexcept {
  const bool stable = light.options.fit == Fit::stable;
  Draft d{light, frustum, body, in_slopes(frustum, body), {}, 0.0, 0.0, 0.0, 0.0};
  if (stable) whole_frustum(frustum, d.slopes);
  d.far_distance = d.slopes.farthest * (1.0 + kDistancePadding);
  d.near_distance = d.slopes.nearest * (1.0 - kDistancePadding);
  // A single distance still needs a range: rounding of float over it.
  constexpr double kFlattest = 1e-3;
  d.near_distance = min_of(d.near_distance, d.far_distance * (1.0 - kFlattest));
  const int omitted = plan.omission_count;
  choose_rectangle(d, !in_cube, plan, map);
  const double slack =
      kPositionRounding * max_of(largest_component(light.eye_world), largest_component(frustum.apex));
  const double least_distance = kNearestShare * d.slopes.farthest * (1.0 - kDistancePadding);
  Reach reach = reach_of(d, matrix_of(d), slack);
  // Replaced below, once the nearest caster is known.
  reach.add(near_plane(frustum, least_distance - slack));
  const double caster = nearest_caster(d, reach);
  if (!std::isfinite(caster) && (!in_cube || light.options.prune.has(PruneRule::casterless_faces))) {
    plan.omission_count = omitted;
    return false;
  }
  const double nearest = max_of(caster * (1.0 - kDistancePadding), least_distance);
  d.near_distance = min_of(d.near_distance, nearest);
  if (!light.options.prune.has(PruneRule::light_depths)) {
    d.far_distance = max_of(d.far_distance, light.range * (1.0 + kDistancePadding));
    d.near_distance = min_of(d.near_distance, kLooseNear * d.far_distance);
  }
  if (stable) snap_depths(d, map);
  --reach.count;
  reach.add(near_plane(frustum, d.near_distance - slack));
  finish(d, reach, matrix_of(d), map);
  if (light.prune_m > 0.0) omit_texels(light.options, d.m_at_full_size, map, plan);
  return true;
}

}  // namespace gnomon
