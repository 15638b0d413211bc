// Where does a search begin that goes on from the last frame?
#include "map/search_start.hpp"

#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "map/history.hpp"
#include "map/recalled.hpp"
#include "map/record.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {
namespace {

// Frames from one search that begins from nothing to the next, of one map; those of several maps are spread.
constexpr std::int64_t kSearchEvery = 16;
constexpr std::int64_t kSearchApart = 4;
// And to the next round the last frame's result: one frame's motion moves the best warp little.
constexpr std::int64_t kSearchNearEvery = 2;

/// The body fills the map as it did when that was made: what was measured then still holds.
bool is_filled(const Recalled& r) noexcept {
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
bool is_cut(const Recalled& r) noexcept {
  const PlaneMap& plane = r.plane;
  const double a = (plane.a_max - plane.a_min) * length_of(r.map.choice.row_a),
               b = (plane.b_max - plane.b_min) * length_of(r.map.choice.row_b);
  return std::abs(elementary::log(0.25 * a * b)) > kCut;
}

}  // namespace

bool find_start(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                WarpStart& start) noexcept {
  if (request.last == nullptr) return false;
  // The limit goes up and down as the camera does.
  constexpr double kNearLimit = 1.05;
  // The limit after a step of a seventh of the body's length, or a turn by 17 degrees.
  constexpr double kLeap = 1.1;
  const double limit = smooth_stretch(c, question, question.in.y_max - question.in.y_min);
  start.most_stretch = limit;
  const SearchedWarp& last = request.last->searched;
  const auto over_body = [&](const glm::dmat4& gl_from_world) {
    return recall(of_matrix(c, request.space, gl_from_world), question, question.in.unwarped.axis);
  };
  const Recalled best = c.frame < last.until ? over_body(last.xyw_from_world) : Recalled{};
  if (best.usable) {
    start.best = best.plane.choice;
    start.best.gain_ratio = last.gain_ratio;
    start.best.last_ratio = last.last_ratio;
    const bool turn = (c.frame + request.slot.cascade) % kSearchNearEvery == 0;
    // Searches round the same place would find better ones for ever, and move texels under a still camera.
    const bool moved = !c.same_light || c.camera.position != c.last_eye || c.axes.forward != c.last_forward;
    const bool holds = last.last_ratio > 0.0 && is_filled(best) && best.plane.stretch <= kNearLimit * limit;
    start.use = turn && moved ? StartUse::search : turn || !holds ? StartUse::measure : StartUse::keep;
  }
  if (start.use != StartUse::keep && remembered(request)) {
    const Recalled drawn = over_body(request.last->gl_from_world);
    start.has_map = drawn.usable;
    start.map = drawn.plane.choice;
    // After a leap there is no way to be smooth on.
    if (limit < kLeap && (!drawn.usable || is_cut(drawn)))
      start.most_stretch = std::numeric_limits<double>::infinity();
  }
  return true;
}

SearchedWarp searched_warp(const PlanContext& c, const MapRequest& request, const PlaneMap& plane) noexcept {
  const WarpChoice& choice = plane.choice;
  const std::int64_t sooner =
      request.last != nullptr ? 0 : kSearchApart * request.slot.cascade % kSearchEvery;
  return {choice.followed ? request.last->searched.until : c.frame + kSearchEvery - sooner,
          world_matrix(clip_from_light(plane, {0.0, 1.0}, 0.0) * request.space.light_from_relative(),
                       c.camera.position),
          choice.gain_ratio > 0.0 ? choice.gain_ratio : 1.0, choice.last_ratio};
}

}  // namespace gnomon
