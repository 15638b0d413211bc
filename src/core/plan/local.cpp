// Which frusta a spot or point light is divided into, and which of the visible receivers each of them holds.
#include "plan/local.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "cull/sweep.hpp"
#include "geometry/light_axes.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "lanes/elementary.hpp"
#include "map/shared_views.hpp"
#include "map/size.hpp"
#include "plan/budget.hpp"
#include "plan/merge.hpp"
#include "plan/spot_maps.hpp"

namespace gnomon {
namespace {

// Half angle below which a cone leaves the face behind it dark: 180 degrees less the face's corner, at slope
// sqrt(2), less the faces' overlap.
constexpr double kLeavesBackDark = 2.184;
constexpr int kCubeFaces = 6;
// A spot has other maps than its angle's where the error of those is larger by this factor.
constexpr double kLeastGain = 1.02;
// Neighbouring faces share this much, as a slope: rounding in a shader must not open a seam.
constexpr double kFaceOverlap = 1.0 / 512.0;
// Slope of the narrowest cone: narrower ones get a map this wide.
constexpr double kNarrowest = 1e-6;

/// One frustum of a local light: a whole spot, or what one face of a solid round the light shows.
struct LocalFrustum {
  glm::dvec3 apex;   // relative to the camera
  LightFrame frame;  // z against the frustum's axis
  double slope;      // all of it is |x| <= slope * distance, |y| <= slope * distance
  std::array<glm::dvec3, kMaxSelectPlanes> side;  // unit, across the axis, outwards
  std::size_t side_count;
  double side_slope;  // how far it reaches along each side, per unit of distance
  [[nodiscard]] double distance(const glm::dvec3& point) const noexcept {
    return glm::dot(frame.z, apex - point);
  }
};

/// The light and the receivers that it can light and the camera sees, relative to the camera.
struct LocalScene {
  const PlanContext& c;
  const Warp& warp;
  glm::dvec3 apex, apex_world;
  double range;
  Polytope lit;  // before any frustum of the light cuts them
  MapSizes sizes;
  PlanHistory* history;
};

/// Keeps what is `slope` or less along `side` per unit of distance along the axis.
Plane slope_plane(const LocalFrustum& frustum, const glm::dvec3& side, double slope) noexcept {
  const glm::dvec3 normal = safe_normalize(-frustum.frame.z * slope - side, -frustum.frame.z);
  return {normal, -glm::dot(normal, frustum.apex)};
}
/// Keeps what is at least `distance` along the axis.
Plane distance_plane(const LocalFrustum& frustum, double distance) noexcept {
  return {-frustum.frame.z, glm::dot(frustum.frame.z, frustum.apex) - distance};
}

void clip_to_sides(Polytope& body, const LocalFrustum& frustum) noexcept {
  for (std::size_t i = 0; i < frustum.side_count; ++i)
    clip(body, slope_plane(frustum, frustum.side[i], frustum.side_slope));
}

LocalFrustum square_frustum(const glm::dvec3& apex, const LightFrame& frame, double slope) noexcept {
  return {apex, frame, slope, {frame.x, -frame.x, frame.y, -frame.y}, 4, slope};
}

// Axes of the faces of a tetrahedron: the first looks down the world's -y, where floors are, the others a
// third above the horizon.
constexpr double kThird = 1.0 / 3.0, kBack = 0.9428090415820634;       // sqrt(8 / 9)
constexpr double kSideways = 0.816496580927726, kAhead = kBack * 0.5;  // sqrt(2 / 3)
constexpr std::array<glm::dvec3, 4> kTetrahedron = {
    glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(0.0, kThird, kBack), glm::dvec3(kSideways, kThird, -kAhead),
    glm::dvec3(-kSideways, kThird, -kAhead)};

/// The frustum through one face of a tetrahedron: a triangle whose sides are at a slope of sqrt(2)
/// from the axis, and whose corners are at twice that.
LocalFrustum triangle_frustum(const glm::dvec3& apex, std::size_t face) noexcept {
  const glm::dvec3& axis = kTetrahedron[face];
  const double slope = std::sqrt(2.0) + kFaceOverlap;
  LocalFrustum frustum{apex, {}, 2.0 * slope, {}, 0, slope};
  for (std::size_t other = 0; other < kTetrahedron.size(); ++other) {
    if (other == face) continue;
    const glm::dvec3 across = kTetrahedron[other] - axis * glm::dot(kTetrahedron[other], axis);
    frustum.side[frustum.side_count++] = safe_normalize(across, axis);
  }
  // Rows along a side: the triangle fills more of its rectangle.
  frustum.frame = frame_along(axis, frustum.side[0]);
  return frustum;
}

/// Cuts off what lies nearer to an eye beyond the range than the light reaches: the cube round the range goes
/// on to there, and its nearest points would decide the error.
void clip_towards_eye(LocalScene& scene) noexcept {
  const double distance = glm::length(scene.apex);
  // Rounding of the range must not cut what is lit.
  constexpr double kRoom = 1.0 + 1e-9;
  const double reach = scene.range * kRoom;
  if (!(distance > reach)) return;
  const glm::dvec3 from_eye = scene.apex / distance;
  clip(scene.lit, Plane{from_eye, reach - distance});
}

/// Distance in front of which the frustum shows nothing: where boxes leave it open, a share of the farthest
/// lit receiver's; where receivers are known to be nearer, theirs.
NearCut nearest_shown(const LocalScene& scene, const LocalFrustum& frustum, const Polytope& body,
                      double farthest) noexcept {
  const double stand_in = scene.c.options.light_near_share * farthest;
  const NearBoxes boxes = nearest_inside({body.plane.data(), static_cast<std::size_t>(body.face_count)}, body,
                                         scene.c.bounds.receivers, scene.c.camera.position, frustum.frame.z,
                                         frustum.apex, kLeastNearShare * farthest);
  constexpr double kRoom = 1.0 - 1.0 / 1024.0;
  return {min_of(stand_in, max_of(boxes.nearest * kRoom, kLeastNearShare * farthest)), boxes.too_near};
}

/// Cuts off the apex, which has no slope, and everything farther than the range or too near to tell depths
/// apart. `receivers`: the boxes that the body is to hold parts of, none for all that the frustum shows.
/// Returns where it cut the near end off, distance 0 where nothing was there.
[[gnu::noinline]] NearCut clip_to_distances(const LocalScene& scene, Polytope& body,
                                            const LocalFrustum& frustum, const Boxes& receivers) noexcept {
  const Plane far_plane = distance_plane(frustum, scene.range);
  clip(body, {-far_plane.normal, -far_plane.offset});
  // A share of what lies beside the receivers could be farther than all of them.
  clip_part(body, receivers, scene.c.camera.position);
  double farthest = 0.0, offset = largest_component(frustum.apex);
  for (const Polytope::Vertex& v : body.vertices()) {
    farthest = max_of(farthest, frustum.distance(v.position));
    offset = max_of(offset, largest_component(v.position));
  }
  // In the light's own plane, all but the rounding of positions: nothing there has a slope.
  constexpr double kRounding = 1e-13;
  if (!(farthest > kRounding * offset)) {
    body.vertex_count = 0;
    return {};
  }
  const NearCut cut = nearest_shown(scene, frustum, body, farthest);
  const bool cuts = std::any_of(body.vertices().begin(), body.vertices().end(), [&](const auto& vertex) {
    return frustum.distance(vertex.position) < cut.distance;
  });
  if (!cuts) return {};
  clip(body, distance_plane(frustum, cut.distance));
  clip_part(body, receivers, scene.c.camera.position);
  return cut;
}

/// The cone that a cube is clipped by; without one everything is lit.
struct Cone {
  glm::dvec3 direction;
  double outer;
};

/// Clips a face that looks sideways from the cone's direction: along it, the cone's edge is at a slope of
/// cot(outer) where it is nearest to the direction (up to 90 degrees) or farthest from it (beyond).
void clip_to_cone(Polytope& body, const LocalFrustum& face, const Cone& cone) noexcept {
  const double cotangent = elementary::cos(cone.outer) / elementary::sin(cone.outer);
  const double slope = cotangent > 0.0 ? cotangent : cotangent * (std::sqrt(2.0) + kFaceOverlap);
  if (slope <= -face.slope) return;
  clip(body, slope_plane(face, -cone.direction, -slope));
}

/// All that a face shows, for a map that no receiver asks for.
[[gnu::noinline]] void fill_face(const LocalScene& scene, const LocalFrustum& face, Polytope& body) noexcept {
  body = box_polytope({scene.apex - glm::dvec3(scene.range), scene.apex + glm::dvec3(scene.range)});
  clip_to_sides(body, face);
  if (!body.empty()) clip_to_distances(scene, body, face, {});
}

/// Light space turned so that y runs along the view as the light sees it at the body's point nearest to the
/// viewer, with x of that point.
struct TurnedSpace {
  LightSpace space;
  double centre = 0.0;
};

TurnedSpace along_view(const PlanContext& c, const LocalFrustum& frustum, const Polytope& body) noexcept {
  double depth = std::numeric_limits<double>::infinity();
  glm::dvec3 nearest(0.0);
  for (const Polytope::Vertex& v : body.vertices()) {
    const double at = glm::dot(c.axes.forward, v.position);
    if (!(at < depth)) continue;
    depth = at;
    nearest = v.position;
  }
  const LightFrame& frame = frustum.frame;
  TurnedSpace turned{{frame, true, frame.turned(frustum.apex)}, 0.0};
  const glm::dvec3 at = frame.turned(nearest);
  if (!(turned.space.distance(at) > 0.0)) return turned;
  const glm::dvec3 slopes = turned.space.project(at), forward = frame.turned(c.axes.forward);
  const glm::dvec2 move{forward.x + forward.z * slopes.x, forward.y + forward.z * slopes.y};
  const double length = std::sqrt(glm::dot(move, move));
  // Looking along the light's own ray: below this the axis is noise.
  constexpr double kParallelSine = 1e-3;
  const glm::dvec2 axis = length > kParallelSine ? move / length : glm::dvec2(0.0, 1.0);
  turned.space.frame = {frame.x * axis.y - frame.y * axis.x, frame.x * axis.x + frame.y * axis.y, frame.z};
  turned.space.apex = turned.space.frame.turned(frustum.apex);
  turned.centre = slopes.x * axis.y - slopes.y * axis.x;
  return turned;
}

[[gnu::noinline]] MapRequest request_for(const LocalScene& scene, const LocalFrustum& frustum,
                                         const Polytope& body, int face, bool of_solid) noexcept {
  const PlanContext& c = scene.c;
  const TurnedSpace turned = c.how.stable
                                 ? TurnedSpace{{frustum.frame, true, frustum.frame.turned(frustum.apex)}, 0.0}
                                 : along_view(c, frustum, body);
  MapRequest request{{}, body,          turned.space, scene.warp,  0.0,   0.0,
                     {}, turned.centre, 0.0,          scene.range, false, {}};
  // A turned square is wider by its diagonal.
  request.slope = c.how.stable ? frustum.slope : frustum.slope * std::sqrt(2.0);
  // Without a warp a face keeps its square: turned, the whole face would need twice the texels.
  if (of_solid && !c.how.stable)
    request.unwarped.axis = {glm::dot(frustum.frame.y, turned.space.frame.x),
                             glm::dot(frustum.frame.y, turned.space.frame.y)};
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const Polytope::Vertex& v : body.vertices()) {
    const double depth = glm::dot(c.axes.forward, v.position);
    begin = min_of(begin, depth);
    end = max_of(end, depth);
  }
  MapSlot& slot = request.slot;
  slot.cascade = face;
  slot.width = scene.sizes.of[static_cast<std::size_t>(face)].width;
  slot.height = scene.sizes.of[static_cast<std::size_t>(face)].height;
  slot.depth_begin = request.begin = clamp_to(begin, c.camera.near_depth, c.camera.far_depth);
  slot.depth_end = request.end = clamp_to(end, slot.depth_begin, c.camera.far_depth);
  request.last = last_map(scene.history, face);
  request.apex_world = scene.apex_world;
  if (!of_solid) return request;
  request.without_casters = !c.options.prune.has(PruneRule::casterless_faces);
  // A face serves what lies in it: its map has the casters of that, and may show more.
  for (std::size_t i = 0; i < frustum.side_count; ++i)
    slot.select[static_cast<std::size_t>(slot.select_count++)] =
        slope_plane(frustum, frustum.side[i], frustum.side_slope);
  return request;
}

/// Out of line, as others below: maps of one view need not make room for the points of several.
[[gnu::noinline]] void fit_to_views(const PlanContext& c, MapRequest& request, MapResult& result) noexcept {
  const ViewedPoints viewed = viewed_within(c, request.body);
  request.viewed = viewed.points();
  focused_map(c, request, result);
}

void fit_local(const PlanContext& c, MapRequest& request, MapResult& result) noexcept {
  if (c.views.empty()) {
    focused_map(c, request, result);
  } else {
    fit_to_views(c, request, result);
  }
}

[[gnu::noinline]] void plan_cone(const LocalScene& scene, const glm::dvec3& direction, double outer,
                                 ShadowPlan& plan) noexcept {
  const LocalFrustum frustum =
      square_frustum(scene.apex, fixed_frame(direction), max_of(elementary::tan(outer), kNarrowest));
  Polytope body = scene.lit;
  clip_to_sides(body, frustum);
  // Four more planes round the cone cut the square's corners off.
  const glm::dvec3 a = (frustum.frame.x + frustum.frame.y) * std::sqrt(0.5);
  const glm::dvec3 b = (frustum.frame.x - frustum.frame.y) * std::sqrt(0.5);
  for (const glm::dvec3& side : {a, -a, b, -b}) clip(body, slope_plane(frustum, side, frustum.slope));
  NearCut cut;
  if (!body.empty()) cut = clip_to_distances(scene, body, frustum, scene.c.bounds.receivers);
  if (body.empty()) {
    if (cut.boxes > 0) omit(plan, near_receivers(cut, 0));
    plan.status = PlanStatus::nothing_visible;
    return;
  }
  MapRequest request = request_for(scene, frustum, body, 0, false);
  request.near_cut = cut;
  MapResult result(next_map(plan));
  fit_local(scene.c, request, result);
  if (result.drawn) merge(result, {}, scene.history, plan);
  plan.status = plan.map_count > 0 ? PlanStatus::ok : PlanStatus::no_caster;
}

/// Adds the map of one face, or says why it has none. True where it has a receiver.
[[gnu::noinline]] bool plan_face(const LocalScene& scene, const LocalFrustum& frustum, int face,
                                 const Cone* cone, bool dark, ShadowPlan& plan) noexcept {
  const PruneRules& prune = scene.c.options.prune;
  Polytope body = scene.lit;
  if (dark) body.vertex_count = 0;
  clip_to_sides(body, frustum);
  if (cone != nullptr) clip_to_cone(body, frustum, *cone);
  NearCut cut;
  if (!body.empty()) cut = clip_to_distances(scene, body, frustum, scene.c.bounds.receivers);
  if (body.empty() && !dark && !prune.has(PruneRule::empty_faces)) fill_face(scene, frustum, body);
  if (body.empty()) {
    Omission face_omission{OmissionKind::face_without_receiver, face, 0.0, 0.0, 0};
    if (cut.boxes > 0) face_omission = near_receivers(cut, face);
    face_omission.saves_texels = texels_asked(scene.c.options);
    omit(plan, face_omission);
    return cut.boxes > 0;
  }
  MapRequest request = request_for(scene, frustum, body, face, true);
  request.near_cut = cut;
  MapResult result(next_map(plan));
  fit_local(scene.c, request, result);
  merge(result, {OmissionKind::face_without_caster, face, 0.0, 0.0, texels_asked(scene.c.options)},
        scene.history, plan);
  return true;
}

PlanStatus status_of_faces(const ShadowPlan& plan, bool any_receiver) noexcept {
  if (plan.map_count > 0) return PlanStatus::ok;
  return any_receiver ? PlanStatus::no_caster : PlanStatus::nothing_visible;
}

/// Six faces in the order +x -x +y -y +z -z of `base`.
void plan_cube(const LocalScene& scene, const LightFrame& base, const Cone* cone, ShadowPlan& plan) noexcept {
  bool any_receiver = false;
  for (int face = 0; face < kCubeFaces; ++face) {
    // Face 5 looks along the cone's direction, face 4 away from it.
    const bool dark = cone != nullptr && face == 4 && cone->outer < kLeavesBackDark;
    const LocalFrustum frustum = square_frustum(scene.apex, face_frame(base, face), 1.0 + kFaceOverlap);
    any_receiver |= plan_face(scene, frustum, face, face < 4 ? cone : nullptr, dark, plan);
  }
  plan.status = status_of_faces(plan, any_receiver);
}

/// Four faces in the order of kTetrahedron.
void plan_tetrahedron(const LocalScene& scene, ShadowPlan& plan) noexcept {
  bool any_receiver = false;
  for (std::size_t face = 0; face < kTetrahedron.size(); ++face)
    any_receiver |=
        plan_face(scene, triangle_frustum(scene.apex, face), static_cast<int>(face), nullptr, false, plan);
  plan.status = status_of_faces(plan, any_receiver);
}

/// Replaces the plan's maps.
[[gnu::noinline]] void plan_frusta(const LocalScene& scene, const Light& light, const Resolved& resolved,
                                   LocalMaps maps, ShadowPlan& plan) noexcept {
  plan.map_count = plan.omission_count = 0;
  omit(plan, resolved.of_maps);
  const auto* spot = std::get_if<SpotLight>(&light);
  if (maps == LocalMaps::tetrahedron) {
    plan_tetrahedron(scene, plan);
  } else if (spot == nullptr) {
    plan_cube(scene, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, nullptr, plan);
  } else if (maps == LocalMaps::cone) {
    plan_cone(scene, plan.light_direction, spot->outer_radians, plan);
  } else {
    const Cone cone{plan.light_direction, spot->outer_radians};
    plan_cube(scene, fixed_frame(plan.light_direction), &cone, plan);
  }
}

/// A trial that leaves nothing to remember tells the sizes; `plan` keeps its maps.
[[gnu::noinline]] MapSizes sizes_within_budget(const LocalScene& scene, const Light& light,
                                               const Resolved& resolved, LocalMaps maps,
                                               ShadowPlan& plan) noexcept {
  PlanContext trial = scene.c;
  trial.how.forget();
  const LocalScene equal{trial,       scene.warp, scene.apex,  scene.apex_world,
                         scene.range, scene.lit,  scene.sizes, nullptr};
  plan_frusta(equal, light, resolved, maps, plan);
  const int faces = maps == LocalMaps::tetrahedron ? static_cast<int>(kTetrahedron.size()) : kCubeFaces;
  return TexelDemands(scene.c, plan, true).within_budget(faces);
}

/// The error of these maps as large as the scene's sizes are; `plan` keeps them.
[[gnu::noinline]] double drawn_error(const LocalScene& scene, const Light& light, const SpotLight& spot,
                                     const Resolved& resolved, LocalMaps maps, ShadowPlan& plan) noexcept {
  plan_frusta(scene, light, resolved, maps, plan);
  return seen_error(scene.c, spot, plan, scene.sizes);
}

/// Sizes within the budget for `maps` or, where their error is smaller, for a spot's other ones, which `maps`
/// is set to.
[[gnu::noinline]] void choose_maps(LocalScene& scene, const Light& light, const Resolved& resolved,
                                   LocalMaps& maps, ShadowPlan& plan) noexcept {
  const MapSizes sizes = sizes_within_budget(scene, light, resolved, maps, plan);
  const auto* spot = std::get_if<SpotLight>(&light);
  if (spot == nullptr || !weighs_both(scene.c, *spot, resolved)) {
    scene.sizes = sizes;
    return;
  }
  const double error = seen_error(scene.c, *spot, plan, sizes);
  const LocalMaps other = maps == LocalMaps::cone ? LocalMaps::cube : LocalMaps::cone;
  const MapSizes other_sizes = sizes_within_budget(scene, light, resolved, other, plan);
  scene.sizes = sizes;
  if (!(seen_error(scene.c, *spot, plan, other_sizes) < error)) return;
  // A map of few texels may be worse than a large one tells: its border is wide.
  const double drawn = drawn_error(scene, light, *spot, resolved, maps, plan);
  scene.sizes = other_sizes;
  if (drawn_error(scene, light, *spot, resolved, other, plan) * kLeastGain < drawn) {
    maps = other;
  } else {
    scene.sizes = sizes;
  }
}

}  // namespace

