// Divides the receivers by the faces of the camera's frustum, by a plane where warping ends, or by clusters.
// Based on: Mikkelsen, "Separating-plane perspective shadow mapping", 2007.
#include "plan/parts.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "geometry/light_axes.hpp"
#include "geometry/slab.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "lanes/elementary.hpp"
#include "map/gain.hpp"
#include "plan/clusters.hpp"
#include "plan/faces.hpp"
#include "plan/part.hpp"

namespace gnomon {
namespace {

/// A body parted by a plane across the direction that its warp grows in.
struct Separation {
  glm::dvec3 axis;
  double near_end, length;
};

/// The side before the plane at `at` of the length, warped, or the one behind it, unwarped.
Part side_part(const ParallelScene& scene, const Separation& s, double begin, double end, int side,
               double at) noexcept {
  const double border = s.near_end + s.length * at;
  Part part;
  part.begin = begin;
  part.end = end;
  part.index = side;
  part.frame = scene.space.frame;
  part.warp = side == 0 ? &scene.warp : &warps::none;
  part.plane[0] = side == 0 ? Plane{-s.axis, border} : Plane{s.axis, -border};
  part.plane_count = 1;
  return part;
}

/// Logarithm of a map's texels per area of the light plane, in the middle of the body's corners on the plane
/// at `at`.
double log_density(const PlaneMap& map, const LightFrame& frame,
                   std::span<const glm::dvec3> corners) noexcept {
  const WarpChoice& choice = map.choice;
  const double area = (map.a_max - map.a_min) * (map.b_max - map.b_min);
  const double rows = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  double sum = 0.0;
  for (const glm::dvec3& p : corners)
    sum += elementary::log(map.w(glm::dot(p, frame.x), glm::dot(p, frame.y)));
  return elementary::log(map.stretch * std::abs(rows) / area) -
         3.0 * sum / static_cast<double>(corners.size());
}

/// How many times as dense, as a logarithm, the texels of the map before the plane are there as those of the
/// map behind it, both fitted to their sides. `known` is false where one side has nothing.
double density_step(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                    const Separation& s, double begin, double end, double at, bool& known) noexcept {
  std::array<PlaneMap, 2> map;
  std::array<glm::dvec3, kMaxVertices> corners;
  std::size_t count = 0;
  const double border = s.near_end + s.length * at;
  for (int side = 0; side < 2; ++side) {
    Part part = side_part(scene, s, begin, end, side, at);
    part.body = body;
    clip(part.body, part.plane[0]);
    if (part.body.empty()) {
      known = false;
      return 0.0;
    }
    if (side == 0) {
      // Corners that the cut has made.
      constexpr double kOnPlane = 1e-9;
      for (const Polytope::Vertex& v : part.body.vertices()) {
        if (std::abs(glm::dot(s.axis, v.position) - border) <= kOnPlane * s.length)
          corners[count++] = v.position;
      }
    }
    narrow_depths(c, part);
    map[static_cast<std::size_t>(side)] = focused_plane(c, request_of(part));
  }
  known = count > 0;
  const std::span<const glm::dvec3> on_plane{corners.data(), count};
  return known ? log_density(map[0], scene.space.frame, on_plane) -
                     log_density(map[1], scene.space.frame, on_plane)
               : 0.0;
}

/// Where along the length both maps' texels are as dense as each other: the nearer the plane, the denser the
/// first map's and the sparser the second's. Below 0: nowhere, as the first map's best warp changes at once.
double separating_place(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                        const Separation& s, double begin, double end, double first) noexcept {
  constexpr int kSteps = 24;
  constexpr double kEqual = 0.02;  // of the logarithm: 2 % of the density
  double low = 0.0, high = 1.0, at = first;
  for (int i = 0; i < kSteps; ++i) {
    bool known = false;
    const double step = density_step(c, scene, body, s, begin, end, at, known);
    if (!known) break;
    if (std::abs(step) <= kEqual) return at;
    (step > 0.0 ? low : high) = at;
    // Lengths count by their ratio near the viewer, and by their difference far from him.
    at = low > 0.0 ? std::sqrt(low * high) : 0.5 * high;
    if (high < 4.0 * low) at = 0.5 * (low + high);
  }
  return -1.0;
}

/// The part before the plane where warping ends, and the one behind; none where nothing is warped.
Parts separated_parts(const PlanContext& c, const ParallelScene& scene, const Polytope& body, double begin,
                      double end) noexcept {
  Parts parts;
  const PlaneMap map = focused_plane(c, request_for(scene, body, begin, end));
  if (!(map.choice.kappa > 0.0)) return parts;
  const LightFrame& frame = scene.space.frame;
  const Separation s{frame.x * map.choice.axis.x + frame.y * map.choice.axis.y, map.u_min, map.length};
  const double at =
      separating_place(c, scene, body, s, begin, end, separating_share(map.choice.kappa, map.length));
  parts.no_place = at < 0.0;
  if (parts.no_place) return parts;
  for (int side = 0; side < 2; ++side) add_part(c, body, side_part(scene, s, begin, end, side, at), parts);
  return parts;
}

/// The objective of so many cascades, each warped.
double cascades_objective(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                          double begin, double end, int count) noexcept {
  const CascadeEdges edges = cascade_edges(c, scene, count, nullptr);
  Parts cascades;
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(edges.count); ++i) {
    Part part;
    part.begin = max_of(begin, edges.depth[i]);
    part.end = min_of(end, edges.depth[i + 1]);
    part.frame = scene.space.frame;
    part.warp = &scene.warp;
    part.plane[0] = {c.axes.forward, -part.begin};
    part.plane[1] = {-c.axes.forward, part.end};
    part.plane_count = 2;
    add_part(c, body, part, cascades);
  }
  return cascades.count > 0 ? cascades.objective : std::numeric_limits<double>::infinity();
}

/// How many cascades a partition must be better than; 0: none.
int rival_cascades(const PlanContext& c) noexcept {
  switch (c.options.split.partition) {
    case Partition::separating_plane:
      return 2;
    case Partition::receiver_clusters:
      return c.options.cascades > 1 ? c.options.cascades : 0;
    default:
      return 0;
  }
}

Parts divided(const PlanContext& c, const ParallelScene& scene, const Polytope& body, double begin,
              double end) noexcept {
  if (c.options.split.partition == Partition::receiver_clusters)
    return receiver_clusters(c, scene, body, begin, end);
  // Without perspective one map's texels are right everywhere.
  if (c.camera.orthographic) return {};
  if (c.options.split.partition == Partition::separating_plane)
    return separated_parts(c, scene, body, begin, end);
  return frustum_faces(c, scene, body, begin, end);
}

void plan_part(const PlanContext& c, const Part& part, ShadowPlan& plan) noexcept {
  MapRequest request = request_of(part);
  request.slot.cascade = part.index;
  request.slot.depth_begin = part.begin;
  request.slot.depth_end = part.end;
  request.slot.width = request.slot.height = c.options.resolution.max_size;
  request.slot.select = part.plane;
  request.slot.select_count = part.plane_count;
  request.without_casters = !c.options.prune.has(PruneRule::casterless_cascades);
  MapResult result(next_map(plan));
  focused_map(c, request, result);
  merge(result,
        {OmissionKind::part_without_caster, part.index, part.begin, part.end, texels_asked(c.options)},
        nullptr, plan);
}

}  // namespace

