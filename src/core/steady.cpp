// How far a map may go, in one frame, from where the last frame's was towards where it is best.
//
// Two projective maps of the light plane with weights w0 and w1 have texel densities whose ratio is a
// constant times (w0 / w1)^3: a linear-fractional function to the third power, extreme at the body's
// vertices. So the change at every surface point is bounded exactly by a look at the vertices.
#include "steady.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "elementary.hpp"
#include "light_plane_error.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

// Of the logarithm of the density: what is aimed at stays a tenth below what is promised.
constexpr double kLimit = 0.9 * 0.04879016416943205;  // ln(1 + kDensityStep)
// A warp that changes texels by less than this over the whole body has no direction worth keeping.
constexpr double kFlat = 1e-3;
// Best warps that are better by less than this are not followed.
constexpr double kWorthFollowing = 0.02;
// A change beyond this factor is a cut: nothing is gained by going slowly.
constexpr double kCut = 0.4054651081081644;  // ln 1.5
constexpr double kPi = 3.141592653589793;
// Steps of the search for the farthest way that is still smooth.
constexpr int kBisections = 6;
// Largest change of an edge between cascades from frame to frame, of its logarithm.
constexpr double kEdgeStep = 0.01;
// Share of a held map that the view must use: less wastes more texels than a still grid is worth.
constexpr double kLeastUse = 0.4;

/// A map of the light plane as a matrix over (x, y, 1) of the light frame.
struct Homography {
  glm::dvec3 a, b, w;  // rows
  [[nodiscard]] double weight(const WarpInput::Point& p) const noexcept {
    return w.x * p.x + w.y * p.y + w.z;
  }
  [[nodiscard]] double determinant() const noexcept { return glm::dot(a, glm::cross(b, w)); }
};

Homography of_map(const PlanContext& c, const glm::dmat4& gl_from_world) noexcept {
  const auto row = [&](int i) {
    const glm::dvec3 r{gl_from_world[0][i], gl_from_world[1][i], gl_from_world[2][i]};
    return glm::dvec3(glm::dot(r, c.frame.x), glm::dot(r, c.frame.y),
                      glm::dot(r, c.camera.position) + gl_from_world[3][i]);
  };
  return {row(0), row(1), row(3)};
}

Homography of_plane(const PlaneMap& plane) noexcept {
  const glm::dmat4 m = clip_from_light(plane, {0.0, 1.0}, 0.0);
  const auto row = [&](int i) { return glm::dvec3(m[0][i], m[1][i], m[3][i]); };
  return {row(0), row(1), row(3)};
}

/// The homography over the body in the terms of a WarpChoice with centre 0: rows over the image, not yet of
/// unit length, and the constant that goes with each.
struct Decomposed {
  bool valid;
  WarpChoice choice;
  double u_min, length;
  double const_a, const_b;
};

struct Span {
  double low, high;
};
Span along(std::span<const WarpInput::Point> body, const glm::dvec2& axis) noexcept {
  Span s{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const WarpInput::Point& p : body) {
    const double u = p.x * axis.x + p.y * axis.y;
    s.low = min_of(s.low, u);
    s.high = max_of(s.high, u);
  }
  return s;
}

/// `flat_axis` serves where the map has no fall-off that could tell an axis.
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

/// What a warp looks like, in quantities whose even steps look even.
struct Shape {
  double axis;          // angle
  double stretch;       // logarithm
  double row_a, row_b;  // angles
};

Shape shape_of(const Decomposed& d) noexcept {
  const auto angle = [](const glm::dvec2& v) { return elementary::atan2(v.y, v.x); };
  return {angle(d.choice.axis), elementary::log1p(d.choice.kappa * d.length), angle(d.choice.row_a),
          angle(d.choice.row_b)};
}

/// `to` plus as many `period`s as bring it nearest to `from`.
double nearest_turn(double from, double to, double period) noexcept {
  return to + period * std::round((from - to) / period);
}

/// From the last frame's shape to the best, by the shortest turns.
struct Way {
  Shape from, to;
  [[nodiscard]] WarpChoice at(double t, std::span<const WarpInput::Point> body) const noexcept {
    const auto mix = [&](double a, double b) { return a + (b - a) * t; };
    const double axis = mix(from.axis, to.axis), a = mix(from.row_a, to.row_a), b = mix(from.row_b, to.row_b);
    WarpChoice choice;
    choice.axis = {elementary::cos(axis), elementary::sin(axis)};
    const Span u = along(body, choice.axis);
    const double length = u.high - u.low;
    choice.kappa = length > 0.0 ? elementary::expm1(mix(from.stretch, to.stretch)) / length : 0.0;
    choice.row_a = {elementary::cos(a), elementary::sin(a)};
    choice.row_b = {elementary::cos(b), elementary::sin(b)};
    return choice;
  }
};

