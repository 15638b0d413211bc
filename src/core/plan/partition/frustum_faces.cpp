// Divides the receivers by the faces of the camera's frustum that the light enters or leaves it by.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006 (a map for each face,
// side faces divided further along the view): which face gets the next slice is this project's rule.
#include <array>
#include <glm/geometric.hpp>
#include <span>

#include "geometry/light_axes.hpp"
#include "geometry/vector.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/study/formulas.hpp"
#include "plan/partition/part.hpp"

namespace gnomon::partition {
namespace {

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

}  // namespace

void frustum_faces(const PlanContext& c, const ParallelScene& scene, const Polytope& body, double begin,
                   double end, Parts& parts) noexcept {
  add_faces({c, scene, body, begin, end, 1.0}, parts);
  Parts left;
  add_faces({c, scene, body, begin, end, -1.0}, left);
  const bool leaves_better =
      left.sum.count > 0 && (parts.sum.count == 0 || left.sum.objective < parts.sum.objective);
  if (leaves_better) parts = left;
}

}  // namespace gnomon::partition
