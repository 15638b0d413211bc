// How far a map may go, in one frame, from where the last frame's was towards where it is best.
//
// Two projective maps of the light plane with weights w0 and w1 have texel densities whose ratio is a
// constant times (w0 / w1)^3: a linear-fractional function to the third power, extreme at the body's
// vertices. So the change at every surface point is bounded exactly by a look at the vertices.
#include "map/history.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "map/record.hpp"
#include "map/size.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {
namespace {

/// A change of the logarithm of texels per area beyond this is a cut: nothing is gained by going slowly.
constexpr double kCut = 0.4054651081081644;  // ln 1.5

// A warp that changes texels by less than this over the whole body has no direction worth keeping.
constexpr double kFlat = 1e-3;
// Share of a cached map that the view must use: less wastes more texels than a stable grid is worth.
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

// Of the logarithm of the density: what is aimed at stays a tenth below what is promised.
constexpr double kLimit = 0.9 * 0.04879016416943205;  // ln(1 + kDensityStep)
// Best warps that are better by less than this are not followed.
constexpr double kWorthFollowing = 0.02;
constexpr double kPi = 3.141592653589793;
// Steps of the search for the farthest way that is still smooth, and how much less is taken than a straight
// line through two of them says.
constexpr int kSteps = 3;
constexpr int kBisections = 6;  // where a line says nothing
constexpr double kShorter = 0.98;

/// What a warp looks like, in quantities whose even steps look even.
struct WarpShape {
  double axis;          // angle
  double stretch;       // logarithm
  double row_a, row_b;  // angles
};

/// `length`: of the body along the axis.
WarpShape shape_of(const WarpChoice& choice, double length) noexcept {
  const auto angle = [](const glm::dvec2& v) { return elementary::atan2(v.y, v.x); };
  return {angle(choice.axis), elementary::log1p(choice.kappa * length), angle(choice.row_a),
          angle(choice.row_b)};
}

/// `to` plus as many `period`s as bring it nearest to `from`.
double nearest_turn(double from, double to, double period) noexcept {
  return to + period * std::round((from - to) / period);
}

WarpChoice choice_at(const WarpShape& shape, std::span<const WarpInput::Point> body) noexcept {
  WarpChoice choice;
  choice.axis = {elementary::cos(shape.axis), elementary::sin(shape.axis)};
  const Span u = along(body, choice.axis);
  const double length = u.high - u.low;
  choice.kappa = length > 0.0 ? elementary::expm1(shape.stretch) / length : 0.0;
  choice.row_a = {elementary::cos(shape.row_a), elementary::sin(shape.row_a)};
  choice.row_b = {elementary::cos(shape.row_b), elementary::sin(shape.row_b)};
  return choice;
}

/// From the last frame's shape to the best, by the shortest turns.
struct Way {
  WarpShape from, to;
  [[nodiscard]] WarpChoice at(double t, std::span<const WarpInput::Point> body) const noexcept {
    const auto mix = [&](double a, double b) { return a + (b - a) * t; };
    return choice_at({mix(from.axis, to.axis), mix(from.stretch, to.stretch), mix(from.row_a, to.row_a),
                      mix(from.row_b, to.row_b)},
                     body);
  }
};

Way way_between(const WarpShape& from, const WarpShape& to) noexcept {
  Way way{from, to};
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

/// `borders`: a factor of the texels per area that comes of what is kept free for filters.
Change change_between(const Homography& before, const Homography& now, std::span<const WarpInput::Point> body,
                      double borders) noexcept {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;  // of the weight before over that now
  for (const WarpInput::Point& p : body) {
    const double w = before.weight(p);
    // Where the last frame had nothing, nothing changes.
    if (!(w > 0.0)) continue;
    low = min_of(low, w / now.weight(p));
    high = max_of(high, w / now.weight(p));
  }
  const double area = borders * std::abs(now.determinant() / before.determinant());
  return {elementary::log(area * (low * low * low)), elementary::log(area * (high * high * high))};
}

/// By samples. Out of line: the walk need not make room for them.
[[gnu::noinline]] bool is_near_by_samples(const WarpInput& in, const WarpChoice& last, const WarpChoice& goal,
                                          double near) noexcept {
  const PlaneError error(in);
  return error.value(last) <= error.value(goal) * near;
}

/// The last frame's map, now `last`, is hardly worse than `goal`.
bool is_near_best(const WarpInput& in, const WarpChoice& last, const WarpChoice& goal) noexcept {
  constexpr double kNear = 1.0 + kWorthFollowing;
  if (goal.last_ratio > 0.0 && goal.gain_ratio > 0.0) return goal.last_ratio <= goal.gain_ratio * kNear;
  if (in.objective == Objective::p95 || in.objective == Objective::picture)
    return is_near_by_samples(in, last, goal, kNear);
  // Two maps so much alike are told apart by what vertices need.
  const auto objective = [&](const WarpChoice& choice) {
    TexelsNeeded needed;
    texels_needed(in.body, plane_map(in.body, choice), 1.0, needed);
    const glm::dvec2 sides = needed.sides;
    return in.objective == Objective::storage ? sides.x * sides.y : max_of(sides.x, sides.y);
  };
  return objective(last) <= objective(goal) * kNear;
}

/// A map, and what changes from the last frame to it.
struct Step {
  PlaneMap plane;
  Change change;
};

/// A walk from the last frame's map to the best one.
class SteadyWay {
 public:
  SteadyWay(const PlanContext& c, const MapRequest& request, const WarpQuestion& question) noexcept
      : c_(c),
        request_(request),
        question_(question),
        before_(of_matrix(c, request.space, request.last->gl_from_world)) {}

  [[nodiscard]] const Homography& before() const noexcept { return before_; }
  [[nodiscard]] Change changed(const PlaneMap& plane) const noexcept {
    const int width = request_.slot.width;
    const int border = border_texels(c_.options, width, border_share(c_, request_, question_.points, plane));
    const double used = 1.0 - 2.0 * border / width;
    return change_between(before_, of_plane(plane), question_.in.body, used * used);
  }
  /// Nearly the farthest on the way whose change is still smooth. `begin`: the last frame's map.
  [[nodiscard]] Step farthest_smooth(const Way& way, const PlaneMap& begin) const noexcept {
    Step step = at(way, 1.0);
    double over_far = over(step);
    if (over_far <= 1.0) return step;
    // The camera's own motion changes texels as well.
    const Step stay{begin, changed(begin)};
    const double over_near = over(stay);
    double far = 1.0;
    for (int i = 0; i < kSteps && over_near < 1.0; ++i) {
      far *= kShorter * (1.0 - over_near) / (over_far - over_near);
      step = at(way, far);
      over_far = over(step);
      if (over_far <= 1.0) return step;
    }
    // Staying may change texels more than going some of the way does.
    Step best = stay;
    double share = 0.0, bad = 1.0;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (share + bad);
      step = at(way, middle);
      const bool smooth = over(step) <= 1.0;
      (smooth ? share : bad) = middle;
      if (smooth) best = step;
    }
    return best;
  }

 private:
  [[nodiscard]] Step at(const Way& way, double t) const noexcept {
    const PlaneMap plane = question_.points.under(way.at(t, question_.in.body));
    return {plane, changed(plane)};
  }
  /// Over what is smooth.
  static double over(const Step& step) noexcept {
    return max_of(-step.change.low / kLimit, (step.change.high - step.change.low) / (2.0 * kLimit));
  }

  const PlanContext& c_;
  const MapRequest& request_;
  const WarpQuestion& question_;
  Homography before_;
};

// Frames from one search that begins from nothing to the next, of one map; those of several maps are spread.
constexpr std::int64_t kSearchEvery = 16;
constexpr std::int64_t kSearchApart = 4;
// And to the next round the last frame's result: one frame's motion moves the best warp little.
constexpr std::int64_t kSearchNearEvery = 2;

/// The body fills the map as it did when that was made: what was measured then still holds.
bool is_filled(const CachedPlane& r) noexcept {
  constexpr double kAlike = 0.05;  // of half a side
  const auto off = [](double low, double high, const glm::dvec2& row, double constant) {
    const double length = length_of(row);
    return max_of(std::abs(low * length + constant + 1.0), std::abs(high * length + constant - 1.0));
  };
  const PlaneMap& plane = r.plane;
  return max_of(off(plane.a_min, plane.a_max, r.map.choice.row_a, r.map.const_a),
                off(plane.b_min, plane.b_max, r.map.choice.row_b, r.map.const_b)) <= kAlike;
}

/// The body takes so much more or less of the map than when that was drawn that all its texels jump.
bool is_cut(const CachedPlane& r) noexcept {
  const PlaneMap& plane = r.plane;
  const double a = (plane.a_max - plane.a_min) * length_of(r.map.choice.row_a),
               b = (plane.b_max - plane.b_min) * length_of(r.map.choice.row_b);
  return std::abs(elementary::log(0.25 * a * b)) > kCut;
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

CachedPlane cached_plane(const Homography& h, const WarpQuestion& question,
                         const glm::dvec2& flat_axis) noexcept {
  const WarpInput& in = question.in;
  CachedPlane r{};
  r.map = decompose(h, in.body, flat_axis);
  if (!r.map.valid) return r;
  WarpChoice choice = r.map.choice;
  choice.row_a /= length_of(choice.row_a);
  choice.row_b /= length_of(choice.row_b);
  r.plane = question.points.under(choice);
  r.usable = usable(in.body, question.points.bounds, r.plane, in.most_stretch);
  return r;
}

CachedMap cached_map(const PlanContext& c, const MapRequest& request, const LightBody& body) noexcept {
  CachedMap cached{};
  const glm::dmat4 m = gl_from_light(c, request.space, request.last->gl_from_world);
  const Homography h = homography(m);
  const Decomposed d = decompose(h, body.points(), {0.0, 1.0});
  if (!d.valid) return cached;
  const double fill = 1.0 - 2.0 * request.last->filter_margin_texels / request.last->width;
  PlaneMap& plane = cached.plane;
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
  if (!inside || !(used >= kLeastUse)) return cached;
  // Depth over the weight of the near end is w + 2 (bottom - h) / height.
  const double w_near = plane.w(0.0, 0.0) / h.weight({0.0, 0.0, 0.0, 1.0});
  const double per_height = m[2][2] * w_near, at_origin = m[3][2] * w_near;
  if (!(per_height < 0.0)) return cached;
  cached.depths.height = -2.0 / per_height;
  cached.depths.bottom = 0.5 * cached.depths.height * (at_origin - plane.w(0.0, 0.0));
  cached.holds = true;
  return cached;
}

double smooth_stretch(const PlanContext& c, const WarpQuestion& question, double length) noexcept {
  constexpr double kPerStep = 3.0 / kLimit;
  const LightSpace& space = question.in.light;
  const glm::dvec3 move = space.frame.turned(c.camera.position - c.history->eye_world);
  const glm::dvec3 turn = glm::cross(c.history->forward, c.axes.forward);
  // 1 over the largest kappa.
  const double distance = kPerStep * (std::sqrt(move.x * move.x + move.y * move.y) / question.points.nearest +
                                      0.5 * length * std::sqrt(glm::dot(turn, turn)));
  return distance > 0.0 ? 1.0 + length / distance : std::numeric_limits<double>::infinity();
}

bool has_cached(const MapRequest& request) noexcept {
  return request.last != nullptr && request.last->width == request.slot.width &&
         request.last->height == request.slot.height;
}

PlaneMap steady_plane(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                      const PlaneMap& best, MapResult& result) noexcept {
  const WarpInput& in = question.in;
  const LightBody& points = question.points;
  if (!has_cached(request)) {
    result.report(PlanEventKind::map_appeared, 1.0);
    return best;
  }
  const SteadyWay walk(c, request, question);
  const auto reported = [&](const Step& step) {
    const auto& [low, high] = step.change;
    if (step.change.largest() > elementary::log1p(kDensityStep))
      result.report(PlanEventKind::density_jump, elementary::exp(-low > high ? low : high));
    return step.plane;
  };
  PlaneMap plane;
  // Of a map without fall-off the axis is to be the best map's.
  if (in.start != nullptr && in.start->has_map && in.start->map.kappa > 0.0) {
    plane = points.under(in.start->map);
  } else {
    const CachedPlane from = cached_plane(walk.before(), question, best.choice.axis);
    if (!from.usable) return reported({best, walk.changed(best)});
    plane = from.plane;
  }
  WarpChoice goal = best.choice;
  // A warp that was searched from a start on is within the limit.
  if (in.start == nullptr && weaken(goal, best, smooth_stretch(c, question, best.length)))
    goal.gain_ratio = 0.0;  // is not known
  const bool stays = !in.orthographic && is_near_best(in, plane.choice, goal);
  Step step{plane, {}};
  if (stays) {
    step.change = walk.changed(plane);
  } else {
    const PlaneMap to = goal.kappa == best.choice.kappa ? best : points.under(goal);
    const Decomposed at = decompose(of_plane(to), in.body, plane.choice.axis);
    const Way way = way_between(shape_of(plane.choice, plane.length), shape_of(at.choice, at.length));
    step = walk.farthest_smooth(way, plane);
  }
  Change& change = step.change;
  if (change.largest() > kCut) return reported({best, walk.changed(best)});
  // A larger map may need fewer texels of border for a kernel in world units, and have more inside.
  constexpr int kMaxBorders = 4;
  for (int i = 0; i < kMaxBorders && change.high > kLimit; ++i) {
    const double less = change.high - kLimit;
    // Fewer texels per area, everywhere by the same factor.
    grow(step.plane, 0.5 * (elementary::exp(0.5 * less) - 1.0));
    change.low -= less;
    change.high -= less;
    if (c.options.filter.world > 0.0) change = walk.changed(step.plane);
  }
  return reported(step);
}

bool find_start(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                WarpStart& start) noexcept {
  if (request.last == nullptr) return false;
  // The limit goes up and down as the camera does.
  constexpr double kNearLimit = 1.05;
  // The limit after a step of a seventh of the body's length, or a turn by 17 degrees.
  constexpr double kLeap = 1.1;
  const double limit = smooth_stretch(c, question, question.in.y_max - question.in.y_min);
  start.most_stretch = limit;
  const PlanHistory::SearchedWarp& last = request.last->searched;
  const auto over_body = [&](const glm::dmat4& gl_from_world) {
    return cached_plane(of_matrix(c, request.space, gl_from_world), question, question.in.unwarped.axis);
  };
  const CachedPlane best = c.history->frame < last.until ? over_body(last.xyw_from_world) : CachedPlane{};
  if (best.usable) {
    start.best = best.plane.choice;
    start.best.gain_ratio = last.gain_ratio;
    start.best.last_ratio = last.last_ratio;
    const bool turn = (c.history->frame + request.slot.cascade) % kSearchNearEvery == 0;
    // Searches round the same place would find better ones for ever, and move texels under a still camera.
    const bool moved =
        !c.same_light || c.camera.position != c.history->eye_world || c.axes.forward != c.history->forward;
    const bool holds = last.last_ratio > 0.0 && is_filled(best) && best.plane.stretch <= kNearLimit * limit;
    start.use = turn && moved ? StartUse::search : turn || !holds ? StartUse::measure : StartUse::keep;
  }
  if (start.use != StartUse::keep && has_cached(request)) {
    const CachedPlane drawn = over_body(request.last->gl_from_world);
    start.has_map = drawn.usable;
    start.map = drawn.plane.choice;
    // After a leap there is no way to be smooth on.
    if (limit < kLeap && (!drawn.usable || is_cut(drawn)))
      start.most_stretch = std::numeric_limits<double>::infinity();
  }
  return true;
}

PlanHistory::SearchedWarp searched_warp(const PlanContext& c, const MapRequest& request,
                                        const PlaneMap& plane) noexcept {
  const WarpChoice& choice = plane.choice;
  const std::int64_t sooner =
      request.last != nullptr ? 0 : kSearchApart * request.slot.cascade % kSearchEvery;
  const std::int64_t frame = c.history != nullptr ? c.history->frame : 0;
  return {choice.followed ? request.last->searched.until : frame + kSearchEvery - sooner,
          world_matrix(clip_from_light(plane, {0.0, 1.0}, 0.0) * request.space.light_from_relative(),
                       c.camera.position),
          choice.gain_ratio > 0.0 ? choice.gain_ratio : 1.0, choice.last_ratio};
}

}  // namespace gnomon
