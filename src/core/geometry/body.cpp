// The intersection body: a convex polytope in fixed storage, cut by planes, with faces and adjacency.
#include "gnomon/extend/body.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/body.hpp"
#include "geometry/vector.hpp"
#include "lanes/pair.hpp"
#include "lanes/point_pair.hpp"

namespace gnomon {
namespace {

// A few hundred units in the last place of the largest distance at hand: above the rounding of a dot product,
// far below anything that shows.
constexpr double kClipTolerance = 1e-13;

/// Six faces in the order -x +x -y +y -z +z; corner i has bit 0 for +x, bit 1 for +y, bit 2 for +z. Crossing
/// face pair k flips bit k, which is the edge on the two other faces.
void join_cuboid(Polytope& body) noexcept {
  for (std::uint8_t i = 0; i < 8; ++i) {
    Polytope::Vertex& v = body.vertex[i];
    for (std::uint8_t k = 0; k < 3; ++k) {
      v.face[k] = static_cast<std::uint8_t>(2 * k + (i >> k & 1));
      v.neighbour[k] = static_cast<std::uint8_t>(i ^ (1 << k));
    }
  }
  body.vertex_count = 8;
  body.face_count = 6;
}

// The two faces of edge k at a vertex.
constexpr std::array<std::uint8_t, 3> kNext = {1, 2, 0}, kLast = {2, 0, 1};

// Of a vertex, by a bit for each of its faces: the two edges between a face with its bit and one without.
constexpr std::array<std::array<std::uint8_t, 2>, 8> kParting = {
    {{0, 0}, {1, 2}, {0, 2}, {0, 1}, {0, 1}, {0, 2}, {1, 2}, {0, 0}}};

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

/// Distances from a plane across an axis: `sign` (p[axis] - at).
struct AxisDistance {
  std::size_t axis;
  double at, sign;
  [[nodiscard]] double operator()(const glm::dvec3& p) const noexcept { return sign * ((&p.x)[axis] - at); }
};
/// Distances from a plane across any direction: `sign` (dot(normal, p) - at).
struct SlabDistance {
  const glm::dvec3& normal;
  double at, sign;
  [[nodiscard]] double operator()(const glm::dvec3& p) const noexcept {
    return sign * (normal.x * p.x + normal.y * p.y + normal.z * p.z - at);
  }
};
struct PlaneDistance {
  const Plane& plane;
  [[nodiscard]] double operator()(const glm::dvec3& p) const noexcept {
    return plane.normal.x * p.x + plane.normal.y * p.y + plane.normal.z * p.z + plane.offset;
  }
};

/// Cuts a body by one plane after another. Vertices keep their places, new ones follow behind, and the gaps
/// are closed once, at the end.
class Cutter {
 public:
  explicit Cutter(Polytope& body) noexcept
      : body_(body),
        kept_(first_vertices(body.vertex_count)),
        slots_(static_cast<std::size_t>(body.vertex_count)) {}
  Cutter(const Cutter&) = delete;
  Cutter& operator=(const Cutter&) = delete;
  ~Cutter() { close_gaps(); }

  void by(const Plane& plane) noexcept;
  /// By the two planes of a slab. The first cut of this body.
  void between(const glm::dvec3& normal, double begin, double end) noexcept;
  /// By the two faces of `box` across an axis. `own`: the body's box before the first cut; `size`: of what
  /// the body was cut from.
  void by(std::size_t axis, const Box& box, const Box& own, double size) noexcept;

 private:
  // More places than these are sorted out first: a cut takes one for each edge that it crosses.
  static constexpr std::size_t kManySlots = 30;

  void by(const AxisDistance& distance, VertexSet cut_off) noexcept;
  /// Divides the body where `cut_off` is not all that there is, or no more than rounding.
  template <typename Distance>
  void cut(const Plane& plane, const Distance& distance, VertexSet cut_off) noexcept;
  /// The vertices that are outside by more than their rounding.
  template <typename Distance>
  [[nodiscard]] VertexSet beyond_rounding(const Distance& distance) const noexcept;
  template <typename Distance>
  [[nodiscard]] std::size_t add_vertices(Distance distance, VertexSet cut_off) noexcept;
  void close_gaps() noexcept;

