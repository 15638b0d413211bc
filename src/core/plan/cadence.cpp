// Far cascades that are planned every few frames: which maps are cached, and the room that lets them serve.
//
// A camera that moves by a vector t and turns by an angle a about its eye moves a point at the distance d of
// its frustum by at most |t| + 2 sin(a / 2) d. So the receivers within that of the old frustum's slice hold
// all that the new one shows.
#include "plan/cadence.hpp"
#include "gnomon/extend/body.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {
namespace {

// Of positions: a camera that keeps its promise to the last bit must not break it by rounding.
constexpr double kRounding = 1.0 + 1e-9;

/// Distance from the eye to the farthest corner of the frustum at a view depth.
double farthest_corner(const Camera& camera, double depth) noexcept {
  const double x = max_of(std::abs(camera.left), std::abs(camera.right));
  const double y = max_of(std::abs(camera.bottom), std::abs(camera.top));
  const double scale = camera.orthographic ? 1.0 : depth;
  return std::sqrt(depth * depth + scale * scale * (x * x + y * y));
}

/// Farthest that any point of the frustum up to `depth` lies from where it was for the other camera.
double motion_between(const PlanContext& c, const Camera& before, double depth) noexcept {
  const CameraAxes axes = camera_axes(before);
  const double trace = glm::dot(axes.right, c.axes.right) + glm::dot(axes.up, c.axes.up) +
                       glm::dot(axes.forward, c.axes.forward);
  // 2 sin(a / 2) of a turn by a, whose matrix has the trace 1 + 2 cos(a).
  const double chord = std::sqrt(max_of(0.0, 3.0 - trace));
  // A trace rounds to a turn of the root of its rounding.
  constexpr double kTraceRounding = 1e-7;
  const double turn = chord > kTraceRounding ? chord : 0.0;
  return glm::length(c.camera.position - before.position) + turn * farthest_corner(c.camera, depth);
}

bool same_lens(const Camera& a, const Camera& b) noexcept {
  return a.orthographic == b.orthographic && a.left == b.left && a.right == b.right && a.bottom == b.bottom &&
         a.top == b.top && a.near_depth == b.near_depth && a.far_depth == b.far_depth && a.width == b.width &&
         a.height == b.height;
}

}  // namespace

double room_for_motion(const PlanContext& c, double end) noexcept {
  const CadenceOptions& cadence = c.options.cadence;
  const double steps = static_cast<double>(cadence.frames - 1);
  // Half a turn brings a point as far as any turn can.
  constexpr double kPi = 3.141592653589793;
  const double turn = min_of(steps * cadence.largest_turn, kPi);
  const double reach = farthest_corner(c.camera, end);
  return (steps * cadence.largest_step + 2.0 * elementary::sin(0.5 * turn) * reach) * kRounding +
         (kRounding - 1.0) * reach;
}

Polytope receivers_with_room(const PlanContext& c, double begin, double end, double room) noexcept {
  const Polytope slice = frustum_slice(c.camera, c.axes, begin, end);
  Box box = bounds_of(slice);
  box.min -= room;
  box.max += room;
  Polytope body = box_polytope(box);
  for (int f = 0; f < slice.face_count; ++f) {
    Plane plane = slice.plane[static_cast<std::size_t>(f)];
    plane.offset += room;
    clip(body, plane);
  }
  clip(body, visible_bounds(body, c.bounds.receivers, c.camera.position));
  return body;
}

const PlanHistory::KeptMap* cached_cascade(const PlanContext& c, const PlanHistory& history,
                                           const CascadeSlot& slot) noexcept {
  const PlanHistory::KeptMap& cached = history.kept[static_cast<std::size_t>(slot.cascade)];
  const int frames = c.options.cadence.frames;
  const bool due = (history.frame + slot.cascade) % frames == 0;
  if (due || cached.frame < 0 || history.frame - cached.frame >= frames) return nullptr;
  const ShadowMap& map = cached.map;
  const bool same = c.same_light && same_lens(c.camera, cached.camera) && map.depth_begin == slot.begin &&
                    map.depth_end == slot.end;
  const bool serves = same && motion_between(c, cached.camera, slot.end) <= room_for_motion(c, slot.end);
  return serves ? &cached : nullptr;
}

}  // namespace gnomon
