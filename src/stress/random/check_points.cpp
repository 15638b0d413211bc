// Are visible receivers in their maps, and what can shadow them, too?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>
#include <vector>

#include "check.hpp"
#include "exact_map.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::stress {
namespace {

// map_holds leaves a quarter of a texel to rounding: half a texel's share of ndc.
constexpr Real kQuarterTexel = 0.5L;
// A step of a depth buffer of 24 bits, of ndc's two units.
constexpr Real kDepthStep = 0x1p-23L;
// Boxes that are looked at, of thousands; and points of each besides its corners.
constexpr int kMaxBoxes = 10, kBetween = 10;

/// Everything that one point is held against.
struct Scene {
  const Case& input;
  const ShadowPlan& plan;
  View view;
  LightAt light;
  std::vector<RelativeMap> maps;
  std::vector<std::vector<char>> kept;  // of each map: whether a caster passes its cull planes
};

Scene scene_of(const Case& input, const ShadowPlan& plan) {
  const View view(input.camera);
  Scene scene{input, plan, view, LightAt(input.light, view), {}, {}};
  std::vector<std::uint32_t> list(input.casters.size());
  for (const ShadowMap& map : plan.maps()) {
    scene.maps.emplace_back(plan, map, view);
    std::vector<char> kept(input.casters.size(), 0);
    const std::size_t count = std::min(cull_casters(map, input.casters, list), list.size());
    for (std::size_t i = 0; i < count; ++i) kept[list[i]] = 1;
    scene.kept.push_back(std::move(kept));
  }
  return scene;
}

struct Blocker {
  std::size_t index;
  Real enter, leave;
};

std::vector<Blocker> blockers(const Scene& s, const Real3& p, std::size_t most) {
  std::vector<Blocker> found;
  const Real3 way = s.light.way(p);
  for (std::size_t i = 0; i < s.input.casters.size() && found.size() < most; ++i) {
    const RayHit hit = clear_hit(s.view, s.input.casters[i], p, way, s.light.end());
    if (hit.hits) found.push_back({i, hit.enter, hit.leave});
  }
  return found;
}

std::string at(const Scene& s, const Real3& p) {
  std::ostringstream text;
  text.precision(9);
  const Real3 world = p + s.view.eye;
  text << " at (" << static_cast<double>(world.x) << ", " << static_cast<double>(world.y) << ", "
       << static_cast<double>(world.z) << "), depth " << static_cast<double>(s.view.depth(p));
  return text.str();
}

std::string number(Real value) {
  std::ostringstream text;
  text.precision(9);
  text << static_cast<double>(value);
  return text.str();
}

std::string name(const ShadowMap& map) {
  return "map " + std::to_string(map.cascade) + " (" + std::string(map.warp->name) + ")";
}

/// The map that serves the point by its depth: its index, kNone, or kEither at a border that rounding
/// decides.
constexpr int kNone = -1, kEither = -2;
int map_at_depth(const Scene& s, const Real3& p) {
  const Real z = s.view.depth(p);
  constexpr Real kDepthRounding = 2e-12L, kPositionRounding = 1e-12L;  // about twice map_serving's own
  const Real slack =
      kDepthRounding * std::abs(z) + kPositionRounding * (largest(p + s.view.eye) + largest(s.view.eye));
  constexpr Real kOwn = 1e-15L;  // of this arithmetic
  int found = kNone, near = 0;
  for (int i = 0; i < s.plan.map_count; ++i) {
    const ShadowMap& map = s.plan.map[static_cast<std::size_t>(i)];
    const Real own = kOwn * std::abs(z);
    if (z >= map.depth_begin - slack && z <= map.depth_end + slack) ++near;
    if (z >= map.depth_begin - own && z <= map.depth_end + own) found = i;
  }
  return near == 0 ? kNone : near == 1 && found >= 0 ? found : kEither;
}

/// The kind of finding under this light: what holds for parallel light and not for local ones, or the other
/// way round, has another cause.
std::string_view kind_for(const Scene& s, std::string_view parallel, std::string_view local) {
  return s.light.parallel() ? parallel : local;
}

/// How many texels a place lies inside the filter margin along an axis, below 0: outside, and what is not
/// known of that.
struct Inside {
  Real texels, error;
};
Inside inside_margin(const ShadowMap& map, const Shown& shown, int axis) {
  const Real size = axis == 0 ? map.width : map.height;
  if (map.shape->affine)
    return {0.5L * size * (1.0L - std::abs(shown.ndc(axis))) - map.filter_margin_texels,
            0.5L * size * shown.ndc_error(axis)};
  const glm::dvec2 ndc(static_cast<double>(shown.ndc(0)), static_cast<double>(shown.ndc(1)));
  const ShapedPoint at = map.texels().place(ndc);
  const Real texel = at.texel[axis];
  // The shape's own arithmetic, in doubles.
  constexpr Real kShape = 1e-11L;
  return {std::min(texel, size - texel) - map.filter_margin_texels,
          std::abs(Real(at.texel_from_ndc[0][axis])) * (shown.ndc_error(0) + kShape) +
              std::abs(Real(at.texel_from_ndc[1][axis])) * (shown.ndc_error(1) + kShape)};
}

/// Clip coordinates against the map's border, off the filter margin, and its depths.
void check_receiver(const Scene& s, int index, const Real3& p, Report& report) {
  const auto k = static_cast<std::size_t>(index);
  const ShadowMap& map = s.plan.map[k];
  const Shown shown = s.maps[k].show(p);
  if (!(shown.clip.w > 0.0L) || shown.clip.w < shown.error.w) {
    if (shown.clip.w <= -shown.error.w)
      report.add("receiver_behind_map", static_cast<double>(-shown.clip.w),
                 name(map) + ": w is " + number(shown.clip.w) + at(s, p));
    return;
  }
  for (int axis = 0; axis < 2; ++axis) {
    const Inside inside = inside_margin(map, shown, axis);
    const Real beyond = -inside.texels - 0.5L * kQuarterTexel - inside.error;
    if (beyond > 0.0L)
      report.add("receiver_outside_map", static_cast<double>(beyond),
                 name(map) + ": " + (axis == 0 ? "x" : "y") + " is " + number(shown.ndc(axis)) + ", " +
                     number(beyond) + " texels into the margin of " +
                     std::to_string(map.filter_margin_texels) + at(s, p));
  }
  const Real deep = std::abs(shown.ndc(2)) - 1.0L - shown.ndc_error(2) - kDepthStep;
  if (deep > 0.0L)
    report.add("receiver_outside_depths", static_cast<double>(deep),
               name(map) + ": ndc depth is " + number(shown.ndc(2)) + at(s, p));
}

/// The plan says that what is this near to a local light casts no shadow: the place itself, or all between it
/// and the light.
bool said_too_near(const Scene& s, const ShadowMap& map, const Real3& q) {
  const glm::dvec4 light = map.light_world;
  if (light.w == 0.0) return false;
  const Real3 from_light = q - s.light.apex();
  const auto* spot = std::get_if<SpotLight>(&s.input.light);
  // Maps of a solid's faces measure along their axes, which lie within 54.8 degrees of every direction of a
  // cube's face, and within 70.6 of a tetrahedron's.
  constexpr Real kCube = 1.75L, kTetrahedron = 3.02L;
  const bool solid = spot == nullptr || map.select_plane_count > 0;
  const Real least_cosine = 1.0L / (map.select_plane_count == 3 ? kTetrahedron : kCube);
  const Real distance = solid ? length(from_light) * least_cosine : glm::dot(from_light, s.light.axis());
  for (const Omission& o : s.plan.omitted()) {
    if (o.kind == OmissionKind::depth_near_light && o.map == map.cascade && distance < o.a) return true;
  }
  return false;
}

void check_caster(const Scene& s, int index, const Real3& p, const Blocker& blocker, Report& report) {
  const auto k = static_cast<std::size_t>(index);
  const ShadowMap& map = s.plan.map[k];
  const std::string caster = name(map) + ": caster " + std::to_string(blocker.index);
  if (s.kept[k][blocker.index] == 0)
    report.add(kind_for(s, "caster_culled", "local_caster_culled"), 1.0,
               caster + " shadows a receiver" + at(s, p));
  for (const Real t : {blocker.enter, blocker.leave}) {
    const Real3 q = p + s.light.way(p) * t;
    const Shown shown = s.maps[k].show(q);
    if (!(shown.clip.w > shown.error.w)) {
      if (shown.clip.w < -shown.error.w)
        report.add("caster_behind_map", static_cast<double>(-shown.clip.w),
                   caster + ": w is " + number(shown.clip.w) + at(s, q));
      continue;
    }
    const Real z = shown.ndc(2), room = 1.0L + shown.ndc_error(2) + kDepthStep;
    if (z < -room && !said_too_near(s, map, q))
      report.add(kind_for(s, "caster_before_near_plane", "local_caster_before_near_plane"),
                 static_cast<double>(-z - 1.0L),
                 caster + ": ndc depth is " + number(z) + at(s, q) + ", shadows" + at(s, p));
    if (z > room)
      report.add("caster_beyond_far_plane", static_cast<double>(z - 1.0L),
                 caster + ": ndc depth is " + number(z) + at(s, q) + ", shadows" + at(s, p));
  }
}

/// Both matrices of a map at a point, each with the rounding of its own numbers.
void check_matrices(const Scene& s, int index, const Real3& p, Report& report) {
  const auto k = static_cast<std::size_t>(index);
  const ShadowMap& map = s.plan.map[k];
  const Real4x4 floats(map.clip_from_camera_relative);
  const Real4 world = s.maps[k].matrix() * Real4(p, 1.0L), relative = floats * Real4(p, 1.0L);
  Real4 error = s.maps[k].world_error(p);
  // A float each, and what is below the least float.
  constexpr Real kFloat = 0x1p-23L, kLeastFloat = 0x1p-126L;
  for (int row = 0; row < 4; ++row) {
    error[row] += kFloat * std::abs(floats[3][row]) + kLeastFloat;
    for (int c = 0; c < 3; ++c)
      error[row] += (kFloat * std::abs(floats[c][row]) + kLeastFloat) * std::abs(p[c]);
  }
  // Depths from 0 on are half of what OpenGL's rows for z and w have, with the rounding of both.
  if (s.plan.clip_space.ndc_depth == NdcDepth::zero_to_one) error.z += 0.5L * s.maps[k].world_error(p).w;
  if (!(world.w > 2.0L * error.w)) return;  // no quotient of which anything is known
  for (int row = 0; row < 3; ++row) {
    const Real a = world[row] / world.w, b = relative[row] / relative.w;
    // The last: a float's own rounding of ndc, far below a texel.
    const Real bound = 2.0L * (error[row] + std::max(std::abs(a), std::abs(b)) * error.w) / world.w + kFloat;
    const Real apart = std::abs(a - b);
    if (!(apart <= bound))
      report.add("matrices_disagree", static_cast<double>(apart),
                 name(map) + ": " + "xyz"[row] + " is " + number(a) + " by the world's, " + number(b) +
                     " by the camera's matrix, apart " + number(apart) + " of at most " + number(bound) +
                     at(s, p));
  }
}

/// Texels at the point against what the map says of its largest.
void check_texel(const Scene& s, int index, const Real3& p, Report& report) {
  const auto k = static_cast<std::size_t>(index);
  const ShadowMap& map = s.plan.map[k];
  const Shown shown = s.maps[k].show(p);
  // Only where positions are far finer than texels.
  constexpr Real kFine = 1e-4L, kLoose = 5e-4L;
  const Real side = std::max(map.width, map.height);
  if (!(std::max(shown.ndc_error(0), shown.ndc_error(1)) * side < kFine)) return;
  // Each matrix has the rounding of its own numbers.
  const Real3 travel = s.light.travel(p);
  for (const bool by_world : {true, false}) {
    const glm::dmat4 matrix = by_world ? map.clip_from_world : glm::dmat4(map.clip_from_camera_relative);
    const Real3 point = by_world ? p + s.view.eye : p;
    if (!(texel_rounding(matrix, by_world ? kWorldRounding : kFloatRounding, point, travel) < kLoose))
      continue;
    ++report.counts().texels;
    const glm::dvec2 texel = texel_extent_world(matrix, map.texels(), glm::dvec3(travel), glm::dvec3(point));
    for (int axis = 0; axis < 2; ++axis) {
      const Real ratio = Real(texel[axis]) / map.texel_world_max[axis];
      if (!(ratio <= 1.0L + 2.0L * kLoose))
        report.add("texel_larger_than_largest", static_cast<double>(ratio),
                   name(map) + ": a texel is " + number(texel[axis]) + ", texel_world_max " +
                       number(map.texel_world_max[axis]) + at(s, p));
    }
  }
}

void check_unmapped(const Scene& s, const Real3& p, Report& report) {
  if (!s.view.clearly_sees(p)) return;
  ++report.counts().unmapped;
  if (s.plan.status == PlanStatus::nothing_visible) {
    report.add(kind_for(s, "nothing_visible_with_receiver", "local_nothing_visible_with_receiver"), 1.0,
               "a receiver is visible" + at(s, p));
    return;
  }
  const auto found = blockers(s, p, 1);
  if (found.empty()) return;
  const bool said = std::any_of(s.plan.maps().begin(), s.plan.maps().end(),
                                [&](const ShadowMap& map) { return said_too_near(s, map, p); });
  if (said) return;
  report.add(s.plan.status == PlanStatus::no_caster
                 ? kind_for(s, "no_caster_with_caster", "local_no_caster_with_caster")
                 : kind_for(s, "no_map_with_caster", "local_no_map_with_caster"),
             1.0, "caster " + std::to_string(found[0].index) + " shadows a receiver" + at(s, p));
}

/// By depth: the receiver is in its map whatever the map shows.
void check_by_depth(const Scene& s, const Real3& p, Report& report) {
  const int index = map_at_depth(s, p);
  if (index == kNone) return check_unmapped(s, p, report);
  if (index == kEither) return;
  ++report.counts().receivers;
  check_receiver(s, index, p, report);
  check_matrices(s, index, p, report);
  check_texel(s, index, p, report);
  if (!s.view.clearly_sees(p)) return;
  for (const Blocker& blocker : blockers(s, p, 4)) {
    ++report.counts().casters;
    check_caster(s, index, p, blocker, report);
  }
}

/// By map: the first that holds the point, clear of its border, or none.
void check_by_map(const Scene& s, const Real3& p, Report& report) {
  const glm::dvec3 world(p + s.view.eye);
  const int index = map_serving(s.plan, world, static_cast<double>(s.view.depth(p)));
  if (index < 0) return check_unmapped(s, p, report);
  ++report.counts().receivers;
  check_matrices(s, index, p, report);
  const ShadowMap& map = s.plan.map[static_cast<std::size_t>(index)];
  const Shown shown = s.maps[static_cast<std::size_t>(index)].show(p);
  for (int axis = 0; axis < 2; ++axis) {
    const Inside inside = inside_margin(map, shown, axis);
    if (!(inside.texels > inside.error)) return;
  }
  if (!s.view.clearly_sees(p)) return;
  for (const Blocker& blocker : blockers(s, p, 4)) {
    ++report.counts().casters;
    check_caster(s, index, p, blocker, report);
  }
}

}  // namespace

std::vector<glm::dvec3> seen_places(const Case& input) {
  const View view(input.camera);
  std::vector<glm::dvec3> places;
  Random random(input.receivers.size() + 1);
  const auto all = static_cast<int>(input.receivers.size());
  for (int i = 0; i < std::min(all, kMaxBoxes); ++i) {
    const int box = all <= kMaxBoxes ? i : random.pick(all);
    for (const Real3& p : seen_points(view, input.receivers[static_cast<std::size_t>(box)],
                                      input.camera.near_depth, input.camera.far_depth, kBetween, random))
      places.emplace_back(p + view.eye);
  }
  return places;
}

void check_points(const Case& input, const ShadowPlan& plan, std::span<const glm::dvec3> seen,
                  Report& report) {
  const Scene scene = scene_of(input, plan);
  for (const glm::dvec3& world : seen) {
    const Real3 p = Real3(world) - scene.view.eye;
    if (!scene.light.clearly_lights(p)) continue;
    if (plan.selection != MapSelection::view_depth)
      check_by_map(scene, p, report);
    else
      check_by_depth(scene, p, report);
  }
}

}  // namespace gnomon::stress
