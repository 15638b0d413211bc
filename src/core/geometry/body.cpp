// The intersection body: a convex polytope in fixed storage, cut by planes, with faces and adjacency.
#include "gnomon/body.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

// A few hundred units in the last place of the largest distance at hand: above the rounding of a dot product,
// far below anything that shows.
constexpr double kClipTolerance = 1e-13;

constexpr int kCornerFaces[8][3] = {{0, 2, 4}, {1, 2, 4}, {0, 3, 4}, {1, 3, 4},
                                    {0, 2, 5}, {1, 2, 5}, {0, 3, 5}, {1, 3, 5}};

/// Six faces in the order -x +x -y +y -z +z; corner i has bit 0 for +x, bit 1 for +y, bit 2 for +z. Crossing
/// face pair k flips bit k, which is the edge on the two other faces.
void set_cuboid(Polytope& body, const glm::dvec3 (&corner)[8]) noexcept {
  for (int i = 0; i < 8; ++i) {
    Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    v.position = corner[i];
    for (int k = 0; k < 3; ++k) {
      v.face[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(kCornerFaces[i][k]);
      v.neighbour[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(i ^ (1 << k));
    }
  }
  body.vertex_count = 8;
  body.face_count = 6;
}

using VertexSet = std::uint64_t;  // bit i: vertex i
static_assert(kMaxVertices <= 64);

/// New vertices on one face while a plane cuts it: a convex face is crossed twice or not at all.
struct FaceCuts {
  std::uint8_t vertex[2];
  std::uint8_t count;
};

/// An edge from a kept vertex to its neighbour `slot`, which is cut off.
struct CrossingEdge {
  std::uint8_t vertex, slot;
};

/// Puts a vertex on every crossing edge, joins them along the faces they lie on into a new face, and closes
/// the gaps that the lost vertices leave.
void cut(Polytope& body, const Plane& plane, const double* distance, VertexSet kept,
         std::span<const CrossingEdge> crossing, FaceCuts* cuts) noexcept {
  const auto cap = static_cast<std::uint8_t>(body.face_count);
  body.plane[cap] = plane;
  Polytope::Vertex made[kMaxVertices];
  // Kept vertices move down to the first places; new ones follow.
  std::uint8_t renamed[64];
  std::uint8_t next = 0;
  for (VertexSet left = kept; left != 0; left &= left - 1) renamed[std::countr_zero(left)] = next++;
  const std::uint8_t first_new = next;
  for (std::size_t e = 0; e < crossing.size(); ++e) {
    const Polytope::Vertex& v = body.vertex[crossing[e].vertex];
    const std::size_t slot = crossing[e].slot;
    const Polytope::Vertex& lost = body.vertex[v.neighbour[slot]];
    const double from = max_of(distance[crossing[e].vertex], 0.0);
    const double t = from / (from - distance[v.neighbour[slot]]);
    Polytope::Vertex& m = made[e];
    m.position = v.position + (lost.position - v.position) * t;
    m.face = {cap, v.face[(slot + 1) % 3], v.face[(slot + 2) % 3]};
    m.neighbour[0] = renamed[crossing[e].vertex];
    for (std::size_t side = 1; side < 3; ++side) {
      FaceCuts& on_face = cuts[m.face[side]];
      if (on_face.count++ == 0) {
        on_face.vertex[0] = static_cast<std::uint8_t>(e);
        continue;
      }
      // The other new vertex of this face: both are joined by the face's edge with the cap.
      Polytope::Vertex& other = made[on_face.vertex[0]];
      m.neighbour[3 - side] = static_cast<std::uint8_t>(first_new + on_face.vertex[0]);
      other.neighbour[other.face[1] == m.face[side] ? 2 : 1] = static_cast<std::uint8_t>(first_new + e);
    }
  }
  std::size_t e = 0;
  for (VertexSet left = kept; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    Polytope::Vertex v = body.vertex[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 3; ++k) {
      const bool crosses = e < crossing.size() && crossing[e].vertex == i && crossing[e].slot == k;
      v.neighbour[k] = crosses ? static_cast<std::uint8_t>(first_new + e++) : renamed[v.neighbour[k]];
    }
    body.vertex[renamed[i]] = v;
  }
  for (std::size_t i = 0; i < crossing.size(); ++i) body.vertex[first_new + i] = made[i];
  body.vertex_count = static_cast<int>(first_new + crossing.size());
  ++body.face_count;
}

}  // namespace

Polytope& Polytope::operator=(const Polytope& other) noexcept {
  if (this == &other) return *this;
  vertex_count = other.vertex_count;
  face_count = other.face_count;
  std::copy_n(other.vertex.begin(), vertex_count, vertex.begin());
  std::copy_n(other.plane.begin(), face_count, plane.begin());
  return *this;
}

Polytope box_polytope(const Box& box) noexcept {
  Polytope body;
  glm::dvec3 corner[8];
  for (int i = 0; i < 8; ++i) {
    corner[i] = {(i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
                 (i & 4) ? box.max.z : box.min.z};
  }
  set_cuboid(body, corner);
  body.plane[0] = {{1, 0, 0}, -box.min.x};
  body.plane[1] = {{-1, 0, 0}, box.max.x};
  body.plane[2] = {{0, 1, 0}, -box.min.y};
  body.plane[3] = {{0, -1, 0}, box.max.y};
  body.plane[4] = {{0, 0, 1}, -box.min.z};
  body.plane[5] = {{0, 0, -1}, box.max.z};
  return body;
}

Polytope frustum_slice(const Camera& camera, const CameraAxes& axes, double begin, double end) noexcept {
  Polytope body;
  glm::dvec3 corner[8];
  for (int i = 0; i < 8; ++i) {
    const double depth = (i & 4) ? end : begin;
    const double scale = camera.orthographic ? 1.0 : depth;
    corner[i] = axes.right * (((i & 1) ? camera.right : camera.left) * scale) +
                axes.up * (((i & 2) ? camera.top : camera.bottom) * scale) + axes.forward * depth;
  }
  set_cuboid(body, corner);
  // Side planes hold a side edge of slope (x or y) per unit depth and the other image axis.
  const double slope = camera.orthographic ? 0.0 : 1.0;
  const auto side = [&](const glm::dvec3& axis, double edge, double inward) {
    const glm::dvec3 normal =
        (axis - axes.forward * (edge * slope)) * (inward / std::sqrt(1.0 + slope * edge * edge));
    return Plane{normal, camera.orthographic ? -inward * edge : 0.0};
  };
  body.plane[0] = side(axes.right, camera.left, 1.0);
  body.plane[1] = side(axes.right, camera.right, -1.0);
  body.plane[2] = side(axes.up, camera.bottom, 1.0);
  body.plane[3] = side(axes.up, camera.top, -1.0);
  body.plane[4] = {axes.forward, -begin};
  body.plane[5] = {-axes.forward, end};
  return body;
}

void clip(Polytope& body, const Plane& plane) noexcept {
  const int count = body.vertex_count;
  if (count == 0) return;
  double distance[kMaxVertices];
  double lowest = 0.0, largest = std::abs(plane.offset);
  for (int i = 0; i < count; ++i) {
    const glm::dvec3& p = body.vertex[static_cast<std::size_t>(i)].position;
    const double d = plane.normal.x * p.x + plane.normal.y * p.y + plane.normal.z * p.z + plane.offset;
    distance[i] = d;
    lowest = min_of(lowest, d);
    largest = max_of(largest, std::abs(d));
  }
  const double limit = -kClipTolerance * largest;
  if (lowest >= limit) return;
  VertexSet cut_off = 0;
  for (int i = 0; i < count; ++i) cut_off |= VertexSet{distance[i] < limit} << i;
  const VertexSet kept = ~cut_off & (~VertexSet{0} >> (64 - count));
  if (kept == 0) {
    body.vertex_count = 0;
    return;
  }

  // The edges that cross the plane, found first so that an inconsistent cut leaves the body as it was.
  CrossingEdge crossing[kMaxVertices];
  int crossings = 0, kept_count = 0;
  FaceCuts cuts[kMaxFaces] = {};
  for (VertexSet left = kept; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    ++kept_count;
    const Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    for (std::uint8_t k = 0; k < 3; ++k) {
      if (((cut_off >> v.neighbour[k]) & 1) == 0) continue;
      if (crossings == kMaxVertices) return;
      crossing[crossings++] = {static_cast<std::uint8_t>(i), k};
      ++cuts[v.face[(k + 1u) % 3]].count;
      ++cuts[v.face[(k + 2u) % 3]].count;
    }
  }
  if (body.face_count >= kMaxFaces || kept_count + crossings > kMaxVertices) return;
  for (int f = 0; f < body.face_count; ++f) {
    if (cuts[f].count != 0 && cuts[f].count != 2) return;
    cuts[f].count = 0;
  }
  cut(body, plane, distance, kept, {crossing, static_cast<std::size_t>(crossings)}, cuts);
}

void clip(Polytope& body, const Box& box) noexcept {
  if (box.empty()) {
    body.vertex_count = 0;
    return;
  }
  // Planes that miss the body are told from its own box, six comparisons in place of six rounds of distances.
  const Box own = bounds_of(body);
  if (own.min.x < box.min.x) clip(body, Plane{{1, 0, 0}, -box.min.x});
  if (own.max.x > box.max.x) clip(body, Plane{{-1, 0, 0}, box.max.x});
  if (own.min.y < box.min.y) clip(body, Plane{{0, 1, 0}, -box.min.y});
  if (own.max.y > box.max.y) clip(body, Plane{{0, -1, 0}, box.max.y});
  if (own.min.z < box.min.z) clip(body, Plane{{0, 0, 1}, -box.min.z});
  if (own.max.z > box.max.z) clip(body, Plane{{0, 0, -1}, box.max.z});
}

int swept_planes(const Polytope& body, const glm::dvec4& light,
                 std::span<Plane, kMaxCullPlanes> out) noexcept {
  int written = 0;
  // Moved out to touch its own vertices: a normal's rounding must not cut into them.
  const auto add = [&](const glm::dvec3& normal, double lowest) {
    if (written < kMaxCullPlanes) out[static_cast<std::size_t>(written++)] = {normal, -lowest};
  };
  if (body.empty()) return 0;
  double along[kMaxFaces], lowest[kMaxFaces];
  for (int f = 0; f < body.face_count; ++f) {
    const Plane& plane = body.plane[static_cast<std::size_t>(f)];
    along[f] = glm::dot(plane.normal, glm::dvec3(light));
    if (light.w != 0.0) along[f] += plane.offset * light.w;
    lowest[f] = std::numeric_limits<double>::infinity();  // a face without vertices is none
  }
  for (const Polytope::Vertex& v : body.vertices()) {
    for (const std::uint8_t f : v.face) {
      if (along[f] >= 0.0) lowest[f] = min_of(lowest[f], glm::dot(body.plane[f].normal, v.position));
    }
  }
  for (int f = 0; f < body.face_count; ++f) {
    if (lowest[f] < std::numeric_limits<double>::infinity())
      add(body.plane[static_cast<std::size_t>(f)].normal, lowest[f]);
  }
  for (int i = 0; i < body.vertex_count; ++i) {
    const Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (v.neighbour[k] < i) continue;
      const std::uint8_t a = v.face[(k + 1) % 3], b = v.face[(k + 2) % 3];
      if ((along[a] >= 0.0) == (along[b] >= 0.0)) continue;
      // The positive combination of both inward planes that goes through the light: it holds the edge, points
      // inward, and needs no length of the edge.
      const glm::dvec3 both =
          body.plane[a].normal * std::abs(along[b]) + body.plane[b].normal * std::abs(along[a]);
      if (!(largest_component(both) > 0.0)) continue;
      const glm::dvec3 normal = safe_normalize(both, both);
      add(normal,
          min_of(glm::dot(normal, v.position), glm::dot(normal, body.vertex[v.neighbour[k]].position)));
    }
  }
  return written;
}

Box bounds_of(const Polytope& body) noexcept {
  Box box;
  for (const Polytope::Vertex& v : body.vertices()) box.extend(v.position);
  return box;
}

}  // namespace gnomon
