// Fits a map for each part of the receivers, where a partition gains on one map and on as many cascades.
// Planes in place of marks on objects let any shader choose the map of a point. A box that a plane cuts
// serves in both parts.
#include "plan/parts.hpp"

#include "geometry/vector.hpp"
#include "plan/partition/part.hpp"

namespace gnomon {
namespace {

using namespace partition;

/// The objective of so many cascades, each warped.
[[gnu::noinline]] double cascades_objective(const PlanContext& c, const ParallelScene& scene,
                                            const Polytope& body, double begin, double end,
                                            int count) noexcept {
  const CascadeEdges edges = cascade_edges(c, scene, count, nullptr);
  PartsSum cascades;
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(edges.count); ++i) {
    Part part;
    part.begin = max_of(begin, edges.depth[i]);
    part.end = min_of(end, edges.depth[i + 1]);
    part.frame = scene.space.frame;
    part.warp = &scene.warp;
    part.plane[0] = {c.axes.forward, -part.begin};
    part.plane[1] = {-c.axes.forward, part.end};
    part.plane_count = 2;
    weigh_part(c, body, part, cascades);
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

/// Divides the body as the options ask; no parts where that is of no use.
void divide(const PlanContext& c, const ParallelScene& scene, const Polytope& body, double begin, double end,
            Parts& parts) noexcept {
  if (c.options.split.partition == Partition::receiver_clusters)
    return receiver_clusters(c, scene, body, begin, end, parts);
  // Without perspective one map's texels are right everywhere.
  if (c.camera.orthographic) return;
  if (c.options.split.partition == Partition::separating_plane)
    return separated_parts(c, scene, body, begin, end, parts);
  frustum_faces(c, scene, body, begin, end, parts);
}

[[gnu::noinline]] void plan_part(const PlanContext& c, const Polytope& body, const Part& part,
                                 ShadowPlan& plan) noexcept {
  const Polytope inside = inside_of(c, body, part);
  MapRequest request = request_of(part, inside);
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
  Part all;
  all.begin = begin;
  all.end = end;
  all.frame = scene.space.frame;
  all.warp = &scene.warp;
  PartsSum whole;
  weigh_part(c, body, all, whole);
  Parts parts;
  divide(c, scene, body, begin, end, parts);
  const bool gains = parts.sum.count > 1 && parts.sum.objective < whole.objective * (1.0 - kLeastGain);
  const bool clusters = c.options.split.partition == Partition::receiver_clusters;
  if (const int rivals = rival_cascades(c); rivals > 0 && (gains || parts.no_balance || clusters)) {
    const double cascades = cascades_objective(c, scene, body, begin, end, rivals);
    const double beaten = gains ? parts.sum.objective : whole.objective * (1.0 - kLeastGain);
    if (cascades < beaten) {
      // As many maps, and better ones.
      plan_cascades(c, scene, rivals, equal_sizes(c.options.resolution.max_size), nullptr, plan);
      omit(plan, {OmissionKind::partition_without_gain, -1, beaten / cascades, 0.0, 0});
      return;
    }
  }
  if (!gains) {
    const double ratio = parts.sum.count > 1 ? parts.sum.objective / whole.objective : 1.0;
    omit(plan, {OmissionKind::partition_without_gain, -1, ratio, 0.0, 0});
  }
  if (gains && parts.most_maps) {
    const double fewest = parts.fewest_slices, asked = c.options.split.face_slices;
    omit(plan, {OmissionKind::faces_less_divided, -1, fewest, asked, 0});
  }
  plan.selection = gains ? MapSelection::first_holding : MapSelection::view_depth;
  for (int i = 0; gains && i < parts.sum.count; ++i)
    plan_part(c, body, parts.part[static_cast<std::size_t>(i)], plan);
  if (!gains && whole.count > 0) plan_part(c, body, all, plan);
}

}  // namespace gnomon