Way way_between(const Decomposed& from, const Decomposed& to) noexcept {
  Way way{shape_of(from), shape_of(to)};
  way.to.axis = nearest_turn(way.from.axis, way.to.axis, 2.0 * kPi);
  // A rectangle turned by a right angle is the same rectangle, its sides swapped.
  const double straight = std::abs(way.from.row_a - nearest_turn(way.from.row_a, way.to.row_a, kPi));
  const double swapped = std::abs(way.from.row_a - nearest_turn(way.from.row_a, way.to.row_b, kPi));
  if (swapped < straight) std::swap(way.to.row_a, way.to.row_b);
  way.to.row_a = nearest_turn(way.from.row_a, way.to.row_a, kPi);
  way.to.row_b = nearest_turn(way.from.row_b, way.to.row_b, kPi);
  return way;
}

/// Bounds over the body of the logarithm of texels per area, now over before.
struct Change {
  double low, high;
  [[nodiscard]] double largest() const noexcept { return max_of(-low, high); }
};

Change change_between(const Homography& before, const Homography& now,
                      std::span<const WarpInput::Point> body) noexcept {
  Change change{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const double area = elementary::log(std::abs(now.determinant() / before.determinant()));
  for (const WarpInput::Point& p : body) {
    const double w = before.weight(p);
    // Where the last frame had nothing, nothing changes.
    if (!(w > 0.0)) continue;
    const double value = area + 3.0 * elementary::log(w / now.weight(p));
    change.low = min_of(change.low, value);
    change.high = max_of(change.high, value);
  }
  return change;
}

/// The strongest fall-off whose texels keep up with the camera: texels of a warp that moves along with the
/// viewer change with the third power of w.
double strongest_in_motion(const PlanContext& c, double length) noexcept {
  const PlanHistory& history = *c.history;
  const glm::dvec3 move = c.camera.position - history.eye_world;
  const glm::dvec2 step{glm::dot(move, c.frame.x), glm::dot(move, c.frame.y)};
  const glm::dvec3 turn = glm::cross(history.forward, c.axes.forward);
  const double per_kappa = std::sqrt(glm::dot(step, step)) + 0.5 * length * std::sqrt(glm::dot(turn, turn));
  constexpr double kShare = 0.7;  // of the limit; the rest is left to the rectangle
  return per_kappa > 0.0 ? kShare * kLimit / (3.0 * per_kappa) : std::numeric_limits<double>::infinity();
}

}  // namespace

void add_event(PlanHistory& history, PlanEventKind kind, int map, double ratio) noexcept {
  if (history.event_count < kMaxMaps)
    history.event[static_cast<std::size_t>(history.event_count++)] = {kind, map, ratio};
}

const PlanHistory::Map* remembered(const PlanContext& c, const ShadowMap& map) noexcept {
  if (c.history == nullptr) return nullptr;
  const PlanHistory::Map& last = c.history->map[static_cast<std::size_t>(map.cascade)];
  const bool fits = last.frame >= 0 && last.frame == c.history->frame - 1 && last.width == map.width &&
                    last.height == map.height;
  return fits ? &last : nullptr;
}

