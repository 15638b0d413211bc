// How far a map may go, in one frame, from where the last frame's was towards where it is best.
//
// Two projective maps of the light plane with weights w0 and w1 have texel densities whose ratio is a
// constant times (w0 / w1)^3: a linear-fractional function to the third power, extreme at the body's
// vertices. So the change at every surface point is bounded exactly by a look at the vertices.
#include "map/history.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "map/border.hpp"
#include "map/recalled.hpp"
#include "map/record.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {
namespace {

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

}  // namespace

double smooth_stretch(const PlanContext& c, const WarpQuestion& question, double length) noexcept {
  constexpr double kPerStep = 3.0 / kLimit;
  const LightSpace& space = question.in.light;
  const glm::dvec3 move = space.frame.turned(c.camera.position - c.last_eye);
  const glm::dvec3 turn = glm::cross(c.last_forward, c.axes.forward);
  // 1 over the largest kappa.
  const double distance = kPerStep * (std::sqrt(move.x * move.x + move.y * move.y) / question.points.nearest +
                                      0.5 * length * std::sqrt(glm::dot(turn, turn)));
  return distance > 0.0 ? 1.0 + length / distance : std::numeric_limits<double>::infinity();
}

bool remembered(const MapRequest& request) noexcept {
  return request.last != nullptr && request.last->width == request.slot.width &&
         request.last->height == request.slot.height;
}

namespace {

/// The last frame's map, now `last`, is hardly worse than `goal`.
bool is_near_best(const WarpInput& in, const WarpChoice& last, const WarpChoice& goal) noexcept {
  constexpr double kNear = 1.0 + kWorthFollowing;
  if (goal.last_ratio > 0.0 && goal.gain_ratio > 0.0) return goal.last_ratio <= goal.gain_ratio * kNear;
  if (in.objective == Objective::p95) {
    PlaneError error(in);
    return error.value(last) <= error.value(goal) * kNear;
  }
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

}  // namespace

PlaneMap steady_plane(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                      const PlaneMap& best, MapResult& result) noexcept {
  const WarpInput& in = question.in;
  const LightBody& points = question.points;
  if (!remembered(request)) {
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
    const Recalled from = recall(walk.before(), question, best.choice.axis);
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
  if (change.high > kLimit) {
    const double less = change.high - kLimit;
    // Fewer texels per area, everywhere by the same factor.
    grow(step.plane, 0.5 * (elementary::exp(0.5 * less) - 1.0));
    change.low -= less;
    change.high -= less;
  }
  return reported(step);
}

}  // namespace gnomon
