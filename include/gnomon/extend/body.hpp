// The intersection body: a convex polytope in fixed storage, cut by planes, with faces and adjacency.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/shadow_map.hpp"

namespace gnomon {

/// A frustum slice has 6 faces and a box 6; a depth range adds 2. The rest is room for a caller's own planes,
/// up to the 60 vertices that still fit one machine word of flags.
inline constexpr int kMaxFaces = 32;
/// A simple polytope with F faces has 2F - 4 vertices (Euler's formula with three faces at each vertex).
inline constexpr int kMaxVertices = 2 * kMaxFaces - 4;

/// dot(normal, p) + offset >= 0 inside; unit normal pointing inward.
struct Plane {
  glm::dvec3 normal;  ///< unit, pointing inward
  double offset;      ///< distance of the origin inside of the plane, world units
};

/// A bounded convex polytope in which every vertex belongs to exactly three faces ("simple"). Degenerate
/// bodies (flat, a line, a point) are kept as simple polytopes with coinciding vertices, so nothing
/// special-cases them.
struct Polytope {
  /// A corner, where three faces and three edges meet.
  struct Vertex {
    glm::dvec3 position;  ///< in the space of the body
    /// neighbour[k] is joined by the edge that lies on the two faces other than face[k].
    std::array<std::uint8_t, 3> neighbour, face;
  };
  std::array<Vertex, kMaxVertices> vertex;  ///< the first vertex_count are used
  std::array<Plane, kMaxFaces> plane;       ///< of face f; a face may have lost all its vertices
  int vertex_count = 0;                     ///< 0 for an empty body
  int face_count = 0;                       ///< entries of `plane` that are used

  Polytope() noexcept = default;
  /// Copies the used part only: a tenth of the storage, for most bodies.
  Polytope(const Polytope& other) noexcept { *this = other; }
  /// The same.
  Polytope& operator=(const Polytope& other) noexcept;

  /// True where cuts left nothing.
  [[nodiscard]] bool empty() const noexcept { return vertex_count == 0; }
  /// The vertices that are used.
  [[nodiscard]] std::span<const Vertex> vertices() const noexcept {
    return {vertex.data(), static_cast<std::size_t>(vertex_count)};
  }
};

/// The box as a polytope; needs a box that is not empty.
[[nodiscard]] Polytope box_polytope(const Box& box) noexcept;

/// The part of the camera's frustum between the view depths `begin` and `end`, relative to the camera
/// position. Needs begin <= end, inside the camera's range or not. Corners come from depth and image edges,
/// never from intersecting planes, so that a far plane of 1e9 loses nothing.
[[nodiscard]] Polytope frustum_slice(const Camera& camera, const CameraAxes& axes, double begin,
                                     double end) noexcept;
/// Its planes alone: left, right, bottom, top, nearest and farthest.
[[nodiscard]] std::array<Plane, 6> frustum_planes(const Camera& camera, const CameraAxes& axes, double begin,
                                                  double end) noexcept;

/// Keeps the part of `body` inside `plane`. Vertices within a tolerance relative to the body's size count as
/// inside. Leaves `body` as it is (a superset, never less) where rounding gives no consistent cut or its
/// storage is full.
void clip(Polytope& body, const Plane& plane) noexcept;
/// Clips by the six planes of `box` (same space as the body); an empty box empties the body.
void clip(Polytope& body, const Box& box) noexcept;

/// Planes of `body` swept towards a light. They are those of its faces that have the light on their inner
/// side, and one through each edge of its silhouette and the light. `light` is a direction towards parallel
/// light with w = 0, of any length, or a position with w = 1. Returns how many were written.
int swept_planes(const Polytope& body, const glm::dvec4& light,
                 std::span<Plane, kMaxCullPlanes> out) noexcept;

/// The smallest box round the body; empty for an empty body.
[[nodiscard]] Box bounds_of(const Polytope& body) noexcept;

}  // namespace gnomon
