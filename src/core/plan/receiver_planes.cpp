// Which maps do the planes of WarpOptions::planes get, and what of the cascades is left?
// Based on: Chong and Gortler, "A Lixel for Every Pixel", 2004 (one map for each of a few planes of interest,
// and one for everything else).
#include "plan/receiver_planes.hpp"
#include "gnomon/extend/body.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/body.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "plan/cascades.hpp"
#include "warp/registry.hpp"

namespace gnomon {
namespace {

// Sine of the angle between light and plane below which the light lies in the plane: a ray finds no place.
constexpr double kAlongPlane = 1e-6;

/// What is near the plane, and whose place on the plane along the light lies in front of the camera: there
/// the warp's w is above 0.
struct Slab {
  Plane plane;  // relative to the camera
  PlaneMaps::Sides sides;
  Polytope body;
  DepthRange depths;

  void cut(const Plane& by) noexcept {
    sides.plane[static_cast<std::size_t>(sides.count++)] = by;
    clip(body, by);
  }
};

/// Depths of the body that cascades would cover as well.
DepthRange covered_depths(const PlanContext& c, const Polytope& body) noexcept {
  const DepthRange depths = depths_of(body, c.axes.forward);
  return c.visible_depths == nullptr ? depths : visible_range(*c.visible_depths, depths.begin, depths.end);
}

/// Empty where no visible receiver is in it.
void fill(const PlanContext& c, const ParallelScene& scene, const WarpPlane& wanted, Slab& slab) noexcept {
  slab.sides.count = slab.body.vertex_count = 0;
  const glm::dvec3 normal = safe_normalize(wanted.normal, {0.0, 1.0, 0.0});
  const glm::dvec3 light_direction = -scene.space.frame.z;
  const double facing = glm::dot(normal, light_direction);
  if (!(std::abs(facing) > kAlongPlane)) return;
  const double offset = glm::dot(normal, c.camera.position - wanted.point_world);
  slab.plane = {normal, offset};
  slab.body = scene.body;
  slab.cut({normal, offset + wanted.thickness});
  slab.cut({-normal, wanted.thickness - offset});
  clip_part(slab.body, c.bounds.receivers, c.camera.position);
  if (slab.body.empty()) return;
  const DepthRange covered = covered_depths(c, slab.body);
  if (covered.empty()) {
    slab.body.vertex_count = 0;
    return;
  }
  clip_to_slab(slab.body, c.axes.forward, covered.begin, covered.end);
  if (slab.body.empty()) return;
  // A point's depth where its light ray meets the plane, which rises by this from the eye on.
  const double slope = glm::dot(c.axes.forward, light_direction) / facing;
  const glm::dvec3 rise = c.axes.forward - normal * slope;
  const double steepness = glm::length(rise);
  constexpr double kLevel = 1e-6;  // the plane lies across the view: all of it has one depth
  if (!c.camera.orthographic && steepness > kLevel) {
    // Room for thin planes, whose points move little; nearer places stretch the warp more than they are
    // worth.
    constexpr double kNearest = 0.9;
    const double least = kNearest * max_of(covered.begin, c.camera.near_depth);
    slab.cut({rise / steepness, (-offset * slope - least) / steepness});
  }
  clip_part(slab.body, c.bounds.receivers, c.camera.position);
  if (slab.body.empty()) return;
  slab.depths = depths_of(slab.body, c.axes.forward);
  if (!c.visible_points.empty())
    clip_to_points(c, scene.space.frame, slab.depths.begin, slab.depths.end, slab.body);
}

void fit_map(const PlanContext& c, const ParallelScene& scene, const Slab& slab, int index,
             MapResult& result) noexcept {
  MapRequest request{
      {},  slab.body, scene.space, warps::plane_optimal, slab.depths.begin, slab.depths.end, {}, 0.0, 0.0,
      0.0, false,     {}};
  request.receiver = &slab.plane;
  request.slot.cascade = c.options.cascades + index;
  request.slot.depth_begin = slab.depths.begin;
  request.slot.depth_end = slab.depths.end;
  request.slot.width = request.slot.height = c.options.resolution.max_size;
  request.slot.select = slab.sides.plane;
  request.slot.select_count = slab.sides.count;
  request.without_casters = !c.options.prune.has(PruneRule::casterless_cascades);
  focused_map(c, request, result);
}

void select(ShadowMap& map, const glm::dvec4& plane_world) noexcept {
  map.select_planes[static_cast<std::size_t>(map.select_plane_count++)] = plane_world;
}

}  // namespace

PlaneMaps plane_maps(const PlanContext& context, const ParallelScene& scene) noexcept {
  PlaneMaps maps;
  // The plane moves with the world, and its map with the view: there is no steady way to go.
  PlanContext c = context;
  c.how.forget();
  Slab slab;
  for (int i = 0; i < kMaxWarpPlanes; ++i) {
    const WarpPlane& wanted = c.options.warp.planes[static_cast<std::size_t>(i)];
    if (wanted.thickness == 0.0) continue;
    fill(c, scene, wanted, slab);
    const auto leave_out = [&](OmissionKind kind) {
      maps.omission[static_cast<std::size_t>(maps.omission_count++)] = {
          kind, c.options.cascades + i, static_cast<double>(i), 0.0, texels_asked(c.options)};
    };
    if (slab.body.empty()) {
      leave_out(OmissionKind::plane_without_receiver);
      continue;
    }
    const auto at = static_cast<std::size_t>(maps.count);
    MapResult result(maps.map[at]);
    fit_map(c, scene, slab, i, result);
    maps.sides[at] = slab.sides;
    if (!result.drawn) {
      leave_out(OmissionKind::plane_without_caster);
      continue;
    }
    ++maps.count;
    for (const Omission& o : result.omissions())
      maps.of_maps[static_cast<std::size_t>(maps.of_maps_count++)] = o;
  }
  return maps;
}

bool PlaneMaps::Sides::hold(const Polytope& body) const noexcept {
  for (int i = 0; i < count; ++i) {
    const Plane& side = plane[static_cast<std::size_t>(i)];
    for (const Polytope::Vertex& v : body.vertices())
      if (!(glm::dot(side.normal, v.position) + side.offset >= 0.0)) return false;
  }
  return true;
}

bool PlaneMaps::serve(const Polytope& body) const noexcept {
  return std::any_of(sides.begin(), sides.begin() + count,
                     [&](const Sides& of_map) { return of_map.hold(body); });
}

void add_plane_maps(const PlanContext& c, const PlaneMaps& planes, ShadowPlan& plan) noexcept {
  for (int i = 0; i < planes.omission_count; ++i) omit(plan, planes.omission[static_cast<std::size_t>(i)]);
  if (planes.count == 0) return;
  // Maps chosen by what they hold need their depths as planes.
  const glm::dvec3& forward = c.axes.forward;
  const double eye = glm::dot(forward, c.camera.position);
  for (int i = 0; i < plan.map_count && plan.selection != MapSelection::finest; ++i) {
    ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    if (i > 0) select(map, {forward, -eye - map.depth_begin});
    if (i + 1 < plan.map_count) select(map, {-forward, eye + map.depth_end});
  }
  for (int i = plan.map_count; i-- > 0;)
    plan.map[static_cast<std::size_t>(i + planes.count)] = plan.map[static_cast<std::size_t>(i)];
  std::copy_n(planes.map.begin(), planes.count, plan.map.data());
  plan.map_count += planes.count;
  for (int i = 0; i < planes.of_maps_count; ++i) omit(plan, planes.of_maps[static_cast<std::size_t>(i)]);
  if (plan.selection == MapSelection::view_depth) plan.selection = MapSelection::first_holding;
}

}  // namespace gnomon
