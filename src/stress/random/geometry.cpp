// What a camera sees of boxes and what a shadow ray meets, in long double and with what rounding may change
// left out.
#include "geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/travel.hpp"

namespace gnomon::stress {
namespace {

// Relative to the quantity at hand. A few hundred thousand times a double's rounding, a hundredth of a
// float's: nothing that is drawn tells such points apart.
constexpr Real kClear = 1e-9L;
// Of a position or a distance from one: about a thousand roundings of a double.
constexpr Real kPlaceRounding = 1e-11L;

/// Planes of the frustum as functions that are >= 0 inside.
struct Sides {
  std::array<Real3, 6> normal;
  std::array<Real, 6> offset;
};

Sides sides_of(const View& v, Real begin, Real end) {
  const Camera& c = v.camera;
  const Real slope = c.orthographic ? 0.0L : 1.0L, level = 1.0L - slope;
  return {{v.right - v.forward * (Real(c.left) * slope), v.forward * (Real(c.right) * slope) - v.right,
           v.up - v.forward * (Real(c.bottom) * slope), v.forward * (Real(c.top) * slope) - v.up, v.forward,
           -v.forward},
          {-Real(c.left) * level, Real(c.right) * level, -Real(c.bottom) * level, Real(c.top) * level, -begin,
           end}};
}

std::array<Real3, 8> frustum_corners(const View& v, Real begin, Real end) {
  std::array<Real3, 8> corner;
  for (std::size_t i = 0; i < 8; ++i) {
    const Real depth = (i & 4) ? end : begin, scale = v.camera.orthographic ? 1.0L : depth;
    corner[i] = v.right * (Real((i & 1) ? v.camera.right : v.camera.left) * scale) +
                v.up * (Real((i & 2) ? v.camera.top : v.camera.bottom) * scale) + v.forward * depth;
  }
  return corner;
}

struct RealBox {
  Real3 min, max;
};

/// The box relative to the camera, cut to what is round the frustum, so that huge boxes keep its precision.
RealBox box_near(const View& v, const Box& box, const std::array<Real3, 8>& corner) {
  RealBox out{Real3(box.min) - v.eye, Real3(box.max) - v.eye};
  for (int axis = 0; axis < 3; ++axis) {
    Real low = kNoBound, high = -kNoBound;
    for (const Real3& c : corner) {
      low = std::min(low, c[axis]);
      high = std::max(high, c[axis]);
    }
    const Real room = 1e-3L * (std::abs(low) + std::abs(high));
    out.min[axis] = std::max(out.min[axis], low - room);
    out.max[axis] = std::min(out.max[axis], high + room);
  }
  return out;
}

void add_box_edges(const RealBox& box, const Sides& sides, std::vector<Real3>& points) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 4; ++k) {
      Real3 p = box.min;
      if (k & 1) p[(axis + 1) % 3] = box.max[(axis + 1) % 3];
      if (k & 2) p[(axis + 2) % 3] = box.max[(axis + 2) % 3];
      p[axis] = 0.0L;
      Interval t{box.min[axis], box.max[axis]};
      for (std::size_t s = 0; s < 6; ++s)
        t.keep(sides.normal[s][axis], glm::dot(sides.normal[s], p) + sides.offset[s]);
      if (t.empty()) continue;
      for (const Real end : {t.low, t.high}) {
        p[axis] = end;
        points.push_back(p);
      }
    }
  }
}

void add_frustum_edges(const RealBox& box, const std::array<Real3, 8>& corner, std::vector<Real3>& points) {
  for (std::size_t bit = 1; bit <= 4; bit *= 2) {
    for (std::size_t i = 0; i < 8; ++i) {
      if (i & bit) continue;
      const Real3 a = corner[i], step = corner[i | bit] - a;
      Interval t{0.0L, 1.0L};
      for (int axis = 0; axis < 3; ++axis) {
        t.keep(step[axis], a[axis] - box.min[axis]);
        t.keep(-step[axis], box.max[axis] - a[axis]);
      }
      if (t.empty()) continue;
      points.push_back(a + step * t.low);
      points.push_back(a + step * t.high);
    }
  }
}

