// The intersection body: a convex polytope in fixed storage, cut by planes, with faces and adjacency.
#include "gnomon/body.hpp"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "vector.hpp"

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

/// New vertices on one face while a plane cuts it: a convex face is crossed twice or not at all.
struct FaceCuts {
  std::uint8_t vertex[2];
  std::uint8_t count;
};

}  // namespace

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

  // First only count, so that an inconsistent cut leaves the body as it was.
  FaceCuts cuts[kMaxFaces];
  std::memset(cuts, 0, sizeof(FaceCuts) * static_cast<std::size_t>(body.face_count));
  int kept = 0, cut_edges = 0;
  for (int i = 0; i < count; ++i) {
    if (distance[i] < limit) continue;
    ++kept;
    const Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (distance[v.neighbour[k]] >= limit) continue;
      ++cut_edges;
      ++cuts[v.face[(k + 1) % 3]].count;
      ++cuts[v.face[(k + 2) % 3]].count;
    }
  }
  if (kept == 0) {
    body.vertex_count = 0;
    return;
  }
  if (body.face_count >= kMaxFaces || count + cut_edges > kMaxVertices) return;
  for (int f = 0; f < body.face_count; ++f) {
    if (cuts[f].count != 0 && cuts[f].count != 2) return;
    cuts[f].count = 0;
  }

  const auto cap = static_cast<std::uint8_t>(body.face_count);
  body.plane[cap] = plane;
  int next = count;
  for (int i = 0; i < count; ++i) {
    if (distance[i] < limit) continue;
    Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint8_t other = v.neighbour[k];
      if (other >= count || distance[other] >= limit) continue;
      const double from = max_of(distance[i], 0.0);
      const double t = from / (from - distance[other]);
      Polytope::Vertex& made = body.vertex[static_cast<std::size_t>(next)];
      made.position = v.position + (body.vertex[other].position - v.position) * t;
      made.face = {cap, v.face[(k + 1) % 3], v.face[(k + 2) % 3]};
      made.neighbour[0] = static_cast<std::uint8_t>(i);
      for (std::size_t side = 1; side < 3; ++side) {
        FaceCuts& cut = cuts[made.face[side]];
        cut.vertex[cut.count++] = static_cast<std::uint8_t>(next);
      }
      v.neighbour[k] = static_cast<std::uint8_t>(next++);
    }
  }
  // The two new vertices of a face are joined by the face's edge with the cap.
  for (int f = 0; f < body.face_count; ++f) {
    if (cuts[f].count == 0) continue;
    for (int end = 0; end < 2; ++end) {
      Polytope::Vertex& v = body.vertex[cuts[f].vertex[end]];
      v.neighbour[v.face[1] == f ? 2 : 1] = cuts[f].vertex[1 - end];
    }
  }
  ++body.face_count;

  std::uint8_t renamed[kMaxVertices];
  int out = 0;
  for (int i = 0; i < next; ++i) {
    if (i < count && distance[i] < limit) continue;
    renamed[i] = static_cast<std::uint8_t>(out);
    if (out != i) body.vertex[static_cast<std::size_t>(out)] = body.vertex[static_cast<std::size_t>(i)];
    ++out;
  }
  for (int i = 0; i < out; ++i) {
    for (std::uint8_t& n : body.vertex[static_cast<std::size_t>(i)].neighbour) n = renamed[n];
  }
  body.vertex_count = out;
}

void clip(Polytope& body, const Box& box) noexcept {
  if (box.empty()) {
    body.vertex_count = 0;
    return;
  }
  clip(body, Plane{{1, 0, 0}, -box.min.x});
  clip(body, Plane{{-1, 0, 0}, box.max.x});
  clip(body, Plane{{0, 1, 0}, -box.min.y});
  clip(body, Plane{{0, -1, 0}, box.max.y});
  clip(body, Plane{{0, 0, 1}, -box.min.z});
  clip(body, Plane{{0, 0, -1}, box.max.z});
}

int swept_planes(const Polytope& body, const glm::dvec3& direction,
                 std::span<Plane, kMaxCullPlanes> out) noexcept {
  int written = 0;
  // Moved out to touch the body exactly, so that no rounding of a normal cuts into it.
  const auto add = [&](const glm::dvec3& normal) {
    double lowest = glm::dot(normal, body.vertex[0].position);
    for (const Polytope::Vertex& v : body.vertices()) lowest = min_of(lowest, glm::dot(normal, v.position));
    if (written < kMaxCullPlanes) out[static_cast<std::size_t>(written++)] = {normal, -lowest};
  };
  if (body.empty()) return 0;
  bool used[kMaxFaces] = {};
  for (const Polytope::Vertex& v : body.vertices()) {
    for (const std::uint8_t f : v.face) used[f] = true;
  }
  double along[kMaxFaces];
  for (int f = 0; f < body.face_count; ++f) {
    const auto index = static_cast<std::size_t>(f);
    along[f] = glm::dot(body.plane[index].normal, direction);
    if (used[f] && along[f] >= 0.0) add(body.plane[index].normal);
  }
  for (int i = 0; i < body.vertex_count; ++i) {
    const Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (v.neighbour[k] < i) continue;
      const std::uint8_t a = v.face[(k + 1) % 3], b = v.face[(k + 2) % 3];
      if ((along[a] >= 0.0) == (along[b] >= 0.0)) continue;
      // The positive combination of both inward normals that is across the direction: it holds the edge,
      // points inward, and needs no length of the edge.
      const glm::dvec3 normal =
          body.plane[a].normal * std::abs(along[b]) + body.plane[b].normal * std::abs(along[a]);
      if (!(largest_component(normal) > 0.0)) continue;
      add(safe_normalize(normal, normal));
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