PlaneMap steady_plane(const PlanContext& c, const WarpInput& in, const WarpChoice& best,
                      const ShadowMap& map) noexcept {
  const PlaneMap target = plane_map(in.body, best);
  if (c.history == nullptr) return target;
  const PlanHistory::Map* last = remembered(c, map);
  if (last == nullptr) {
    add_event(*c.history, PlanEventKind::map_appeared, map.cascade, 1.0);
    return target;
  }
  const Homography before = of_map(c, last->gl_from_world);
  const Decomposed from = decompose(before, in.body, best.axis);
  const auto changed = [&](const PlaneMap& plane) {
    const int margin = margin_texels(c.options, map.width, plane, in.body);
    const double rims = 2.0 * elementary::log(1.0 - 2.0 * margin / map.width);
    Change change = change_between(before, of_plane(plane), in.body);
    change.low += rims;
    change.high += rims;
    return change;
  };
  const auto jump = [&](const PlaneMap& plane, const Change& change) {
    const double ratio = -change.low > change.high ? change.low : change.high;
    if (change.largest() > elementary::log1p(kDensityStep))
      add_event(*c.history, PlanEventKind::density_jump, map.cascade, elementary::exp(ratio));
    return plane;
  };
  if (!from.valid || !usable(in, from.choice)) return jump(target, changed(target));
  WarpChoice goal = best;
  goal.kappa = min_of(goal.kappa, strongest_in_motion(c, target.length));
  const Decomposed to = decompose(of_plane(plane_map(in.body, goal)), in.body, from.choice.axis);
  const Way way = way_between(from, to);
  const auto smooth = [&](const Change& change) {
    return -change.low <= kLimit && change.high - change.low <= 2.0 * kLimit;
  };
  const auto laid = [&](double t) { return plane_map(in.body, way.at(t, in.body)); };
  LightPlaneError error(in);
  double share = 1.0;
  if (!in.orthographic && error.value(way.at(0.0, in.body)) <= error.value(goal) * (1.0 + kWorthFollowing)) {
    share = 0.0;
  } else if (!smooth(changed(laid(1.0)))) {
    double bad = 1.0;
    share = 0.0;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (share + bad);
      (smooth(changed(laid(middle))) ? share : bad) = middle;
    }
  }
  PlaneMap plane = laid(share);
  Change change = changed(plane);
  if (change.largest() > kCut) return jump(target, changed(target));
  if (change.high > kLimit) {
    const double less = change.high - kLimit;
    // Fewer texels per area, everywhere by the same factor.
    grow(plane, 0.5 * (elementary::exp(0.5 * less) - 1.0));
    change.low -= less;
    change.high -= less;
  }
  return jump(plane, change);
}

HeldMap held_map(const PlanContext& c, const PlanHistory::Map& last, const LightBody& body,
                 double rim) noexcept {
  HeldMap held{};
  if (c.light_direction != c.history->light_direction) return held;
  const Homography h = of_map(c, last.gl_from_world);
  const Decomposed d = decompose(h, body.points(), {0.0, 1.0});
  if (!d.valid) return held;
  const double fill = 1.0 - 2.0 * rim;
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
  // Depth over the weight of the near end is w + 2 (bottom - z) / height.
  const double w_near = plane.w(0.0, 0.0) / h.weight({0.0, 0.0, 0.0, 1.0});
  const auto depth_row = [&](const glm::dvec3& direction) {
    return (last.gl_from_world[0][2] * direction.x + last.gl_from_world[1][2] * direction.y +
            last.gl_from_world[2][2] * direction.z);
  };
  const double per_z = depth_row(c.frame.z) * w_near;
  const double at_eye = (depth_row(c.camera.position) + last.gl_from_world[3][2]) * w_near;
  if (!(per_z < 0.0)) return held;
  held.depths.height = -2.0 / per_z;
  held.depths.bottom = 0.5 * held.depths.height * (at_eye - plane.w(0.0, 0.0));
  held.holds = true;
  return held;
}

void steady_edges(PlanHistory& history, std::span<double> edges) noexcept {
  const auto count = edges.size();
  if (history.frame > 0 && history.edge_count == static_cast<int>(count)) {
    const double slower = elementary::exp(-kEdgeStep), faster = elementary::exp(kEdgeStep);
    const auto near = [&](double to, double from) { return clamp_to(to, from * slower, from * faster); };
    // What comes into view is covered at once.
    edges[0] = min_of(edges[0], near(edges[0], history.edge[0]));
    edges[count - 1] = max_of(edges[count - 1], near(edges[count - 1], history.edge[count - 1]));
    for (std::size_t i = 1; i + 1 < count; ++i)
      edges[i] = clamp_to(near(edges[i], history.edge[i]), edges[i - 1], edges[count - 1]);
  }
  std::copy(edges.begin(), edges.end(), history.edge.begin());
  history.edge_count = static_cast<int>(count);
}

void remember(PlanHistory& history, int cascade, const ShadowMap& map,
              const glm::dmat4& gl_from_world) noexcept {
  history.map[static_cast<std::size_t>(cascade)] = {history.frame, gl_from_world, map.width, map.height,
                                                    map.filter_margin_texels};
}

}  // namespace gnomon