void plan_local(const PlanContext& c, const Light& light, const Resolved& resolved, PlanHistory* history,
                ShadowPlan& plan) noexcept {
  const auto* spot = std::get_if<SpotLight>(&light);
  const auto* point = std::get_if<PointLight>(&light);
  if (spot == nullptr && point == nullptr) return;
  const Camera& camera = c.camera;
  const PlanOptions& options = c.options;
  const glm::dvec3& apex_world = spot != nullptr ? spot->position : point->position;
  LocalScene scene{c,
                   *c.how.warp,
                   apex_world - camera.position,
                   apex_world,
                   spot != nullptr ? spot->range : point->range,
                   view_body(c),
                   equal_sizes(options.resolution.max_size),
                   history};
  plan.selection = MapSelection::first_holding;
  // A light whose whole range is rounding of its position reaches no pixel.
  constexpr double kLeastRange = 1e-12;
  if (scene.range <= kLeastRange * largest_component(scene.apex)) scene.lit.vertex_count = 0;
  clip(scene.lit, Box{scene.apex - glm::dvec3(scene.range), scene.apex + glm::dvec3(scene.range)});
  clip_towards_eye(scene);
  if (!scene.lit.empty()) clip(scene.lit, visible_bounds(scene.lit, c.bounds.receivers, camera.position));
  plan.light_direction = spot != nullptr ? safe_normalize(spot->direction, {0.0, -1.0, 0.0})
                                         : safe_normalize(-scene.apex, c.axes.forward);
  if (scene.lit.empty()) {
    plan.status = PlanStatus::nothing_visible;
    return;
  }
  LocalMaps maps = maps_by_angle(light, resolved);
  if (options.resolution.texel_budget > 0) choose_maps(scene, light, resolved, maps, plan);
  plan_frusta(scene, light, resolved, maps, plan);
}

}  // namespace gnomon