  Polytope& body_;
  VertexSet kept_;
  std::size_t slots_;  ///< in use so far, gaps included
};

void Cutter::by(const Plane& plane) noexcept {
  if (slots_ > kManySlots) close_gaps();
  const PlaneDistance distance_of{plane};
  double distance[kMaxVertices];
  double lowest = 0.0, highest = std::abs(plane.offset);
  for_each_vertex(kept_, [&](std::size_t i) {
    distance[i] = distance_of(body_.vertex[i].position);
    lowest = min_of(lowest, distance[i]);
    highest = max_of(highest, distance[i]);
  });
  const double limit = -kClipTolerance * max_of(highest, -lowest);
  if (lowest >= limit) return;
  VertexSet cut_off = 0;
  for_each_vertex(kept_, [&](std::size_t i) { cut_off |= VertexSet{distance[i] < limit} << i; });
  cut(plane, distance_of, cut_off);
}

void Cutter::between(const glm::dvec3& normal, double begin, double end) noexcept {
  if (kept_ == 0) return;
  const DotPair along_normal(normal);
  double along[kMaxVertices];
  static_assert(kMaxVertices % 2 == 0);
  Pair low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
  for_each_two<VertexPair>({body_.vertex.data(), slots_}, [&](std::size_t i, const VertexPair& vertices) {
    const Pair two = along_normal(vertices);
    low = min_of(low, two);
    high = max_of(high, two);
    two.to(&along[i]);
  });
  const double least = min_of(low.low(), low.high()), most = max_of(high.low(), high.high());
  const auto limit = [](double at, double lowest, double highest) {
    return -kClipTolerance * max_of(max_of(std::abs(at), highest), -lowest);
  };
  const Pair at_begin(begin), least_begin(limit(begin, least - begin, most - begin));
  const Pair at_end(end), least_end(limit(end, end - most, end - least));
  // What the first cut adds, the second keeps.
  const VertexSet asked = kept_;
  VertexSet before = 0, behind = 0;
  for (std::size_t i = 0; i < slots_; i += 2) {
    const Pair two = Pair::from(&along[i]);
    before |= VertexSet{below(two - at_begin, least_begin)} << i;
    behind |= VertexSet{below(at_end - two, least_end)} << i;
  }
  cut({normal, -begin}, SlabDistance{normal, begin, 1.0}, before & asked);
  cut({-normal, end}, SlabDistance{normal, end, -1.0}, behind & asked & kept_);
}

void Cutter::by(std::size_t axis, const Box& box, const Box& own, double size) noexcept {
  const double low = (&box.min.x)[axis], high = (&box.max.x)[axis];
  const double own_low = (&own.min.x)[axis], own_high = (&own.max.x)[axis];
  if (!(own_low < low || own_high > high)) return;
  if (slots_ > kManySlots) close_gaps();
  // No vertex has a distance beyond those of the body's box.
  const auto limit = [&](double at, double lowest, double highest) {
    return -kClipTolerance * max_of(max_of(size, std::abs(at)), max_of(highest, -lowest));
  };
  const Pair at_low(low), least_low(limit(low, own_low - low, own_high - low));
  const Pair at_high(high), least_high(limit(high, high - own_high, high - own_low));
  // Gaps hold what they held, and are asked in vain. What the first cut adds, the second keeps.
  const VertexSet asked = kept_;
  VertexSet below_low = 0, above_high = 0;
  constexpr std::size_t kStride = sizeof(Polytope::Vertex) / sizeof(double);
  static_assert(sizeof(Polytope::Vertex) == kStride * sizeof(double));
  const double* value = &body_.vertex[0].position.x + axis;
  for (std::size_t i = 0; i < slots_; i += 2, value += 2 * kStride) {
    const Pair two(value[0], value[i + 1 < slots_ ? kStride : 0]);  // behind the last place lies nothing
    below_low |= VertexSet{below(two - at_low, least_low)} << i;
    above_high |= VertexSet{below(at_high - two, least_high)} << i;
  }
  if (own_low < low) by({axis, low, 1.0}, below_low & asked);
  if (own_high > high) by({axis, high, -1.0}, above_high & asked & kept_);
}

void Cutter::by(const AxisDistance& distance, VertexSet cut_off) noexcept {
  if (cut_off == 0) return;
  Plane plane{glm::dvec3(0.0), -distance.sign * distance.at};
  (&plane.normal.x)[distance.axis] = distance.sign;
  cut(plane, distance, cut_off);
}

template <typename Distance>
VertexSet Cutter::beyond_rounding(const Distance& distance) const noexcept {
  double size = size_of_planes(body_);
  for_each_vertex(kept_,
                  [&](std::size_t i) { size = max_of(size, largest_component(body_.vertex[i].position)); });
  VertexSet beyond = 0;
  for_each_vertex(kept_, [&](std::size_t i) {
    beyond |= VertexSet{distance(body_.vertex[i].position) < -kClipTolerance * size} << i;
  });
  return beyond;
}

template <typename Distance>
void Cutter::cut(const Plane& plane, const Distance& distance, VertexSet cut_off) noexcept {
  if (cut_off == 0) return;
  // What is outside by no more than its rounding may be all that is left.
  if (cut_off == kept_) cut_off = beyond_rounding(distance);
  if (cut_off == 0) return;
  const VertexSet kept = kept_ & ~cut_off;
  if (kept == 0) {
    kept_ = 0;
    return;
  }
  const std::size_t added = body_.face_count < kMaxFaces ? add_vertices(distance, cut_off) : 0;
  if (added == 0) return;
  kept_ = kept | first_vertices(static_cast<int>(added)) << slots_;
  slots_ += added;
  body_.plane[static_cast<std::size_t>(body_.face_count++)] = plane;
}

/// Puts a vertex on every edge that crosses the plane behind all others, and joins those that lie on one face
/// into a new one. Returns how many. A convex face is crossed twice or not at all: 0, and nothing is changed,
/// where rounding gives another cut, or there is no room.
template <typename Distance>
std::size_t Cutter::add_vertices(const Distance distance, VertexSet cut_off) noexcept {
  // Held here, as is the distance: a byte that is written might be part of anything else.
  Polytope::Vertex* const vertex = body_.vertex.data();
  const std::size_t places = slots_;
  const auto cap = static_cast<std::uint8_t>(body_.face_count);
  VertexSet beside = 0;
  for_each_vertex(cut_off, [&](std::size_t i) {
    for (const std::uint8_t other : vertex[i].neighbour) beside |= VertexSet{1} << other;
  });
  std::uint32_t once = 0, twice = 0, more = 0;  // bit f: face f is crossed
  static_assert(kMaxFaces <= 32);
  std::array<std::uint8_t, kMaxFaces> joined{};  // both places on a face, by exclusive or
  std::array<std::uint8_t, kMaxVertices> slot;   // of the kept vertex, where the edge begins
  std::size_t place = places;
  for_each_vertex(beside & ~cut_off, [&](std::size_t i) {
    const Polytope::Vertex& v = vertex[i];
    const glm::dvec3& begin = v.position;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((cut_off >> v.neighbour[k] & 1) == 0) continue;
      if (place == kMaxVertices) {
        more = 1;
        return;
      }
      const glm::dvec3& end = vertex[v.neighbour[k]].position;
      const double from = max_of(distance(begin), 0.0), to = distance(end), length = from - to;
      const double t = from / length;
      Polytope::Vertex& on_plane = vertex[place];
      on_plane.position = begin + (end - begin) * t;
      // From an end that is far away, what is near the other one would get the rounding of that distance.
      constexpr double kNearEnd = 1.0 - 0x1p-14;
      if (t > kNearEnd) on_plane.position = end + (begin - end) * (-to / length);
      const std::uint8_t one = v.face[kNext[k]], two = v.face[kLast[k]];
      on_plane.face = {cap, one, two};
      on_plane.neighbour[0] = static_cast<std::uint8_t>(i);
      slot[place] = static_cast<std::uint8_t>(k);
      const std::uint32_t sides = std::uint32_t{1} << one | std::uint32_t{1} << two;
      more |= twice & sides;
      twice |= once & sides;
      once |= sides;
      joined[one] ^= static_cast<std::uint8_t>(place);
      joined[two] ^= static_cast<std::uint8_t>(place);
      ++place;
    }
  });
  if (once != twice || more != 0) return 0;
  for (std::size_t p = places; p < place; ++p) {
    Polytope::Vertex& v = vertex[p];
    v.neighbour[2] = static_cast<std::uint8_t>(joined[v.face[1]] ^ p);
    v.neighbour[1] = static_cast<std::uint8_t>(joined[v.face[2]] ^ p);
    vertex[v.neighbour[0]].neighbour[slot[p]] = static_cast<std::uint8_t>(p);
  }
  return place - places;
}

void Cutter::close_gaps() noexcept {
  std::array<std::uint8_t, kMaxVertices> renamed;
  std::uint8_t count = 0;
  for_each_vertex(kept_, [&](std::size_t i) { renamed[i] = count++; });
  body_.vertex_count = count;
  if (count == slots_) return;
  Polytope::Vertex* const vertex = body_.vertex.data();
  Polytope::Vertex* to = vertex;
  for_each_vertex(kept_, [&](std::size_t i) {
    // Never behind where it comes from.
    const Polytope::Vertex& from = vertex[i];
    const std::uint8_t a = renamed[from.neighbour[0]], b = renamed[from.neighbour[1]],
                       c = renamed[from.neighbour[2]];
    to->position = from.position;
    to->neighbour[0] = a;
    to->neighbour[1] = b;
    to->neighbour[2] = c;
    to->face = from.face;
    ++to;
  });
  kept_ = first_vertices(count);
  slots_ = count;
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
  for (std::size_t i = 0; i < 8; ++i) {
    body.vertex[i].position = {(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                               (i & 4) != 0 ? box.max.z : box.min.z};
  }
  join_cuboid(body);
  body.plane[0] = {{1, 0, 0}, -box.min.x};
  body.plane[1] = {{-1, 0, 0}, box.max.x};
  body.plane[2] = {{0, 1, 0}, -box.min.y};
  body.plane[3] = {{0, -1, 0}, box.max.y};
  body.plane[4] = {{0, 0, 1}, -box.min.z};
  body.plane[5] = {{0, 0, -1}, box.max.z};
  return body;
}

std::array<Plane, 6> frustum_planes(const Camera& camera, const CameraAxes& axes, double begin,
                                    double end) noexcept {
  // Side planes hold a side edge of slope (x or y) per unit depth and the other image axis.
  const double slope = camera.orthographic ? 0.0 : 1.0;
  const auto side = [&](const glm::dvec3& axis, double edge, double inward) {
    const glm::dvec3 normal =
        (axis - axes.forward * (edge * slope)) * (inward / std::sqrt(1.0 + slope * edge * edge));
    return Plane{normal, camera.orthographic ? -inward * edge : 0.0};
  };
  return {side(axes.right, camera.left, 1.0), side(axes.right, camera.right, -1.0),
          side(axes.up, camera.bottom, 1.0),  side(axes.up, camera.top, -1.0),
          Plane{axes.forward, -begin},        Plane{-axes.forward, end}};
}

Polytope frustum_slice(const Camera& camera, const CameraAxes& axes, double begin, double end) noexcept {
  Polytope body;
  for (std::size_t far = 0; far < 2; ++far) {
    const double depth = far == 0 ? begin : end, scale = camera.orthographic ? 1.0 : depth;
    const glm::dvec3 left = axes.right * (camera.left * scale), right = axes.right * (camera.right * scale);
    const glm::dvec3 bottom = axes.up * (camera.bottom * scale), top = axes.up * (camera.top * scale);
    const glm::dvec3 middle = axes.forward * depth;
    Polytope::Vertex* const v = &body.vertex[4 * far];
    v[0].position = left + bottom + middle;
    v[1].position = right + bottom + middle;
    v[2].position = left + top + middle;
    v[3].position = right + top + middle;
  }
  join_cuboid(body);
  const std::array<Plane, 6> planes = frustum_planes(camera, axes, begin, end);
  std::copy(planes.begin(), planes.end(), body.plane.begin());
  return body;
}

double clip_rounding(const Polytope& body) noexcept {
  return kClipTolerance * size_of_planes(body);
}

void clip(Polytope& body, const Plane& plane) noexcept {
  Cutter(body).by(plane);
}

void clip_to_slab(Polytope& body, const glm::dvec3& normal, double begin, double end) noexcept {
  Cutter(body).between(normal, begin, end);
}

void clip(Polytope& body, const Box& box) noexcept {
  if (box.empty()) {
    body.vertex_count = 0;
    return;
  }
  // Planes that miss the body are told from its own box, six comparisons in place of six rounds of distances.
  const Box own = bounds_of(body);
  // Vertices have the rounding of all their coordinates: a plate is not far enough inside itself.
  const double size =
      max_of(size_of_planes(body), max_of(largest_component(own.min), largest_component(own.max)));
  Cutter cutter(body);
  for (std::size_t axis = 0; axis < 3; ++axis) cutter.by(axis, box, own, size);
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
  std::uint8_t faces_light[kMaxFaces];  // 1: it has the light on its inner side
  for (int f = 0; f < body.face_count; ++f) {
    const Plane& plane = body.plane[static_cast<std::size_t>(f)];
    along[f] = glm::dot(plane.normal, glm::dvec3(light));
    if (light.w != 0.0) along[f] += plane.offset * light.w;
    faces_light[f] = along[f] >= 0.0 ? 1 : 0;
    lowest[f] = std::numeric_limits<double>::infinity();  // a face without vertices is none
  }
  // Edges between a face with the light on its inner side and one without, by the vertex that comes first.
  struct Edge {
    std::uint8_t vertex, slot;
  };
  std::array<Edge, 3 * kMaxVertices / 2 + 1> silhouette;  // and one that is written in vain
  std::size_t edges = 0;
  for (std::size_t i = 0; i < body.vertices().size(); ++i) {
    const Polytope::Vertex& v = body.vertex[i];
    const std::uint32_t sides = faces_light[v.face[0]] | std::uint32_t{faces_light[v.face[1]]} << 1 |
                                std::uint32_t{faces_light[v.face[2]]} << 2;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((sides >> k & 1) == 0) continue;
      double& least = lowest[v.face[k]];
      least = min_of(least, glm::dot(body.plane[v.face[k]].normal, v.position));
    }
    if (sides == 0 || sides == 7) continue;
    for (const std::uint8_t k : kParting[sides]) {
      silhouette[edges] = {static_cast<std::uint8_t>(i), k};
      edges += v.neighbour[k] >= i ? 1 : 0;
    }
  }
  for (int f = 0; f < body.face_count; ++f) {
    if (lowest[f] < std::numeric_limits<double>::infinity())
      add(body.plane[static_cast<std::size_t>(f)].normal, lowest[f]);
  }
  for (const Edge& edge : std::span(silhouette.data(), edges)) {
    const Polytope::Vertex& v = body.vertex[edge.vertex];
    const std::uint8_t a = v.face[kNext[edge.slot]], b = v.face[kLast[edge.slot]];
    // The positive combination of both inward planes that goes through the light: it holds the edge, points
    // inward, and needs no length of the edge.
    const glm::dvec3 both =
        body.plane[a].normal * std::abs(along[b]) + body.plane[b].normal * std::abs(along[a]);
    const double square = glm::dot(both, both);
    if (!(square > 0.0)) continue;
    const glm::dvec3 normal = both / std::sqrt(square);
    add(normal,
        min_of(glm::dot(normal, v.position), glm::dot(normal, body.vertex[v.neighbour[edge.slot]].position)));
  }
  return written;
}

Box bounds_of(const Polytope& body) noexcept {
  Box box;
  for (const Polytope::Vertex& v : body.vertices()) box.extend(v.position);
  return box;
}

}  // namespace gnomon