/// Within this arithmetic's own rounding.
bool inside(const View& v, const RealBox& box, const Sides& sides, const Real3& p) {
  constexpr Real kOwn = 1e-15L;
  const Real slack = kOwn * largest(p);
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < box.min[axis] - slack || p[axis] > box.max[axis] + slack) return false;
  }
  for (std::size_t s = 0; s < 6; ++s) {
    const Real size = length(sides.normal[s]) * length(p) + std::abs(sides.offset[s]);
    if (glm::dot(sides.normal[s], p) + sides.offset[s] < -kOwn * size) return false;
  }
  return v.camera.orthographic || v.depth(p) > 0.0L;
}

}  // namespace

View::View(const Camera& c) : camera(c), eye(c.position) {
  const CameraAxes axes = camera_axes(c);
  right = Real3(axes.right);
  up = Real3(axes.up);
  forward = Real3(axes.forward);
}

Real View::depth(const Real3& p) const {
  return glm::dot(forward, p);
}

bool View::clearly_sees(const Real3& p) const {
  const Real z = depth(p);
  // Of positions: what a double keeps of a point of the world.
  const Real rounding = kPlaceRounding * (length(p) + length(eye));
  const Real margin = kClear * std::abs(z) + rounding;
  if (!(z > camera.near_depth + margin && z < camera.far_depth - margin)) return false;
  const Real scale = camera.orthographic ? 1.0L : z;
  const Real wide = Real(camera.right) - camera.left, high = Real(camera.top) - camera.bottom;
  const Real x = glm::dot(right, p), y = glm::dot(up, p);
  return x > camera.left * scale + kClear * wide * scale + rounding &&
         x < camera.right * scale - kClear * wide * scale - rounding &&
         y > camera.bottom * scale + kClear * high * scale + rounding &&
         y < camera.top * scale - kClear * high * scale - rounding;
}

std::vector<Real3> seen_corners(const View& view, const Box& box, Real begin, Real end) {
  std::vector<Real3> points;
  if (box.empty() || !(begin <= end)) return points;
  const Sides sides = sides_of(view, begin, end);
  const std::array<Real3, 8> corner = frustum_corners(view, begin, end);
  const RealBox near = box_near(view, box, corner);
  for (int axis = 0; axis < 3; ++axis) {
    if (near.min[axis] > near.max[axis]) return points;
  }
  add_box_edges(near, sides, points);
  add_frustum_edges(near, corner, points);
  std::erase_if(points, [&](const Real3& p) { return !inside(view, near, sides, p); });
  return points;
}

std::vector<Real3> seen_points(const View& view, const Box& box, Real begin, Real end, int between,
                               Random& random) {
  std::vector<Real3> points = seen_corners(view, box, begin, end);
  const auto corners = static_cast<int>(points.size());
  for (int i = 0; i < between && corners > 0; ++i) {
    Real3 p(0.0L);
    Real sum = 0.0L;
    for (int k = 0; k < 4; ++k) {
      // Weights over twelve decades: else all points were as far away as the farthest corner.
      const Real weight = std::ldexp(1.0L + random.unit(), -random.pick(40));
      p += points[static_cast<std::size_t>(random.pick(corners))] * weight;
      sum += weight;
    }
    points.push_back(p / sum);
  }
  return points;
}

LightAt::LightAt(const Light& light, const View& view) {
  if (const auto* sun = std::get_if<DirectionalLight>(&light)) {
    const Real3 d(sun->direction);
    const Real3 scaled = d / largest(d);  // directions of 1e-300 have no square
    to_light_ = -scaled / length(scaled);
    return;
  }
  parallel_ = false;
  const auto* spot = std::get_if<SpotLight>(&light);
  range_ = spot != nullptr ? spot->range : std::get<PointLight>(light).range;
  apex_ = Real3(position_of(light)) - view.eye;
  world_ = length(Real3(position_of(light))) + length(view.eye);
  if (spot == nullptr) return;
  cone_ = true;
  const Real3 d(spot->direction);
  const Real3 scaled = d / largest(d);
  axis_ = scaled / length(scaled);
  outer_ = spot->outer_radians;
}

