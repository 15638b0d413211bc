// Plane-optimal: on one receiver plane, every texel is exactly one pixel's image.
// Based on: Chong and Gortler, "A Lixel for Every Pixel", 2004. The plane is the body's face that the light
// falls on most directly among those that the viewer sees from inside: the ground, for most scenes.
#include <cmath>
#include <glm/geometric.hpp>

#include "../vector.hpp"
#include "gnomon/warp.hpp"

namespace gnomon::warps {
namespace {

/// A linear function over the light plane.
struct Linear2 {
  glm::dvec2 slope;
  double at_origin;
};

const Plane* receiver_plane(const Polytope& body) noexcept {
  const Plane* best = nullptr;
  for (int i = 0; i < body.vertex_count; ++i) {
    for (const std::uint8_t f : body.vertex[static_cast<std::size_t>(i)].face) {
      const Plane& plane = body.plane[f];
      // Light comes from +z; the eye is the origin.
      if (!(plane.normal.z > 0.0 && plane.offset > 0.0)) continue;
      if (best == nullptr || plane.normal.z > best->normal.z) best = &plane;
    }
  }
  return best;
}

WarpChoice choose(const WarpInput& input) noexcept {
  const Plane* plane = input.orthographic ? nullptr : receiver_plane(*input.polytope);
  if (plane == nullptr) return {};
  const glm::dvec3 n = plane->normal;
  // Along the light onto the plane: z = -(offset + n.x x + n.y y) / n.z. A direction's component becomes
  // linear in x, y.
  const auto on_plane = [&](const glm::dvec3& d) {
    return Linear2{{d.x - d.z * n.x / n.z, d.y - d.z * n.y / n.z}, -d.z * plane->offset / n.z};
  };
  const Linear2 depth = on_plane(input.view.forward);
  const double steepness = glm::length(depth.slope);
  WarpChoice choice;
  const auto along = [&choice](const WarpInput::Point& p) { return glm::dot(choice.axis, {p.x, p.y}); };
  double u_min = 0.0, u_max = 0.0;
  const auto measure_along = [&] {
    u_min = u_max = along(input.body.front());
    for (const WarpInput::Point& p : input.body) {
      u_min = min_of(u_min, along(p));
      u_max = max_of(u_max, along(p));
    }
  };
  if (steepness > 0.0) choice.axis = depth.slope / steepness;
  measure_along();
  const double w_near = depth.at_origin + steepness * u_min;
  if (!(w_near > 0.0)) return {};
  // Where depth does not change over the plane, rounding would decide the axis: there is nothing to warp.
  constexpr double kLeastChange = 1e-6;
  if (steepness * (u_max - u_min) > kLeastChange * w_near) {
    choice.kappa = steepness / w_near;
  } else {
    choice.axis = WarpChoice{}.axis;
    measure_along();
  }
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
  return std::abs(area) > 0.0 ? choice : WarpChoice{};
}

}  // namespace

const Warp plane_optimal{"plane_optimal", "one texel per pixel on the best-lit receiver plane", choose, true};

}  // namespace gnomon::warps
