// Divides the receivers into groups, each halved where that lowers the objective the most.
// Based on: Forsyth, "Extremely Practical Shadows", Game Developers Conference, 2006 (receivers in groups
// with a focused map each); Bentley, "Multidimensional binary search trees used for associative searching",
// 1975 (groups by halving along the axes).
#include <array>
#include <span>

#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "gnomon/extend/warp.hpp"
#include "lanes/elementary.hpp"
#include "map/gain.hpp"
#include "plan/partition/part.hpp"

namespace gnomon::partition {
namespace {

/// A group, with the best way to halve it.
struct Cluster {
  std::array<Plane, kMaxSelectPlanes> plane;  // relative to the camera
  int plane_count = 0;
  double cost = 0.0;          // the objective of its map without a warp
  Plane cut;                  // its halves are inside this plane and outside of it
  double halved = kInfinity;  // the objective of both; infinite where no cut lowers it
};

/// Everything that is divided.
struct Divided {
  const PlanContext& c;
  const Polytope& body;
  Part part;  // without planes
  bool sums;  // the objective adds up over maps; else the largest counts

  [[nodiscard]] double together(double a, double b) const noexcept { return sums ? a + b : max_of(a, b); }
};

Plane turned_round(const Plane& plane) noexcept {
  return {-plane.normal, -plane.offset};
}

/// What the cluster's planes leave of the receivers.
Polytope body_of(const Divided& all, const Cluster& cluster) noexcept {
  Polytope body = all.body;
  for (int i = 0; i < cluster.plane_count; ++i) clip(body, cluster.plane[static_cast<std::size_t>(i)]);
  if (cluster.plane_count > 0) clip_part(body, all.c.bounds.receivers, all.c.camera.position);
  return body;
}

/// The objective of a map of this body without a warp; 0 where there is nothing.
[[gnu::noinline]] double cost_of(const Divided& all, const Polytope& body) noexcept {
  if (body.empty()) return 0.0;
  Part part = all.part;
  narrow_depths(all.c, body, part);
  return focused_objective(all.c, request_of(part, body)).unwarped;
}

/// Cuts across the axes of the world, evenly over the body, and across the view where depths count by their
/// ratio.
template <class Try>
void for_each_cut(const Divided& all, const Polytope& body, Try&& attempt) noexcept {
  constexpr int kPlaces = 3;
  const Box box = bounds_of(body);
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.max[axis] - box.min[axis];
    if (!(length > 0.0)) continue;
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    for (int i = 1; i <= kPlaces; ++i) attempt(Plane{normal, -(box.min[axis] + length * i / (kPlaces + 1))});
  }
  const DepthRange depths = depths_of(body, all.c.axes.forward);
  const double begin = max_of(depths.begin, all.part.begin), end = min_of(depths.end, all.part.end);
  if (!(begin > 0.0) || !(end > begin)) return;
  for (const double share : {0.25, 0.5, 0.75})
    attempt(Plane{all.c.axes.forward, -begin * elementary::exp(share * elementary::log(end / begin))});
}

/// Finds the cluster's cost and its best cut.
void weigh(const Divided& all, Cluster& cluster) noexcept {
  const Polytope body = body_of(all, cluster);
  cluster.cost = cost_of(all, body);
  cluster.halved = kInfinity;
  if (body.empty() || cluster.plane_count == kMaxSelectPlanes) return;
  double least = cluster.cost;
  for_each_cut(all, body, [&](const Plane& cut) {
    std::array<double, 2> halves{};
    for (std::size_t side = 0; side < 2; ++side) {
      Polytope half = body;
      clip(half, side == 0 ? cut : turned_round(cut));
      clip_part(half, all.c.bounds.receivers, all.c.camera.position);
      halves[side] = cost_of(all, half);
    }
    const double cost = all.together(halves[0], halves[1]);
    // Both sides must hold something: else the cut is for nothing.
    if (!(cost < least) || halves[0] == 0.0 || halves[1] == 0.0) return;
    least = cluster.halved = cost;
    cluster.cut = cut;
  });
}

/// The cluster whose halving lowers the objective the most; below 0: none does.
int best_to_halve(const Divided& all, std::span<const Cluster> clusters) noexcept {
  int best = -1;
  double most = 0.0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const Cluster& one = clusters[i];
    // Where the largest counts, halving any but the worst is for nothing.
    const double gain = all.sums ? one.cost - one.halved : one.cost;
    if (!(gain > most)) continue;
    most = gain;
    best = static_cast<int>(i);
  }
  return best >= 0 && clusters[static_cast<std::size_t>(best)].halved < kInfinity ? best : -1;
}

}  // namespace

void receiver_clusters(const PlanContext& c, const ParallelScene& scene, const Polytope& body, double begin,
                       double end, Parts& parts) noexcept {
  Divided all{c, body, {}, c.options.warp.objective == Objective::storage};
  all.part.begin = begin;
  all.part.end = end;
  all.part.frame = scene.space.frame;
  all.part.warp = &warps::none;
  std::array<Cluster, kMaxMaps> clusters;
  std::size_t count = 1;
  weigh(all, clusters[0]);
  while (count < static_cast<std::size_t>(c.options.cascades)) {
    const int halved = best_to_halve(all, {clusters.data(), count});
    if (halved < 0) break;
    Cluster& first = clusters[static_cast<std::size_t>(halved)];
    Cluster& second = clusters[count++];
    second = first;
    const auto place = static_cast<std::size_t>(first.plane_count);
    first.plane[place] = first.cut;
    second.plane[place] = turned_round(first.cut);
    ++first.plane_count;
    ++second.plane_count;
    weigh(all, first);
    weigh(all, second);
  }
  for (std::size_t i = 0; i < count; ++i) {
    Part part = all.part;
    part.warp = &scene.warp;
    part.index = static_cast<int>(i);
    part.plane = clusters[i].plane;
    part.plane_count = clusters[i].plane_count;
    add_part(c, body, part, parts);
  }
}

}  // namespace gnomon::partition