void plan_parts(const PlanContext& c, const ParallelScene& scene, ShadowPlan& plan) noexcept {
  const CascadeEdges range = cascade_edges(c, scene, 1, nullptr);
  for (int i = 0; i < range.omission_count; ++i) omit(plan, range.omission[static_cast<std::size_t>(i)]);
  const double begin = range.depth[0], end = range.depth[1];
  Polytope body = scene.body;
  clip_to_slab(body, c.axes.forward, begin, end);
  Parts whole;
  Part all;
  all.begin = begin;
  all.end = end;
  all.frame = scene.space.frame;
  all.warp = &scene.warp;
  add_part(c, body, all, whole);
  const Parts parts = divided(c, scene, body, begin, end);
  const bool gains = parts.count > 1 && parts.objective < whole.objective * (1.0 - kLeastGain);
  const bool clusters = c.options.split.partition == Partition::receiver_clusters;
  if (const int rivals = rival_cascades(c); rivals > 0 && (gains || parts.no_place || clusters)) {
    const double cascades = cascades_objective(c, scene, body, begin, end, rivals);
    const double beaten = gains ? parts.objective : whole.objective * (1.0 - kLeastGain);
    if (cascades < beaten) {
      // As many maps, and better ones.
      plan_cascades(c, scene, rivals, equal_sizes(c.options.resolution.max_size), nullptr, plan);
      omit(plan, {OmissionKind::partition_without_gain, -1, beaten / cascades, 0.0, 0});
      return;
    }
  }
  if (!gains) {
    const double ratio = parts.count > 1 ? parts.objective / whole.objective : 1.0;
    omit(plan, {OmissionKind::partition_without_gain, -1, ratio, 0.0, 0});
  }
  if (gains && parts.most_maps) {
    const double fewest = parts.fewest_slices, asked = c.options.split.face_slices;
    omit(plan, {OmissionKind::faces_less_divided, -1, fewest, asked, 0});
  }
  plan.select_by_map = gains;
  const Parts& chosen = gains ? parts : whole;
  for (int i = 0; i < chosen.count; ++i) plan_part(c, chosen.part[static_cast<std::size_t>(i)], plan);
}

}  // namespace gnomon
