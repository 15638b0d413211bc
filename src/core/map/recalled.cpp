// A map of an earlier frame over this frame's body: what is it there, and can it be drawn again?
#include "map/recalled.hpp"

#include <cmath>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {
namespace {

// A warp that changes texels by less than this over the whole body has no direction worth keeping.
constexpr double kFlat = 1e-3;
// Share of a held map that the view must use: less wastes more texels than a still grid is worth.
constexpr double kLeastUse = 0.4;

/// OpenGL clip space from homogeneous light space.
glm::dmat4 gl_from_light(const PlanContext& c, const LightSpace& space,
                         const glm::dmat4& gl_from_world) noexcept {
  return counted_from(gl_from_world, c.camera.position) * space.relative_from_light();
}

Homography homography(const glm::dmat4& m) noexcept {
  const auto row = [&](int i) { return glm::dvec3(m[0][i], m[1][i], m[3][i]); };
  return {row(0), row(1), row(3)};
}

}  // namespace

Homography of_plane(const PlaneMap& plane) noexcept {
  return homography(clip_from_light(plane, {0.0, 1.0}, 0.0));
}

Homography of_matrix(const PlanContext& c, const LightSpace& space,
                     const glm::dmat4& gl_from_world) noexcept {
  return homography(gl_from_light(c, space, gl_from_world));
}

Span along(std::span<const WarpInput::Point> body, const glm::dvec2& axis) noexcept {
  Span s{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const WarpInput::Point& p : body) {
    const double u = p.x * axis.x + p.y * axis.y;
    s.low = min_of(s.low, u);
    s.high = max_of(s.high, u);
  }
  return s;
}

Decomposed decompose(const Homography& h, std::span<const WarpInput::Point> body,
                     const glm::dvec2& flat_axis) noexcept {
  Decomposed d{};
  const double steepness = std::sqrt(h.w.x * h.w.x + h.w.y * h.w.y);
  glm::dvec2 axis = steepness > 0.0 ? glm::dvec2(h.w.x, h.w.y) / steepness : flat_axis;
  Span u = along(body, axis);
  double w_near = h.w.z + steepness * u.low;
  if (!(w_near > 0.0)) return d;
  double kappa = steepness / w_near;
  if (kappa * (u.high - u.low) < kFlat) {
    axis = flat_axis;
    u = along(body, axis);
    w_near = h.w.z + h.w.x * axis.x * u.low + h.w.y * axis.y * u.low;
    kappa = 0.0;
    if (!(w_near > 0.0)) return d;
  }
  d.u_min = u.low;
  d.length = u.high - u.low;
  const double stretch = 1.0 + kappa * d.length;
  // Over (s, u - u_min, 1), divided by the weight at the near end.
  const auto terms = [&](const glm::dvec3& row, double& constant) {
    const double per_s = (row.x * axis.y - row.y * axis.x) / w_near;
    const double per_u = (row.x * axis.x + row.y * axis.y) / w_near;
    constant = row.z / w_near + per_u * u.low;
    return glm::dvec2(per_s, (per_u - constant * kappa) / stretch);
  };
  d.choice.kappa = kappa;
  d.choice.axis = axis;
  d.choice.row_a = terms(h.a, d.const_a);
  d.choice.row_b = terms(h.b, d.const_b);
  d.valid = std::isfinite(stretch);
  return d;
}

Recalled recall(const Homography& h, const WarpQuestion& question, const glm::dvec2& flat_axis) noexcept {
  const WarpInput& in = question.in;
  Recalled r{};
  r.map = decompose(h, in.body, flat_axis);
  if (!r.map.valid) return r;
  WarpChoice choice = r.map.choice;
  choice.row_a /= length_of(choice.row_a);
  choice.row_b /= length_of(choice.row_b);
  r.plane = question.points.under(choice);
  r.usable = usable(in.body, question.points.bounds, r.plane, in.most_stretch);
  return r;
}

HeldMap held_map(const PlanContext& c, const MapRequest& request, const LightBody& body) noexcept {
  HeldMap held{};
  const glm::dmat4 m = gl_from_light(c, request.space, request.last->gl_from_world);
  const Homography h = homography(m);
  const Decomposed d = decompose(h, body.points(), {0.0, 1.0});
  if (!d.valid) return held;
  const double fill = 1.0 - 2.0 * request.last->filter_margin_texels / request.last->width;
  PlaneMap& plane = held.plane;
  plane.choice = d.choice;
  plane.u_min = d.u_min;
  plane.length = d.length;
  plane.stretch = 1.0 + d.choice.kappa * d.length;
  // What the rows give is -fill .. fill at the rectangle's edges, less their constants.
  plane.a_min = -fill - d.const_a;
  plane.a_max = fill - d.const_a;
  plane.b_min = -fill - d.const_b;
  plane.b_max = fill - d.const_b;
  const PlaneMap tight = plane_map(body.points(), d.choice);
  const bool inside = tight.a_min >= plane.a_min && tight.a_max <= plane.a_max &&
                      tight.b_min >= plane.b_min && tight.b_max <= plane.b_max;
  const double used = (tight.a_max - tight.a_min) * (tight.b_max - tight.b_min) /
                      ((plane.a_max - plane.a_min) * (plane.b_max - plane.b_min));
  if (!inside || !(used >= kLeastUse)) return held;
  // Depth over the weight of the near end is w + 2 (bottom - h) / height.
  const double w_near = plane.w(0.0, 0.0) / h.weight({0.0, 0.0, 0.0, 1.0});
  const double per_height = m[2][2] * w_near, at_origin = m[3][2] * w_near;
  if (!(per_height < 0.0)) return held;
  held.depths.height = -2.0 / per_height;
  held.depths.bottom = 0.5 * held.depths.height * (at_origin - plane.w(0.0, 0.0));
  held.holds = true;
  return held;
}

}  // namespace gnomon
