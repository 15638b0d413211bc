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

/// Six faces in the order -x +x -y +y -z +z; corner i has bit 0 for +x, bit 1 for +y, bit 2 for +z. Crossing
/// face pair k flips bit k, which is the edge on the two other faces.
template <typename Corner>
void set_cuboid(Polytope& body, const Corner& corner) noexcept {
  for (int i = 0; i < 8; ++i) {
    Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    v.position = corner((i & 1) != 0, (i & 2) != 0, (i & 4) != 0);
    for (int k = 0; k < 3; ++k) {
      v.face[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(2 * k + (i >> k & 1));
      v.neighbour[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(i ^ (1 << k));
    }
  }
  body.vertex_count = 8;
  body.face_count = 6;
}

using VertexSet = std::uint64_t;  // bit i: vertex i
static_assert(kMaxVertices < 64);

VertexSet first_vertices(int count) noexcept {
  return (VertexSet{1} << count) - 1;
}

template <typename Use>
void for_each_vertex(VertexSet set, Use&& use) noexcept {
  for (; set != 0; set &= set - 1) use(static_cast<std::size_t>(std::countr_zero(set)));
}

/// Distance of the farthest face: the vertices of a small rest have the rounding of the body that it was cut
/// from, whose planes it still has.
double size_of_planes(const Polytope& body) noexcept {
  double size = 0.0;
  for (int f = 0; f < body.face_count; ++f)
    size = max_of(size, std::abs(body.plane[static_cast<std::size_t>(f)].offset));
  return size;
}

/// Cuts a body by one plane after another. Vertices keep their places, new ones follow behind, and the gaps
/// are closed once, at the end.
class Cutter {
 public:
  explicit Cutter(Polytope& body) noexcept
      : body_(body),
        kept_(first_vertices(body.vertex_count)),
        places_(static_cast<std::size_t>(body.vertex_count)) {}
  Cutter(Polytope& body, double size) noexcept : Cutter(body) { size_ = size; }
  Cutter(const Cutter&) = delete;
  Cutter& operator=(const Cutter&) = delete;
  ~Cutter() { close_gaps(); }

  void by(const Plane& plane) noexcept {
    by(plane, std::abs(plane.offset), [&](const glm::dvec3& p) {
      return plane.normal.x * p.x + plane.normal.y * p.y + plane.normal.z * p.z + plane.offset;
    });
  }
  template <int axis>
  void by(const Box& box, const Box& own) noexcept {
    // Vertices have the rounding of all their coordinates: a plate is not far enough inside itself.
    const double size = max_of(size_, max_of(largest_component(own.min), largest_component(own.max)));
    Plane plane{glm::dvec3(0.0), -box.min[axis]};
    plane.normal[axis] = 1.0;
    if (own.min[axis] < box.min[axis])
      by(plane, max_of(size, std::abs(box.min[axis])),
         [&](const glm::dvec3& p) { return p[axis] - box.min[axis]; });
    plane.normal[axis] = -1.0;
    plane.offset = box.max[axis];
    if (own.max[axis] > box.max[axis])
      by(plane, max_of(size, std::abs(box.max[axis])),
         [&](const glm::dvec3& p) { return box.max[axis] - p[axis]; });
  }

 private:
  /// From a kept vertex to its neighbour `slot`, which is cut off.
  struct CrossingEdge {
    std::uint8_t from, slot;
  };
  using CrossingEdges = std::array<CrossingEdge, kMaxVertices>;
  // More places than these are sorted out first: a cut takes one for each edge that it crosses.
  static constexpr std::size_t kManyPlaces = 40;

  /// `size`: of the numbers that distances are made from.
  template <typename Distance>
  void by(const Plane& plane, double size, const Distance& distance_of) noexcept;
  /// The vertices that are outside by more than their rounding.
  [[nodiscard]] VertexSet beyond_rounding(const double* distance) const noexcept;
  void divide(const Plane& plane, const double* distance, VertexSet cut_off) noexcept;
  [[nodiscard]] std::size_t add_vertices(const double* distance, VertexSet cut_off,
                                         CrossingEdges& crossing) noexcept;
  [[nodiscard]] bool join(std::size_t added) noexcept;
  void close_gaps() noexcept;

  Polytope& body_;
  VertexSet kept_;
  std::size_t places_;  ///< in use so far, gaps included
  double size_ = 0.0;   ///< of what the body was cut from, as far as its planes tell
};

template <typename Distance>
void Cutter::by(const Plane& plane, double size, const Distance& distance_of) noexcept {
  double distance[kMaxVertices];
  double lowest = 0.0, highest = size;
  for_each_vertex(kept_, [&](std::size_t i) {
    distance[i] = distance_of(body_.vertex[i].position);
    lowest = min_of(lowest, distance[i]);
    highest = max_of(highest, distance[i]);
  });
  const double limit = -kClipTolerance * max_of(highest, -lowest);
  if (lowest >= limit) return;
  VertexSet cut_off = 0;
  for_each_vertex(kept_, [&](std::size_t i) { cut_off |= VertexSet{distance[i] < limit} << i; });
  // What is outside by no more than its rounding may be all that is left.
  if (cut_off == kept_) cut_off = beyond_rounding(distance);
  if (cut_off == 0) return;
  divide(plane, distance, cut_off);
  if (places_ > kManyPlaces) close_gaps();
}

VertexSet Cutter::beyond_rounding(const double* distance) const noexcept {
  double size = size_of_planes(body_);
  for_each_vertex(kept_,
                  [&](std::size_t i) { size = max_of(size, largest_component(body_.vertex[i].position)); });
  VertexSet beyond = 0;
  for_each_vertex(kept_,
                  [&](std::size_t i) { beyond |= VertexSet{distance[i] < -kClipTolerance * size} << i; });
  return beyond;
}

void Cutter::divide(const Plane& plane, const double* distance, VertexSet cut_off) noexcept {
  const VertexSet kept = kept_ & ~cut_off;
  if (kept == 0) {
    kept_ = 0;
    return;
  }
  CrossingEdges crossing;
  const std::size_t added = body_.face_count < kMaxFaces ? add_vertices(distance, cut_off, crossing) : 0;
  if (added == 0 || !join(added)) return;
  for (std::size_t e = 0; e < added; ++e)
    body_.vertex[crossing[e].from].neighbour[crossing[e].slot] = static_cast<std::uint8_t>(places_ + e);
  kept_ = kept | first_vertices(static_cast<int>(added)) << places_;
  places_ += added;
  body_.plane[static_cast<std::size_t>(body_.face_count++)] = plane;
}

/// Puts a vertex on every edge that crosses the plane behind all others; returns how many, 0 where there is
/// no room.
std::size_t Cutter::add_vertices(const double* distance, VertexSet cut_off,
                                 CrossingEdges& crossing) noexcept {
  // Held here: a byte that is written might be part of anything else.
  Polytope::Vertex* const vertex = body_.vertex.data();
  const std::size_t places = places_;
  const auto cap = static_cast<std::uint8_t>(body_.face_count);
  VertexSet beside = 0;
  for_each_vertex(cut_off, [&](std::size_t i) {
    for (const std::uint8_t other : vertex[i].neighbour) beside |= VertexSet{1} << other;
  });
  std::size_t added = 0;
  for_each_vertex(beside & ~cut_off, [&](std::size_t i) {
    const Polytope::Vertex& v = vertex[i];
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint8_t other = v.neighbour[k];
      if ((cut_off >> other & 1) == 0 || places + added++ >= kMaxVertices) continue;
      const double from = max_of(distance[i], 0.0), length = from - distance[other];
      const glm::dvec3 &begin = v.position, &end = vertex[other].position;
      const double t = from / length;
      Polytope::Vertex& on_plane = vertex[places + added - 1];
      on_plane.position = begin + (end - begin) * t;
      // From an end that is far away, what is near the other one would get the rounding of that distance.
      constexpr double kNearEnd = 1.0 - 0x1p-14;
      if (t > kNearEnd) on_plane.position = end + (begin - end) * (-distance[other] / length);
      on_plane.face = {cap, v.face[(k + 1u) % 3], v.face[(k + 2u) % 3]};
      on_plane.neighbour[0] = static_cast<std::uint8_t>(i);
      crossing[added - 1] = {static_cast<std::uint8_t>(i), k};
    }
  });
  return places + added <= kMaxVertices ? added : 0;
}

/// Joins the new vertices along the faces they lie on into a new face. A convex face is crossed twice or not
/// at all: false where rounding gives another cut.
bool Cutter::join(std::size_t added) noexcept {
  std::uint32_t once = 0, twice = 0;  // bit f: face f
  static_assert(kMaxFaces <= 32);
  std::array<std::uint8_t, kMaxFaces> first;
  const std::span<Polytope::Vertex> vertex = body_.vertex;
  for (std::size_t i = places_, end = places_ + added; i < end; ++i) {
    Polytope::Vertex& v = vertex[i];
    for (std::size_t side = 1; side < 3; ++side) {
      const std::uint8_t face = v.face[side];
      const std::uint32_t bit = std::uint32_t{1} << face;
      if ((once & bit) == 0) {
        once |= bit;
        first[face] = static_cast<std::uint8_t>(i);
        continue;
      }
      if ((twice & bit) != 0) return false;
      twice |= bit;
      Polytope::Vertex& other = vertex[first[face]];
      v.neighbour[3 - side] = first[face];
      other.neighbour[other.face[1] == face ? 2 : 1] = static_cast<std::uint8_t>(i);
    }
  }
  return once == twice;
}

void Cutter::close_gaps() noexcept {
  std::array<std::uint8_t, kMaxVertices> renamed;
  std::uint8_t count = 0;
  for_each_vertex(kept_, [&](std::size_t i) { renamed[i] = count++; });
  body_.vertex_count = count;
  if (count == places_) return;
  const std::span<Polytope::Vertex> vertex = body_.vertex;
  for_each_vertex(kept_, [&](std::size_t i) {
    const Polytope::Vertex& from = vertex[i];
    Polytope::Vertex& to = vertex[renamed[i]];
    to.position = from.position;
    for (std::size_t k = 0; k < 3; ++k) {
      to.face[k] = from.face[k];
      to.neighbour[k] = renamed[from.neighbour[k]];
    }
  });
  kept_ = first_vertices(count);
  places_ = count;
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
  set_cuboid(body, [&](bool x, bool y, bool z) {
    return glm::dvec3(x ? box.max.x : box.min.x, y ? box.max.y : box.min.y, z ? box.max.z : box.min.z);
  });
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
  set_cuboid(body, [&](bool right, bool top, bool far) {
    const double depth = far ? end : begin;
    const double scale = camera.orthographic ? 1.0 : depth;
    return axes.right * ((right ? camera.right : camera.left) * scale) +
           axes.up * ((top ? camera.top : camera.bottom) * scale) + axes.forward * depth;
  });
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
  Cutter(body).by(plane);
}

void clip(Polytope& body, const Box& box) noexcept {
  if (box.empty()) {
    body.vertex_count = 0;
    return;
  }
  // Planes that miss the body are told from its own box, six comparisons in place of six rounds of distances.
  const Box own = bounds_of(body);
  Cutter cutter(body, size_of_planes(body));
  cutter.by<0>(box, own);
  cutter.by<1>(box, own);
  cutter.by<2>(box, own);
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
  std::uint32_t facing = 0;  // bit f: face f has the light on its inner side
  for (int f = 0; f < body.face_count; ++f) {
    const Plane& plane = body.plane[static_cast<std::size_t>(f)];
    along[f] = glm::dot(plane.normal, glm::dvec3(light));
    if (light.w != 0.0) along[f] += plane.offset * light.w;
    facing |= std::uint32_t{along[f] >= 0.0} << f;
    lowest[f] = std::numeric_limits<double>::infinity();  // a face without vertices is none
  }
  for (const Polytope::Vertex& v : body.vertices()) {
    for (const std::uint8_t f : v.face) {
      if ((facing >> f & 1) != 0) lowest[f] = min_of(lowest[f], glm::dot(body.plane[f].normal, v.position));
    }
  }
  for (int f = 0; f < body.face_count; ++f) {
    if (lowest[f] < std::numeric_limits<double>::infinity())
      add(body.plane[static_cast<std::size_t>(f)].normal, lowest[f]);
  }
  for (int i = 0; i < body.vertex_count; ++i) {
    const Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    const std::uint32_t sides =
        (facing >> v.face[0] & 1) + (facing >> v.face[1] & 1) + (facing >> v.face[2] & 1);
    if (sides == 0 || sides == 3) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint8_t a = v.face[(k + 1) % 3], b = v.face[(k + 2) % 3];
      if (v.neighbour[k] < i || (facing >> a & 1) == (facing >> b & 1)) continue;
      // The positive combination of both inward planes that goes through the light: it holds the edge, points
      // inward, and needs no length of the edge.
      const glm::dvec3 both =
          body.plane[a].normal * std::abs(along[b]) + body.plane[b].normal * std::abs(along[a]);
      const double square = glm::dot(both, both);
      if (!(square > 0.0)) continue;
      const glm::dvec3 normal = both / std::sqrt(square);
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
