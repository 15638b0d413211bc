// All receivers that a map may serve: those it was fitted to, or all of the plan's that it holds.
#include "map/served.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gnomon {
namespace {

/// Keeps what lies on the inner side of one edge of the rectangle: dot(row, (X, Y)) against `limit`, times w,
/// which is linear in the light plane.
Plane edge_plane(const LightFrame& frame, const PlaneMap& plane, const glm::dvec2& row, double limit,
                 double sign) noexcept {
  const WarpChoice& choice = plane.choice;
  const glm::dvec2 across{choice.axis.y, -choice.axis.x};
  const double per_u = row.y * plane.stretch - limit * choice.kappa;
  const glm::dvec2 slope = across * row.x + choice.axis * per_u;
  const double constant = -row.x * choice.centre - row.y * plane.stretch * plane.u_min -
                          limit * (1.0 - choice.kappa * plane.u_min);
  const double length = glm::length(slope);
  if (!(length > 0.0)) return {frame.z, std::numeric_limits<double>::max()};
  const double scale = sign / length;
  return {(frame.x * slope.x + frame.y * slope.y) * scale, constant * scale};
}

Polytope held_by(const MapRequest& request, const PlaneMap& plane) noexcept {
  Polytope held = *request.all_receivers;
  const LightFrame& frame = request.space.frame;
  // A look-up leaves a quarter texel of the border to rounding.
  const double room =
      1.0 / (request.slot.width < request.slot.height ? request.slot.width : request.slot.height);
  PlaneMap wide = plane;
  grow(wide, room);
  clip(held, edge_plane(frame, wide, wide.choice.row_a, wide.a_min, 1.0));
  clip(held, edge_plane(frame, wide, wide.choice.row_a, wide.a_max, -1.0));
  clip(held, edge_plane(frame, wide, wide.choice.row_b, wide.b_min, 1.0));
  clip(held, edge_plane(frame, wide, wide.choice.row_b, wide.b_max, -1.0));
  return held;
}

MapRequest with_body(const MapRequest& r, const Polytope& body) noexcept {
  return {r.slot,  body,    r.space,           r.warp, r.begin, r.end,  r.unwarped, r.centre,
          r.slope, r.range, r.without_casters, r.last, nullptr, r.room, {}};
}

}  // namespace

ServedBody::ServedBody(const PlanContext& c, const MapRequest& request, const LightBody& body,
                       const PlaneMap& plane) noexcept
    : own_(request), points_(&body) {
  if (request.all_receivers == nullptr) return;
  held_ = held_by(request, plane);
  // Rounding may leave nothing of a map that is all border: its own body is all that it serves.
  if (held_.empty()) return;
  held_request_.emplace(with_body(request, held_));
  held_points_ = in_light_space(c, *held_request_);
  points_ = &held_points_;
}

}  // namespace gnomon