bool LightAt::clearly_lights(const Real3& p) const {
  if (parallel_) return true;
  const Real3 q = p - apex_;
  const Real r = length(q);
  // A point this close to the light is the light, as far as doubles can tell.
  if (!(r > kClear * (length(p) + length(apex_)) + kPlaceRounding * world_)) return false;
  if (!(r < range_ * (1.0L - kClear))) return false;
  if (!cone_) return true;
  const Real angle = std::atan2(length(glm::cross(q, axis_)), glm::dot(q, axis_));
  constexpr Real kAngle = 1e-6L, kLeastAngle = 1e-12L;
  return angle < outer_ * (1.0L - kAngle) - kLeastAngle;
}

Real3 LightAt::travel(const Real3& p) const {
  if (parallel_) return -to_light_;
  const Real3 q = p - apex_;
  return q / length(q);
}

Real LightAt::end() const noexcept {
  constexpr Real kAtTheLight = 1e-3L;
  return parallel_ ? kNoBound : 1.0L - kAtTheLight;
}

RayHit clear_hit(const View& view, const Box& box, const Real3& p, const Real3& way, Real end) {
  if (box.empty()) return {};
  const Real3 low = Real3(box.min) - view.eye - p, high = Real3(box.max) - view.eye - p;
  Interval rough{0.0L, end};
  for (int axis = 0; axis < 3; ++axis) {
    rough.keep(way[axis], -low[axis]);
    rough.keep(-way[axis], high[axis]);
  }
  if (rough.empty()) return {};
  // What rounds: the point, where the box is met, and both as places in the world.
  const Real room = kPlaceRounding * (length(p) + length(p + way * rough.low) + length(view.eye));
  Interval thick{0.0L, end}, flat;
  int flats = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Interval here;
    if (high[axis] - low[axis] > 4.0L * room) {
      thick.keep(way[axis], -low[axis] - room);
      thick.keep(-way[axis], high[axis] - room);
      continue;
    }
    // A plate: wherever rounding moves the place that it is met at, the other sides must hold it.
    ++flats;
    here.keep(way[axis], -low[axis] + room);
    here.keep(-way[axis], high[axis] + room);
    flat = here;
  }
  const Real speed = length(way);
  if (flats > 1 || !(thick.high * speed > 4.0L * room) || thick.empty()) return {};
  if (flats == 0) return {true, thick.low, thick.high};
  const bool met = !flat.empty() && flat.low > thick.low && flat.high < thick.high && flat.low * speed > room;
  if (!met) return {};
  const Real at = 0.5L * (flat.low + flat.high);
  return {true, at, at};
}

ThinHit thin_hit(const std::vector<Box>& receivers, const View& view, const Real3& start, const Real3& way,
                 const std::vector<Real>& depths, const Interval& range) {
  Real nearest = kNoBound, nearest_doubt = kNoBound;
  for (const Box& box : receivers) {
    const Real3 low = Real3(box.min) - view.eye - start, high = Real3(box.max) - view.eye - start;
    const Real room = kPlaceRounding * (length(low) + length(high) + length(view.eye));
    // Of the box less what may round, and more.
    Interval inner = range, outer = range;
    for (int axis = 0; axis < 3; ++axis) {
      inner.keep(way[axis], -low[axis] - room);
      inner.keep(-way[axis], high[axis] - room);
      outer.keep(way[axis], -low[axis] + room);
      outer.keep(-way[axis], high[axis] + room);
    }
    const auto holds_any = [&](const Interval& part) {
      return std::any_of(depths.begin(), depths.end(),
                         [&](Real d) { return d >= part.low && d <= part.high; });
    };
    if (outer.empty() || (!inner.empty() && holds_any(inner))) continue;
    const bool sure = !inner.empty() && !holds_any(outer) && inner.low - outer.low < kClear * inner.low;
    Real& least = sure ? nearest : nearest_doubt;
    least = std::min(least, outer.low);
  }
  return {nearest < kNoBound, nearest_doubt < kNoBound && nearest_doubt <= nearest, nearest};
}

}  // namespace gnomon::stress
