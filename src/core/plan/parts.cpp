// Divides the receivers by the faces of the camera's frustum, by a plane where warping ends, or by clusters.
// Based on: Mikkelsen, "Separating-plane perspective shadow mapping", 2007. Lloyd et al., "Warping and
// Partitioning for Low Error Shadow Maps", 2006 (a map for each face, side faces divided further along the
// view): which face gets the next slice is this project's rule. Forsyth, "Extremely Practical Shadows", Game
// Developers Conference, 2006 (receivers in groups with a focused map each); Bentley, "Multidimensional
// binary search trees used for associative searching", 1975 (groups by halving along the axes). Planes in
// place of marks on objects let any shader choose the map of a point. A box that a plane cuts serves in both.
#include "plan/parts.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/study/formulas.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "geometry/body.hpp"
#include "geometry/light_axes.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "gnomon/plan.hpp"
#include "lanes/elementary.hpp"
#include "map/gain.hpp"
#include "plan/cascades.hpp"

namespace gnomon {
namespace {

/// Dividing must gain this much, or it would come and go with the last bits of the input.
constexpr double kLeastGain = 1e-3;

/// A part, without its body: bodies are long, and are cut anew where they are needed.
struct Part {
  std::array<Plane, kMaxSelectPlanes> plane;  // relative to the camera
  int plane_count = 0;
  int index = 0;
  LightFrame frame;
  const Warp* warp;
  double begin, end;       // view depths
  double objective = 0.0;  // of its map alone
};

/// What the maps of some parts come to.
struct PartsSum {
  int count = 0;
  double objective = 0.0;
};

struct Parts {
  std::array<Part, kMaxMaps> part;
  PartsSum sum;             // of the parts, so many of which are used
  bool no_balance = false;  // a plane was looked for, and none has both maps equally dense
  bool most_maps = false;   // more slices of faces would lower the objective, and there is no map for them
  int fewest_slices = 0;    // that a face has which could be divided further
};

// Parts overlap by this much of the body's distance, and of the camera's from the origin of the world: a
// point must not fall between three of them by rounding.
constexpr double kOverlap = 1e-12, kPositionRounding = 1e-14;

MapRequest request_of(const Part& part, const Polytope& body) noexcept {
  LightSpace space;
  space.frame = part.frame;
  return {{}, body, space, *part.warp, part.begin, part.end, {}, 0.0, 0.0, 0.0, false, {}};
}

/// What of `body` is inside the part's planes.
Polytope inside_of(const PlanContext& c, const Polytope& body, const Part& part) noexcept {
  Polytope inside = body;
  for (int i = 0; i < part.plane_count; ++i) clip(inside, part.plane[static_cast<std::size_t>(i)]);
  if (part.plane_count > 0) clip_part(inside, c.bounds.receivers, c.camera.position);
  return inside;
}

/// Cuts the part's depths to those of `body`.
void narrow_depths(const PlanContext& c, const Polytope& body, Part& part) noexcept {
  const DepthRange depths = depths_of(body, c.axes.forward);
  part.begin = max_of(part.begin, min_of(depths.begin, part.end));
  part.end = clamp_to(depths.end, part.begin, part.end);
}

/// Adds the part to what all of them come to, with the objective of its map, where anything of `body` is
/// inside its planes; false where nothing is. This and others below are out of line: together they would take
/// more stack than any of them.
[[gnu::noinline]] bool weigh_part(const PlanContext& c, const Polytope& body, Part& part,
                                  PartsSum& sum) noexcept {
  double farthest = 0.0;
  for (const Polytope::Vertex& v : body.vertices())
    farthest = max_of(farthest, largest_component(v.position));
  const double overlap = kOverlap * farthest + kPositionRounding * largest_component(c.camera.position);
  for (int i = 0; i < part.plane_count; ++i) part.plane[static_cast<std::size_t>(i)].offset += overlap;
  const Polytope inside = inside_of(c, body, part);
  if (inside.empty()) return false;
  if (part.plane_count > 0) narrow_depths(c, inside, part);
  part.objective = focused_objective(c, request_of(part, inside)).value;
  sum.objective = c.options.warp.objective == Objective::storage ? sum.objective + part.objective
                                                                 : max_of(sum.objective, part.objective);
  ++sum.count;
  return true;
}

/// Adds what of `body` is inside the part's planes, where anything is.
bool add_part(const PlanContext& c, const Polytope& body, Part part, Parts& parts) noexcept {
  const auto place = static_cast<std::size_t>(parts.sum.count);
  if (!weigh_part(c, body, part, parts.sum)) return false;
  parts.part[place] = part;
  return true;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// In the order left, right, bottom, top, near, far.
constexpr std::size_t kFrustumFaces = 6, kSideFaces = 4, kNearFace = 4, kFarFace = 5;
// Sine below which a face lies along the light: nothing enters by it.
constexpr double kAlongLight = 1e-9;

/// What is divided, and the faces that the light enters the frustum by (sign 1) or leaves it by (sign -1).
struct Frustum {
  const PlanContext& c;
  const ParallelScene& scene;
  const Polytope& body;
  double begin, end;
  std::array<Plane, kFrustumFaces> plane;    // relative to the camera, inwards
  std::array<double, kFrustumFaces> facing;  // sine of the light above the face; used above kAlongLight
  double along_view;                         // the same of a plane across the view

  [[gnu::noinline]] Frustum(const PlanContext& context, const ParallelScene& parallel,
                            const Polytope& divided, double from, double to, double sign) noexcept
      : c(context), scene(parallel), body(divided), begin(from), end(to) {
    const Polytope frustum = frustum_slice(c.camera, c.axes, begin, end);
    for (std::size_t f = 0; f < kFrustumFaces; ++f) {
      plane[f] = frustum.plane[f];
      facing[f] = -sign * glm::dot(plane[f].normal, scene.space.frame.z);
    }
    along_view = -sign * glm::dot(c.axes.forward, scene.space.frame.z);
  }
  [[nodiscard]] bool uses(std::size_t face) const noexcept { return facing[face] > kAlongLight; }
};

/// Across the light, towards where a face gets deeper: there its texels may grow.
LightFrame frame_of_face(const PlanContext& c, const ParallelScene& scene, const Plane& face) noexcept {
  const glm::dvec3 light_direction = -scene.space.frame.z;
  const double facing = glm::dot(face.normal, light_direction);
  const glm::dvec3 deeper =
      c.axes.forward - face.normal * (glm::dot(c.axes.forward, light_direction) / facing);
  // Faces across the view have one depth, and what is left is rounding.
  constexpr double kLevel = 1e-6;
  return largest_component(deeper) > kLevel ? frame_along(light_direction, deeper) : scene.space.frame;
}

/// Through the line that the face and another plane share, parallel to the light; inside is the face's side.
Plane plane_between(const Frustum& all, std::size_t face, const Plane& other, double facing) noexcept {
  const Plane& own = all.plane[face];
  const glm::dvec3 normal = other.normal * all.facing[face] - own.normal * facing;
  const double offset = other.offset * all.facing[face] - own.offset * facing;
  const double length = glm::length(normal);
  return {normal / length, offset / length};
}

/// One slice of a face: the view depths at the face that it lies between; infinite where it ends at the edge.
struct FaceSlice {
  double near_depth = -kInfinity, far_depth = kInfinity;
};

/// The part of a slice. A point is the part of the face that a ray of light through it meets last on its way
/// in, first on its way out: of two faces that is decided by a plane through their common edge, parallel to
/// the light, and of two slices by one through the line that parts them. Lines across the view are parallel
/// to the edges with the near and the far face, so that a slice needs four planes, too.
Part part_of(const Frustum& all, std::size_t face, const FaceSlice& slice, int index) noexcept {
  Part part;
  part.begin = all.begin;
  part.end = all.end;
  part.index = index;
  part.frame = frame_of_face(all.c, all.scene, all.plane[face]);
  part.warp = &all.scene.warp;
  const auto add = [&](const Plane& plane) {
    part.plane[static_cast<std::size_t>(part.plane_count++)] = plane;
  };
  const bool from_edge = slice.near_depth == -kInfinity, to_edge = slice.far_depth == kInfinity;
  for (std::size_t other = 0; other < kFrustumFaces; ++other) {
    // Opposite faces, which come in pairs, share no edge.
    if (other / 2 == face / 2 || !all.uses(other)) continue;
    if ((other == kNearFace && !from_edge) || (other == kFarFace && !to_edge)) continue;
    add(plane_between(all, face, all.plane[other], all.facing[other]));
  }
  const glm::dvec3& forward = all.c.axes.forward;
  if (!from_edge) add(plane_between(all, face, {forward, -slice.near_depth}, all.along_view));
  if (!to_edge) add(plane_between(all, face, {-forward, slice.far_depth}, -all.along_view));
  return part;
}

/// The view depths at which rays of light through a part's body meet its face.
[[gnu::noinline]] DepthRange depths_at_face(const Frustum& all, std::size_t face, const Part& part) noexcept {
  DepthRange depths{all.end, all.begin};
  const Polytope body = inside_of(all.c, all.body, part);
  const Plane& plane = all.plane[face];
  for (const Polytope::Vertex& v : body.vertices()) {
    const double above = glm::dot(plane.normal, v.position) + plane.offset;
    const double depth = glm::dot(all.c.axes.forward, v.position) - above * all.along_view / all.facing[face];
    depths.begin = min_of(depths.begin, max_of(depth, all.begin));
    depths.end = max_of(depths.end, min_of(depth, all.end));
  }
  return depths;
}

/// Calls `add` with the parts of a side face that is divided into `slices`, numbered from `first` on.
template <class Add>
void for_each_slice(const Frustum& all, std::size_t face, const DepthRange& depths, int slices, int first,
                    Add&& add) noexcept {
  std::array<double, kMaxMaps + 1> edge;
  const auto count = static_cast<std::size_t>(slices);
  split_depths(depths.begin, depths.end, all.c.options.split, {edge.data(), count + 1});
  for (std::size_t i = 0; i < count; ++i) {
    FaceSlice slice;
    // Slices of no depth hold nothing; the outermost go on to the face's edges.
    if (i > 0) slice.near_depth = edge[i];
    if (i + 1 < count) slice.far_depth = edge[i + 1];
    if (slice.near_depth >= slice.far_depth) continue;
    first += add(part_of(all, face, slice, first)) ? 1 : 0;
  }
}

/// How a face is divided, and what one more slice would cost.
struct DividedFace {
  std::size_t face = 0;
  DepthRange depths;
  int slices = 1, maps = 1;
  double objective = 0.0;
  int next_maps = 0;
  double next_objective = kInfinity;  // infinite where it may not have one more
};

void weigh_next(const Frustum& all, DividedFace& one) noexcept {
  one.next_objective = kInfinity;
  const bool may = one.face < kSideFaces && one.slices < all.c.options.split.face_slices;
  if (!may || !(one.depths.begin < one.depths.end)) return;
  PartsSum next;
  for_each_slice(all, one.face, one.depths, one.slices + 1, 0,
                 [&](Part part) { return weigh_part(all.c, all.body, part, next); });
  one.next_maps = next.count;
  if (next.objective < one.objective * (1.0 - kLeastGain)) one.next_objective = next.objective;
}

/// The face whose next slice lowers the objective the most; nullptr: none does.
DividedFace* best_to_divide(const Frustum& all, std::span<DividedFace> faces) noexcept {
  const bool sums = all.c.options.warp.objective == Objective::storage;
  DividedFace* best = nullptr;
  double most = 0.0;
  for (DividedFace& one : faces) {
    // Where the largest counts, dividing any but the worst is for nothing.
    const double gain = sums ? one.objective - one.next_objective : one.objective;
    if (!(gain > most)) continue;
    most = gain;
    best = &one;
  }
  return best != nullptr && best->next_objective < kInfinity ? best : nullptr;
}

/// Divides the faces, of which `parts` holds a part each, as far as it pays and maps suffice.
void divide_faces(const Frustum& all, Parts& parts) noexcept {
  std::array<DividedFace, kFrustumFaces> storage;
  const std::span<DividedFace> faces{storage.data(), static_cast<std::size_t>(parts.sum.count)};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Part& part = parts.part[i];
    faces[i].face = static_cast<std::size_t>(part.index);
    faces[i].objective = part.objective;
    if (faces[i].face < kSideFaces) faces[i].depths = depths_at_face(all, faces[i].face, part);
    weigh_next(all, faces[i]);
  }
  int maps = parts.sum.count;
  parts.sum = {};
  while (DividedFace* const next = best_to_divide(all, faces)) {
    if (maps - next->maps + next->next_maps > kMaxMaps) {
      parts.most_maps = true;
      parts.fewest_slices = next->slices;
      break;
    }
    maps += next->next_maps - next->maps;
    next->maps = next->next_maps;
    next->objective = next->next_objective;
    ++next->slices;
    weigh_next(all, *next);
  }
  for (const DividedFace& one : faces) {
    if (one.face < kSideFaces) {
      for_each_slice(all, one.face, one.depths, one.slices, parts.sum.count,
                     [&](const Part& part) { return add_part(all.c, all.body, part, parts); });
    } else {
      add_part(all.c, all.body, part_of(all, one.face, {}, parts.sum.count), parts);
    }
  }
}

void add_faces(const Frustum& all, Parts& parts) noexcept {
  for (std::size_t face = 0; face < kFrustumFaces; ++face) {
    if (all.uses(face)) add_part(all.c, all.body, part_of(all, face, {}, static_cast<int>(face)), parts);
  }
  if (all.c.options.split.face_slices > 1) divide_faces(all, parts);
}

/// Divides the body, whose view depths lie in [begin, end], among the faces that the light enters a
/// perspective camera's frustum by, or leaves it by, whichever set has the lower objective, and each side
/// face into at most SplitOptions::face_slices.
[[gnu::noinline]] void frustum_faces(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                                     double begin, double end, Parts& parts) noexcept {
  add_faces({c, scene, body, begin, end, 1.0}, parts);
  Parts left;
  add_faces({c, scene, body, begin, end, -1.0}, left);
  const bool leaves_better =
      left.sum.count > 0 && (parts.sum.count == 0 || left.sum.objective < parts.sum.objective);
  if (leaves_better) parts = left;
}

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

/// Divides the body, whose view depths lie in [begin, end], into at most PlanOptions::cascades clusters; one
/// where no division lowers the objective of unwarped maps.
[[gnu::noinline]] void receiver_clusters(const PlanContext& c, const ParallelScene& scene,
                                         const Polytope& body, double begin, double end,
                                         Parts& parts) noexcept {
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
    Polytope inside = body;
    clip(inside, part.plane[0]);
    if (inside.empty()) {
      known = false;
      return 0.0;
    }
    if (side == 0) {
      // Corners that the cut has made.
      constexpr double kOnPlane = 1e-9;
      for (const Polytope::Vertex& v : inside.vertices()) {
        if (std::abs(glm::dot(s.axis, v.position) - border) <= kOnPlane * s.length)
          corners[count++] = v.position;
      }
    }
    narrow_depths(c, inside, part);
    map[static_cast<std::size_t>(side)] = focused_plane(c, request_of(part, inside));
  }
  known = count > 0;
  const std::span<const glm::dvec3> on_plane{corners.data(), count};
  return known ? log_density(map[0], scene.space.frame, on_plane) -
                     log_density(map[1], scene.space.frame, on_plane)
               : 0.0;
}

/// Where along the length both maps' texels are as dense as each other: the nearer the plane, the denser the
/// first map's and the sparser the second's. Below 0: nowhere, as the first map's best warp changes at once.
[[gnu::noinline]] double balanced_share(const PlanContext& c, const ParallelScene& scene,
                                        const Polytope& body, const Separation& s, double begin, double end,
                                        double first) noexcept {
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
[[gnu::noinline]] void separated_parts(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                                       double begin, double end, Parts& parts) noexcept {
  const PlaneMap map = focused_plane(c, request_for(scene, body, begin, end));
  if (!(map.choice.kappa > 0.0)) return;
  const LightFrame& frame = scene.space.frame;
  const Separation s{frame.x * map.choice.axis.x + frame.y * map.choice.axis.y, map.u_min, map.length};
  const double at =
      balanced_share(c, scene, body, s, begin, end, separating_share(map.choice.kappa, map.length));
  parts.no_balance = at < 0.0;
  if (parts.no_balance) return;
  for (int side = 0; side < 2; ++side) add_part(c, body, side_part(scene, s, begin, end, side, at), parts);
}

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
