// A body's vertices in light space, and the body as warps see it.
#include "map/light_body.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/body.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "lanes/point_pair.hpp"
#include "map/size.hpp"
#include "map/turned.hpp"
#include "warp/registry.hpp"

namespace gnomon {
namespace {

// Ratio of the far to the near end's texels beyond which float matrices no longer hold the map together.
constexpr double kStrongest = 1e9;

/// Half opening of the frustum in the plane of view and light: the largest slope of a corner along it.
double tan_half_fov(const PlanContext& c, const LightFrame& frame) noexcept {
  const glm::dvec3 across = frame.y - c.axes.forward * glm::dot(frame.y, c.axes.forward);
  const glm::dvec3 w = safe_normalize(across, c.axes.up);
  const double x = std::abs(glm::dot(w, c.axes.right)), y = std::abs(glm::dot(w, c.axes.up));
  return x * max_of(std::abs(c.camera.left), std::abs(c.camera.right)) +
         y * max_of(std::abs(c.camera.bottom), std::abs(c.camera.top));
}

ViewInLight view_in_light(const PlanContext& c, const LightFrame& frame) noexcept {
  const Camera& camera = c.camera;
  return {frame.turned(c.axes.right),
          frame.turned(c.axes.up),
          frame.turned(c.axes.forward),
          camera.left,
          camera.right,
          camera.bottom,
          camera.top,
          (camera.right - camera.left) / camera.width,
          (camera.top - camera.bottom) / camera.height};
}

/// The body with vertices and faces along the frame's axes. `turned`: the vertices along them where they are
/// known, else empty.
void turn(const Polytope& body, const LightFrame& frame, std::span<const WarpInput::Point> turned,
          Polytope& out) noexcept {
  out = body;
  for (std::size_t i = 0; i < body.vertices().size(); ++i) {
    glm::dvec3& position = out.vertex[i].position;
    position = turned.empty() ? frame.turned(body.vertex[i].position)
                              : glm::dvec3(turned[i].x, turned[i].y, turned[i].z);
  }
  for (int f = 0; f < body.face_count; ++f) {
    out.plane[static_cast<std::size_t>(f)].normal =
        frame.turned(body.plane[static_cast<std::size_t>(f)].normal);
  }
}

/// A vertex of a body in light space. `least`: view depth from which error counts; `nearest`: distance from a
/// local light below which there is only rounding.
WarpInput::Point light_point(const PlanContext& c, const LightSpace& space, const ViewedPoint& point,
                             double least, double nearest) noexcept {
  const glm::dvec3 p = space.frame.turned(point.position);
  const double depth = c.camera.orthographic ? 1.0 : max_of(least, point.depth);
  if (!space.perspective) return {p.x, p.y, p.z, depth};
  const double h = 1.0 / max_of(space.distance(p), nearest);
  return {(p.x - space.apex.x) * h, (p.y - space.apex.y) * h, h, depth * h};
}

/// View depth from which the error of the request's map counts. Before the receivers is air, though the box
/// round all of them may hold the eye; in the band of a transition the map before it still shows.
double counted_from(const PlanContext& c, const MapRequest& request) noexcept {
  const double hint = max_of(c.options.split.pseudo_near, c.nearest_receiver), band = request.slot.overlap;
  return band > 0.0 ? max_of(hint, request.begin + band) : hint;
}

/// Under parallel light, where the error of all vertices counts: false, and nothing is added, where a vertex
/// lies before `pseudo_near`, or there is no room.
bool add_two_by_two(const PlanContext& c, const LightFrame& frame, const Polytope& body, double least,
                    double pseudo_near, LightBody& out) noexcept {
  const std::span<const Polytope::Vertex> vertices = body.vertices();
  if (static_cast<std::size_t>(out.count) + vertices.size() + 1 > out.point.size()) return false;
  const DotPair along_x(frame.x), along_y(frame.y), along_z(frame.z), along_view(c.axes.forward);
  const Pair floor(least);
  Pair nearest(std::numeric_limits<double>::infinity());
  WarpInput::Point* first = &out.point[static_cast<std::size_t>(out.count)];
  for_each_two<VertexPair>(vertices, [&](std::size_t i, const VertexPair& two) {
    WarpInput::Point* to = first + i;
    const Pair light_x = along_x(two), light_y = along_y(two), light_z = along_z(two);
    const Pair depth = along_view(two);
    nearest = min_of(nearest, depth);
    const Pair counted = c.camera.orthographic ? Pair(1.0) : max_of(floor, depth);
    lows(light_x, light_y).to(&to[0].x);
    lows(light_z, counted).to(&to[0].z);
    highs(light_x, light_y).to(&to[1].x);
    highs(light_z, counted).to(&to[1].z);
  });
  if (!c.camera.orthographic && min_of(nearest.low(), nearest.high()) < pseudo_near) return false;
  out.count += body.vertex_count;
  return true;
}

void add_vertices(const PlanContext& c, const MapRequest& request, const Polytope& body, double nearest,
                  LightBody& out) noexcept {
  const double pseudo_near = counted_from(c, request);
  // Receivers in the room for motion are served from the slice's begin on.
  const double begin = request.room > 0.0 ? request.begin : 0.0;
  const double least = max_of(max_of(c.camera.near_depth, pseudo_near), begin);
  if (!request.space.perspective && add_two_by_two(c, request.space.frame, body, least, pseudo_near, out))
    return;
  const auto add = [&](const glm::dvec3& position, bool counts) {
    if (out.count == kMaxBodyPoints) return;
    WarpInput::Point& p = out.point[static_cast<std::size_t>(out.count++)];
    p = light_point(c, request.space, {position, glm::dot(c.axes.forward, position)}, least, nearest);
    if (!counts) p.depth = std::numeric_limits<double>::infinity();
  };
  Polytope counted;
  if (!c.camera.orthographic) counted = part_inside(body, Plane{c.axes.forward, -pseudo_near});
  // The map holds the whole body; the error counts where the cut leaves something, and there is room to say
  // so.
  const bool from_cut =
      !counted.empty() && out.count + body.vertex_count + counted.vertex_count <= kMaxBodyPoints;
  for (const Polytope::Vertex& v : body.vertices()) add(v.position, !from_cut);
  if (!from_cut) return;
  for (const Polytope::Vertex& v : counted.vertices()) add(v.position, true);
}

/// The points that stand for the request's body: those of several views, or its vertices.
void add_body(const PlanContext& c, const MapRequest& request, double nearest, LightBody& out) noexcept {
  if (request.viewed.empty()) return add_vertices(c, request, request.body, nearest, out);
  const double least = max_of(c.camera.near_depth, counted_from(c, request));
  for (const ViewedPoint& point : request.viewed)
    out.point[static_cast<std::size_t>(out.count++)] = light_point(c, request.space, point, least, nearest);
}

/// Rounding may take vertices near a local light out of its frustum: then the whole frustum is the body.
void hold_to_frustum(const MapRequest& request, LightBody& body) noexcept {
  constexpr double kRounding = 1.0 + 1e-3;
  bool usable = true;
  double depth = 0.0;
  for (int i = 0; i < body.count; ++i) {
    WarpInput::Point& p = body.point[static_cast<std::size_t>(i)];
    usable = usable && max_of(std::abs(p.x), std::abs(p.y)) <= request.slope * kRounding;
    p.x = clamp_to(p.x, -request.slope * kRounding, request.slope * kRounding);
    p.y = clamp_to(p.y, -request.slope * kRounding, request.slope * kRounding);
    if (std::isfinite(p.depth)) depth = max_of(depth, p.depth);
  }
  if (usable) return;
  body.count = body.count < kMaxBodyPoints - 4 ? body.count : kMaxBodyPoints - 4;
  for (int i = 0; i < 4; ++i) {
    body.point[static_cast<std::size_t>(body.count++)] = {(i & 1) ? request.slope : -request.slope,
                                                          (i & 2) ? request.slope : -request.slope,
                                                          1.0 / body.farthest, depth};
  }
}

/// The strongest warp of parallel light whose texels, where they are smallest, still tell their depth. A
/// rasterizer finds the depth of a triangle from its corners. Where one lies at the farthest caster, w there
/// is 1 + kappa reach times the least w of the map, and depth is lost by as much of single precision. The
/// smallest texel is length / (texels stretch).
double most_of_precision(const PlanContext& c, const MapRequest& request, const LightBody& body) noexcept {
  constexpr double kSinglePrecision = 1 << 22;  // to a few units
  const double length = body.bounds.y_max - body.bounds.y_min;
  if (!(length > 0.0)) return kStrongest;
  const double depth = max_of(length, body.bounds.z_max - body.bounds.z_min);
  const double texels = max_of(request.slot.width, 1);
  const double square =
      kSinglePrecision / texels * (length / depth) * (length / max_of(c.caster_reach, length));
  return square < kStrongest ? max_of(1.0, std::sqrt(square)) : kStrongest;
}

/// The strongest warp that a map of this light can take: the ratio of its texels' lengths at both ends.
double most_stretch(const PlanContext& c, const MapRequest& request, const LightBody& body) noexcept {
  if (!request.space.perspective) {
    // Other objectives promise the least bound that any warp has.
    const bool bounded = c.options.warp.objective == Objective::picture && is_searched(request.warp);
    return bounded ? most_of_precision(c, request, body) : kStrongest;
  }
  const PlaneMap plane = body.under(request.unwarped);
  const double share = border_share(c, request, body, plane);
  const double border =
      static_cast<double>(border_texels(c.options, request.slot.width, share)) / request.slot.width;
  return 1.0 + kBorderGrowth / max_of(border / (1.0 - 2.0 * border), 1e-4);
}

/// The context's seen points that this map serves, along the frame's axes.
std::span<const glm::dvec3> seen_inside(const PlanContext& c, const MapRequest& request, double begin,
                                        std::array<glm::dvec3, SeenPoints::kMost>& seen) noexcept {
  // Boxes' sides are where bodies end.
  constexpr double kTouching = 1e-6;
  const std::size_t inside = points_inside(request.body, c.seen, kTouching, seen);
  const double least = begin * (1.0 - kTouching);
  std::size_t count = 0;
  for (std::size_t i = 0; i < inside; ++i) {
    if (!c.camera.orthographic && glm::dot(c.axes.forward, seen[i]) < least) continue;
    seen[count++] = request.space.frame.turned(seen[i]);
  }
  return {seen.data(), count};
}

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

Polytope served_by(const MapRequest& request, const PlaneMap& plane) noexcept {
  Polytope served = *request.all_receivers;
  const LightFrame& frame = request.space.frame;
  // A look-up leaves a quarter texel of the border to rounding.
  const double room =
      1.0 / (request.slot.width < request.slot.height ? request.slot.width : request.slot.height);
  PlaneMap wide = plane;
  grow(wide, room);
  clip(served, edge_plane(frame, wide, wide.choice.row_a, wide.a_min, 1.0));
  clip(served, edge_plane(frame, wide, wide.choice.row_a, wide.a_max, -1.0));
  clip(served, edge_plane(frame, wide, wide.choice.row_b, wide.b_min, 1.0));
  clip(served, edge_plane(frame, wide, wide.choice.row_b, wide.b_max, -1.0));
  return served;
}

MapRequest with_body(const MapRequest& r, const Polytope& body) noexcept {
  return {r.slot,  body,    r.space,           r.warp, r.begin, r.end,  r.unwarped, r.centre,
          r.slope, r.range, r.without_casters, r.last, nullptr, r.room, {}};
}

}  // namespace

LightBody in_light_space(const PlanContext& c, const MapRequest& request) noexcept {
  LightBody body;
  const LightSpace& space = request.space;
  if (!space.perspective) {
    add_body(c, request, 0.0, body);
    body.bounds = bounds_of(body.points());
    return body;
  }
  body.nearest = std::numeric_limits<double>::infinity();
  body.farthest = 0.0;
  for (const Polytope::Vertex& v : request.body.vertices()) {
    const double distance = space.distance(space.frame.turned(v.position));
    body.farthest = max_of(body.farthest, distance);
    body.nearest = min_of(body.nearest, distance);
  }
  body.nearest = max_of(body.nearest, kLeastNearShare * body.farthest);
  add_body(c, request, body.nearest, body);
  hold_to_frustum(request, body);
  body.bounds = bounds_of(body.points());
  return body;
}

LightBody judged_body(const PlanContext& c, const MapRequest& request, Polytope& focus) noexcept {
  LightBody points = in_light_space(c, request);
  focus.vertex_count = 0;
  if (c.options.warp.focus.empty()) return points;
  focus = request.body;
  clip(focus, relative_to(c.options.warp.focus, c.camera.position));
  if (focus.empty()) return points;
  for (int i = 0; i < points.count; ++i)
    points.point[static_cast<std::size_t>(i)].depth *= c.options.warp.focus_weight;
  add_vertices(c, request, focus, points.nearest, points);
  points.bounds = bounds_of(points.points());
  return points;
}

WarpQuestion::WarpQuestion(const PlanContext& c, const MapRequest& request, const LightBody& body,
                           WarpFocus* focus) noexcept
    : points(focus == nullptr ? body : focus->judged = judged_body(c, request, focus->part)), in{} {
  const LightFrame& frame = request.space.frame;
  // Parallel light's points are the vertices, and those of a focus or a cut behind them.
  const bool known = !request.space.perspective && request.viewed.empty();
  turn(request.body, frame, known ? points.points() : std::span<const WarpInput::Point>(), body_light);
  if (focus != nullptr && !focus->part.empty()) turn(Polytope(focus->part), frame, {}, focus->part);
  in.body = points.points();
  in.y_min = points.bounds.y_min;
  in.y_max = points.bounds.y_max;
  double nearest = std::numeric_limits<double>::infinity();
  const Polytope::Vertex* first = &request.body.vertex[0];
  for (const Polytope::Vertex& v : request.body.vertices()) {
    const double depth = glm::dot(c.axes.forward, v.position);
    if (!(depth < nearest)) continue;
    nearest = depth;
    first = &v;
  }
  const LightSpace& space = request.space;
  in.view = view_in_light(c, frame);
  const glm::dvec3 light_way =
      space.perspective ? safe_normalize(space.ray(frame.turned(first->position)), {0.0, 0.0, -1.0})
                        : glm::dvec3(0.0, 0.0, -1.0);
  const glm::dvec3 across = glm::cross(in.view.forward, light_way);
  in.sin_gamma = std::sqrt(glm::dot(across, across));
  in.cos_gamma = glm::dot(in.view.forward, light_way);
  in.pseudo_near = c.camera.orthographic ? 0.0 : counted_from(c, request);
  in.depth_begin = max_of(request.begin, counted_from(c, request));
  in.depth_end = max_of(request.end, in.depth_begin);
  in.tan_half_fov = tan_half_fov(c, frame);
  in.orthographic = c.camera.orthographic;
  in.objective = c.options.warp.objective;
  in.polytope = &body_light;
  if (request.receiver != nullptr) {
    receiver = {frame.turned(request.receiver->normal), request.receiver->offset};
    in.receiver = &receiver;
  }
  in.held = c.held;
  in.seen = seen_inside(c, request, in.depth_begin, seen);
  if (in.objective == Objective::picture && in.seen.size() < SeenPoints::kFewest)
    in.objective = Objective::storage;
  in.focus = focus == nullptr ? nullptr : &focus->part;
  in.focus_weight = c.options.warp.focus_weight;
  in.light = space;
  in.centre = request.centre;
  in.unwarped = request.unwarped;
  in.most_stretch = most_stretch(c, request, points);
  in.scale_near =
      space.perspective
          ? light_point(c, space, {first->position, nearest}, in.depth_begin, points.nearest).depth
          : in.depth_begin;
  in.depth_per_y = space.perspective ? in.view.forward.y : in.sin_gamma;
  // A warp has to beat the map that would be drawn without it.
  if (c.how.rotated) in.unwarped = turned_to_least_area(in, in.unwarped);
}

ServedBody::ServedBody(const PlanContext& c, const MapRequest& request, const LightBody& body,
                       const PlaneMap& plane) noexcept
    : own_(request), points_(&body) {
  if (request.all_receivers == nullptr) return;
  served_ = served_by(request, plane);
  // Rounding may leave nothing of a map that is all border: its own body is all that it serves.
  if (served_.empty()) return;
  served_request_.emplace(with_body(request, served_));
  served_points_ = in_light_space(c, *served_request_);
  points_ = &served_points_;
}

}  // namespace gnomon
