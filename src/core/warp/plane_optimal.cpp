// Plane-optimal: on one receiver plane, every texel is exactly one pixel's image.
// Based on: Chong and Gortler, "A Lixel for Every Pixel", 2004. The plane is the body's face
// that lies largest under the light among those that the viewer sees from inside: the ground, for most
// scenes; or one that the caller chose.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::warps {
namespace {

/// A linear function over the light plane.
struct Linear2 {
  glm::dvec2 slope;
  double at_origin;
};

/// Area of each face in the light plane, twice: a fan of triangles from any of its vertices to its edges.
std::array<double, kMaxFaces> areas_across_light(const WarpInput& input) noexcept {
  const Polytope& body = *input.polytope;
  std::array<double, kMaxFaces> area{};
  std::array<glm::dvec2, kMaxVertices> point;
  std::array<glm::dvec2, kMaxFaces> hub;
  for (int i = 0; i < body.vertex_count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const glm::dvec3 p = input.light.project(body.vertex[at].position);
    point[at] = {p.x, p.y};
    for (const std::uint8_t f : body.vertex[at].face) hub[f] = point[at];
  }
  for (int i = 0; i < body.vertex_count; ++i) {
    const Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (v.neighbour[k] < i) continue;
      // Neighbour k lies along the edge of the two other faces.
      const glm::dvec2 p = point[static_cast<std::size_t>(i)], q = point[v.neighbour[k]];
      for (const std::uint8_t f : {v.face[(k + 1) % 3], v.face[(k + 2) % 3]}) {
        const glm::dvec2 a = p - hub[f], b = q - hub[f];
        area[f] += std::abs(a.x * b.y - a.y * b.x);
      }
    }
  }
  return area;
}

/// The face that lies largest under the light, of those that the viewer sees from inside; nullptr where there
/// is none.
const Plane* receiver_plane(const WarpInput& input) noexcept {
  const Polytope& body = *input.polytope;
  // Rounding takes vertices at a local light behind it: they have no place under it.
  for (const Polytope::Vertex& v : body.vertices()) {
    if (input.light.perspective && !(input.light.distance(v.position) > 0.0)) return nullptr;
  }
  const std::array<double, kMaxFaces> area = areas_across_light(input);
  const glm::dvec4 light = input.light.light();
  // Less of the largest face is a face that was cut away to a line, and rounding.
  constexpr double kLeastShare = 1e-9;
  double any_face = 0.0;
  for (const double a : area) any_face = max_of(any_face, a);
  // All faces of a body that is a point or a line are rounding.
  constexpr double kNoArea = 1e-13;
  double farthest = 0.0;
  for (const WarpInput::Point& p : input.body)
    farthest = max_of(farthest, max_of(std::abs(p.x), std::abs(p.y)));
  if (!(any_face > kNoArea * farthest * farthest)) return nullptr;
  // Faces whose areas differ by rounding alone are told apart by what turning the world leaves alone: the one
  // nearest to the eye, then the one that faces up or right in the picture.
  constexpr double kSame = 1e-6;
  const auto comes_first = [&](const Plane& one, const Plane& other) {
    const double nearer = other.offset - one.offset;
    if (std::abs(nearer) > kSame * other.offset) return nearer > 0.0;
    const double up = glm::dot(input.view.up, one.normal - other.normal);
    return std::abs(up) > kSame ? up > 0.0 : glm::dot(input.view.right, one.normal - other.normal) > kSame;
  };
  const Plane* best = nullptr;
  double largest = 0.0;
  for (int f = 0; f < body.face_count; ++f) {
    const auto index = static_cast<std::size_t>(f);
    const Plane& plane = body.plane[index];
    // The light and the eye, which is the origin, both on the inner side.
    const double towards_light = glm::dot(plane.normal, glm::dvec3(light)) + plane.offset * light.w;
    if (!(towards_light > 0.0 && plane.offset > 0.0)) continue;
    const double size = area[index];
    if (!(size > kLeastShare * any_face)) continue;
    const bool same = best != nullptr && std::abs(size - largest) <= kSame * largest;
    if (same ? !comes_first(plane, *best) : !(size > largest)) continue;
    largest = size;
    best = &plane;
  }
  return best;
}

WarpChoice choose(const WarpInput& input) noexcept {
  const Plane* chosen = input.receiver != nullptr ? input.receiver : receiver_plane(input);
  const Plane* plane = input.orthographic ? nullptr : chosen;
  if (plane == nullptr) return input.unwarped;
  const LightLinear face = light_linear(input.light, plane->normal, plane->offset);
  const glm::dvec3 n = face.slope;
  // Of a face that rounding alone turns to the light no ray finds a place.
  if (n.z == 0.0) return input.unwarped;
  // Along the light onto the plane: h = -(constant + n.x x + n.y y) / n.z. A direction's component becomes
  // linear in x, y.
  const auto on_plane = [&](const glm::dvec3& direction) {
    const LightLinear d = light_linear(input.light, direction, 0.0);
    return Linear2{{d.slope.x - d.slope.z * n.x / n.z, d.slope.y - d.slope.z * n.y / n.z},
                   d.constant - d.slope.z * face.constant / n.z};
  };
  const Linear2 depth = on_plane(input.view.forward);
  const double steepness = glm::length(depth.slope);
  if (!(steepness > 0.0)) return input.unwarped;
  WarpChoice choice;
  choice.axis = depth.slope / steepness;
  const auto along = [&choice](const WarpInput::Point& p) { return glm::dot(choice.axis, {p.x, p.y}); };
  double u_min = along(input.body.front()), u_max = u_min;
  for (const WarpInput::Point& p : input.body) {
    u_min = min_of(u_min, along(p));
    u_max = max_of(u_max, along(p));
  }
  const double w_near = depth.at_origin + steepness * u_min;
  if (!(w_near > 0.0)) return input.unwarped;
  // Where depth does not change over the plane, rounding would decide the axis: there is nothing to warp.
  constexpr double kLeastChange = 1e-6;
  if (!(steepness * (u_max - u_min) > kLeastChange * w_near)) return input.unwarped;
  choice.kappa = steepness / w_near;
  const double stretch = 1.0 + choice.kappa * (u_max - u_min);
  // The screen's axes over (s, u): a row's part along u that w does not carry off, as a multiple of Y = u
  // stretch / w.
  const auto row = [&](const glm::dvec3& screen_axis) {
    const Linear2 l = on_plane(screen_axis);
    const double along_s = l.slope.x * choice.axis.y - l.slope.y * choice.axis.x;
    const double along_u = glm::dot(l.slope, choice.axis), at_near = l.at_origin + along_u * u_min;
    return glm::dvec2(along_s, (along_u - at_near * choice.kappa) / stretch);
  };
  choice.row_a = row(input.view.right);
  choice.row_b = row(input.view.up);
  const double area = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  return std::abs(area) > 0.0 ? choice : input.unwarped;
}

}  // namespace

const Warp plane_optimal{"plane_optimal", "one texel per pixel on the best-lit receiver plane", choose, true};

}  // namespace gnomon::warps
