// What do the rays of a fan through the image meet, as far as boxes tell: the nearest, and all on their way?
// Based on: Kay, Kajiya, "Ray Tracing Complex Scenes", 1986 (slabs). Taking their hits as points that a map's
// error is counted at is this project's.
#include "geometry/first_hits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/body.hpp"
#include "geometry/box_walk.hpp"
#include "geometry/even_points.hpp"
#include "geometry/vector.hpp"
#include "lanes/wide.hpp"

namespace gnomon {
namespace {

// Rays of the fan: as many points as a percentile takes.
constexpr std::size_t kRays = HeldDepths::kRays;
static_assert(kRays <= SeenPoints::kMost);

/// The fan's rays from left to right.
struct Fan {
  std::array<std::uint8_t, kRays> number{};  // in the order that they spread evenly in
  std::size_t uneven = 0;                    // most places that a ray is from where even steps would have it
  constexpr Fan() {
    for (std::size_t i = 0; i < kRays; ++i) {
      std::size_t at = i;
      for (; at > 0 && even_x(number[at - 1]) > even_x(i); --at) number[at] = number[at - 1];
      number[at] = static_cast<std::uint8_t>(i);
    }
    for (std::size_t i = 0; i < kRays; ++i) {
      const auto even = static_cast<std::size_t>(even_x(number[i]) * static_cast<double>(kRays));
      uneven = std::max(uneven, even > i ? even - i : i - even);
    }
  }
};
constexpr Fan kFan;

/// Where an image shows a box at most: 0 to 1 along both sides, and between these view depths.
struct Shown {
  double left, right, bottom, top, nearest, farthest;
};

/// What a ray meets: view depths.
struct Through {
  double begin, end;
};

/// The fan's rays through a camera's image: from the eye, or side by side.
struct Rays {
  using Numbers = std::array<double, kRays>;
  alignas(64) Numbers y;  // in the image, 0 to 1
  alignas(64) std::array<Numbers, 3> direction, origin;
  alignas(64) std::array<Numbers, 3> inverse;  // of the direction; 0: across the axis
  [[nodiscard]] glm::dvec3 at(std::size_t ray, double depth) const noexcept {
    return {origin[0][ray] + direction[0][ray] * depth, origin[1][ray] + direction[1][ray] * depth,
            origin[2][ray] + direction[2][ray] * depth};
  }
};

GNOMON_WIDE void find_rays(const Camera& camera, const CameraAxes& axes, Rays& rays) noexcept {
  Rays& __restrict r = rays;
  const double left = camera.left, width = camera.right - left;
  const double bottom = camera.bottom, height = camera.top - bottom;
  const bool parallel = camera.orthographic;
  Rays::Numbers x;
  for (std::size_t i = 0; i < kRays; ++i) {
    x[i] = left + width * even_x(kFan.number[i]);
    r.y[i] = even_y(kFan.number[i]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double right = axes.right[axis], up = axes.up[axis], forward = axes.forward[axis];
    const auto k = static_cast<std::size_t>(axis);
    for (std::size_t i = 0; i < kRays; ++i) {
      const double aside = right * x[i] + up * (bottom + height * r.y[i]);
      const double fanned = forward + aside, direction = parallel ? forward : fanned;
      r.direction[k][i] = direction;
      r.origin[k][i] = parallel ? aside : 0.0;
      r.inverse[k][i] = inverse_or_0(direction);
    }
  }
}

/// Where the ray is between the box's sides; end < begin: nowhere.
[[gnu::always_inline]] inline Through passed(const Box& box, const Rays& rays, std::size_t ray) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto between = [&](double low, double high, double inverse) {
    const double a = low * inverse, b = high * inverse;
    // Across the axis: between both sides all the way, or never.
    const double never = low > 0.0 ? kInfinity : high < 0.0 ? kInfinity : -kInfinity;
    return inverse == 0.0 ? Through{never, -never} : Through{min_of(a, b), max_of(a, b)};
  };
  const auto along = [&](int axis) {
    const auto k = static_cast<std::size_t>(axis);
    const double origin = rays.origin[k][ray];
    return between(box.min[axis] - origin, box.max[axis] - origin, rays.inverse[k][ray]);
  };
  const Through x = along(0), y = along(1), z = along(2);
  return {max_of(max_of(x.begin, y.begin), z.begin), min_of(min_of(x.end, y.end), z.end)};
}

/// The same of many rays.
struct Passed {
  alignas(64) Rays::Numbers begin, end;
};
GNOMON_WIDE void find_passed(const Box& box, const Rays& rays, std::size_t first, std::size_t beyond,
                             Passed& result) noexcept {
  Passed& __restrict p = result;
  const Box copy = box;
  for (std::size_t ray = first; ray < beyond; ++ray) {
    const Through through = passed(copy, rays, ray);
    p.begin[ray] = through.begin;
    p.end[ray] = through.end;
  }
}

/// The nearest boxes on every ray of the fan, or where all boxes are.
class BoxesOnRays {
 public:
  static constexpr bool kCuts = false;
  static constexpr std::size_t kMost = 6;

  /// `list`: the boxes are asked one by one anyway, after planes; a tree asks first where not to look.
  /// `held`: takes the depths of all boxes; nullptr: the nearest boxes are kept.
  BoxesOnRays(const Camera& camera, const CameraAxes& axes, bool list, HeldDepths* held) noexcept
      : camera_(camera), axes_(axes), list_(list), held_(held) {
    find_rays(camera, axes, rays_);
  }

  [[nodiscard]] std::uint32_t wanted(const CasterBlock& block) const noexcept {
    if (list_) return block.occupied;  // planes are quicker, one box after the other
    std::uint32_t lanes = 0;
    for_each_bit(block.occupied, [&](std::size_t lane) {
      Shown box;
      if (!shown(lane_box(block, lane), box) || box.nearest >= to_ || box.farthest < from_) return;
      const RayRange rays = rays_in(box);
      for (std::size_t ray = rays.first; ray < rays.beyond && (lanes >> lane & 1u) == 0; ++ray)
        lanes |= static_cast<std::uint32_t>(may_keep(ray, box)) << lane;
    });
    return lanes;
  }
  [[nodiscard]] std::uint32_t inside(const CasterBlock& block, std::uint32_t lanes, bool leaf) noexcept {
    if (!leaf) return lanes;
    for_each_bit(lanes, [&](std::size_t lane) {
      const Box box = lane_box(block, lane);
      Shown where;
      if (shown(box, where) && where.nearest >= from_ && where.nearest < to_) add(box, where);
    });
    return 0;
  }

  void look(const Boxes& boxes) noexcept {
    const std::array<Plane, 6> sides = frustum_planes(camera_, axes_, camera_.near_depth, camera_.far_depth);
    BoxWalk walk(sides, boxes, camera_.position, *this);
    constexpr std::size_t kMany = 1 << 14;
    if (boxes.set() == nullptr || boxes.size() < kMany) return walk.whole();
    // A tree has no order by depth: what is near first, so that little is looked at behind it.
    for (const double share : {1.0 / 64.0, 1.0 / 16.0, 1.0 / 4.0, 1.0}) {
      to_ = share < 1.0 ? camera_.near_depth + (camera_.far_depth - camera_.near_depth) * share
                        : std::numeric_limits<double>::infinity();
      walk.whole();
      from_ = to_;
    }
  }

  /// A point on each ray that meets a box, between the box's sides.
  void points(SeenPoints& seen) const noexcept {
    // In the order that spreads evenly: who takes a part of the points takes even ones.
    std::array<std::size_t, kRays> place;
    for (std::size_t i = 0; i < kRays; ++i) place[kFan.number[i]] = i;
    for (std::size_t number = 0; number < kRays; ++number) {
      const std::size_t ray = place[number];
      if (count_[ray] == 0) continue;
      // Boxes are rarely all surface: rays end evenly in those that they meet.
      const std::size_t taken = std::min(number % kMost, count_[ray] - 1);
      const Through& box = box_[ray][taken];
      // A surface lies somewhere inside of its box: points on the boxes' sides were as often worse as better.
      // But round the eye it leaves room. Where points of a room came near, it had three times the least
      // error.
      const double nearest = max_of(box.begin, 0.5 * box.end);
      const double share = spread(0.3819660112501051, static_cast<double>(number));
      seen.point[seen.count++] = rays_.at(ray, nearest + share * (box.end - nearest));
    }
  }

 private:
  /// False where the box is not in the image.
  [[nodiscard]] bool shown(const Box& box, Shown& part) const noexcept {
    const glm::dvec3 centre = (box.min + box.max) * 0.5, half = (box.max - box.min) * 0.5;
    const auto along = [&](const glm::dvec3& axis) {
      const double middle = glm::dot(axis, centre), reach = glm::dot(glm::abs(axis), half);
      return Through{middle - reach, middle + reach};
    };
    const Through depth = along(axes_.forward);
    if (!(depth.end > camera_.near_depth && depth.begin < camera_.far_depth)) return false;
    const Through x = along(axes_.right), y = along(axes_.up);
    // Seen smallest where it is farthest, largest where it is nearest.
    const double nearest = camera_.orthographic ? 1.0 : max_of(depth.begin, camera_.near_depth);
    const double farthest = camera_.orthographic ? 1.0 : max_of(depth.end, nearest);
    const double per_near = 1.0 / nearest, per_far = 1.0 / farthest;
    const double per_width = 1.0 / (camera_.right - camera_.left),
                 per_height = 1.0 / (camera_.top - camera_.bottom);
    const auto least = [&](double v) { return v * (v < 0.0 ? per_near : per_far); };
    const auto most = [&](double v) { return v * (v < 0.0 ? per_far : per_near); };
    part = {(least(x.begin) - camera_.left) * per_width,
            (most(x.end) - camera_.left) * per_width,
            (least(y.begin) - camera_.bottom) * per_height,
            (most(y.end) - camera_.bottom) * per_height,
            depth.begin,
            depth.end};
    return part.left < 1.0 && part.right > 0.0 && part.bottom < 1.0 && part.top > 0.0;
  }

  struct RayRange {
    std::size_t first, beyond;
  };
  /// The rays that may pass through a part of the image, as far as left and right tell.
  [[nodiscard]] static RayRange rays_in(const Shown& part) noexcept {
    constexpr auto kCount = static_cast<double>(kRays), kUneven = static_cast<double>(kFan.uneven + 1);
    // Compilers convert before they choose, and what no integer holds is an exception: these are never too
    // large.
    const int first = static_cast<int>(max_of(part.left, 0.0) * kCount - kUneven),
              beyond = static_cast<int>(min_of(part.right, 1.0) * kCount + kUneven);
    return {static_cast<std::size_t>(std::max(first, 0)), std::min(static_cast<std::size_t>(beyond), kRays)};
  }
  /// Whether the ray may meet a box that is shown there before those that it has.
  [[nodiscard]] bool may_keep(std::size_t ray, const Shown& part) const noexcept {
    if (!(rays_.y[ray] >= part.bottom && rays_.y[ray] <= part.top)) return false;
    if (held_ == nullptr) return count_[ray] < kMost || part.nearest <= box_[ray][kMost - 1].begin;
    // Not where all that it can hold is held.
    const std::size_t number = kFan.number[ray];
    HeldDepths::Range range = held_->between(number, max_of(part.nearest, camera_.near_depth), part.farthest);
    range = {std::max(range.first - 1, 0), std::max(range.last, 0)};
    return (range.bits() & ~held_->cells[number]) != 0;
  }

  void add(const Box& box, const Shown& part) noexcept {
    const RayRange rays = rays_in(part);
    // Of small boxes few rays are worked out at all.
    constexpr std::size_t kMany = 24;
    const bool many = rays.first + kMany < rays.beyond;
    if (many) find_passed(box, rays_, rays.first, rays.beyond, passed_);
    for (std::size_t ray = rays.first; ray < rays.beyond; ++ray) {
      if (!may_keep(ray, part)) continue;
      const Through through = many ? Through{passed_.begin[ray], passed_.end[ray]} : passed(box, rays_, ray);
      if (!(through.begin <= through.end && through.end > camera_.near_depth &&
            through.begin < camera_.far_depth))
        continue;
      // Of a box that the ray begins in, what is in view.
      const Through in_view{max_of(through.begin, camera_.near_depth),
                            min_of(through.end, camera_.far_depth)};
      if (held_ == nullptr) {
        keep(ray, in_view);
      } else {
        hold(ray, in_view);
      }
    }
  }
  void hold(std::size_t ray, const Through& through) noexcept {
    const std::size_t number = kFan.number[ray];
    HeldDepths::Range range = held_->between(number, through.begin, through.end);
    // A thin box between two depths holds the nearer one.
    if (range.first > range.last) range.first = range.last = std::max(range.last, 0);
    held_->cells[number] |= range.bits();
  }
  /// The nearest few, the same ones in any order of the boxes.
  void keep(std::size_t ray, const Through& through) noexcept {
    const auto before = [](const Through& a, const Through& b) {
      return a.begin < b.begin || (a.begin == b.begin && a.end < b.end);
    };
    auto& boxes = box_[ray];
    std::size_t at = count_[ray];
    if (at == kMost) {
      if (!before(through, boxes[kMost - 1])) return;
      --at;
    } else {
      ++count_[ray];
    }
    for (; at > 0 && before(through, boxes[at - 1]); --at) boxes[at] = boxes[at - 1];
    boxes[at] = through;
  }

  const Camera& camera_;
  const CameraAxes& axes_;
  bool list_;
  HeldDepths* held_;
  double from_ = -std::numeric_limits<double>::infinity(), to_ = std::numeric_limits<double>::infinity();
  Rays rays_;
  Passed passed_;  // by the last large box
  std::array<std::size_t, kRays> count_{};
  std::array<std::array<Through, kMost>, kRays> box_;
};

/// Points side by side, and the least distance of each from the inside of a body's faces.
struct PointLanes {
  alignas(64) std::array<double, SeenPoints::kMost> x, y, z, inside;
};
GNOMON_WIDE void find_inside(const Polytope& body, std::size_t count, PointLanes& points) noexcept {
  PointLanes& __restrict p = points;
  for (std::size_t i = 0; i < count; ++i) p.inside[i] = std::numeric_limits<double>::infinity();
  for (int f = 0; f < body.face_count; ++f) {
    const Plane plane = body.plane[static_cast<std::size_t>(f)];
    const double x = plane.normal.x, y = plane.normal.y, z = plane.normal.z, offset = plane.offset;
    for (std::size_t i = 0; i < count; ++i)
      p.inside[i] = min_of(p.inside[i], x * p.x[i] + y * p.y[i] + z * p.z[i] + offset);
  }
}

}  // namespace

std::size_t points_inside(const Polytope& body, std::span<const glm::dvec3> points, double touching,
                          std::array<glm::dvec3, SeenPoints::kMost>& inside) noexcept {
  PointLanes lanes;
  points = points.first(std::min(points.size(), inside.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    lanes.x[i] = points[i].x;
    lanes.y[i] = points[i].y;
    lanes.z[i] = points[i].z;
  }
  find_inside(body, points.size(), lanes);
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (lanes.inside[i] >= -touching * largest_component(points[i])) inside[count++] = points[i];
  }
  return count;
}

SeenPoints first_hits(const Camera& camera, const CameraAxes& axes, const Boxes& boxes) noexcept {
  BoxesOnRays nearest(camera, axes, boxes.set() == nullptr, nullptr);
  nearest.look(boxes);
  SeenPoints seen;
  nearest.points(seen);
  return seen;
}

HeldDepths::Range HeldDepths::between(std::size_t ray, double begin, double end) const noexcept {
  const double into = into_cell(ray);
  const auto place = [&](double depth) {
    return clamp_to((log2_of(depth) - first) * per_step - into, -1.0, static_cast<double>(kCells));
  };
  const int from = static_cast<int>(std::ceil(place(begin))), to = static_cast<int>(std::floor(place(end)));
  return {std::max(from, 0), std::min(to, kCells - 1)};
}

HeldDepths held_depths(const Camera& camera, const CameraAxes& axes, const Boxes& boxes,
                       double nearest) noexcept {
  HeldDepths held(max_of(nearest, camera.near_depth), camera.far_depth);
  BoxesOnRays on_rays(camera, axes, boxes.set() == nullptr, &held);
  on_rays.look(boxes);
  return held;
}

namespace {

/// Of a normal that is turned from the eye nothing is known.
bool may_be_lit(const View& view, const CameraAxes& axes, const glm::dvec4& light_world,
                std::size_t i) noexcept {
  if (view.normals_world.empty()) return true;
  const glm::dvec3 &point = view.points_world[i], &normal = view.normals_world[i];
  const glm::dvec3 to_light = glm::dvec3(light_world) - light_world.w * point;
  const glm::dvec3 to_eye = view.camera.orthographic ? -axes.forward : view.camera.position - point;
  return glm::dot(normal, to_light) > 0.0 || !(glm::dot(normal, to_eye) > 0.0);
}

}  // namespace

SeenPoints some_of(const View& view, const CameraAxes& axes, const glm::dvec4& light_world) noexcept {
  const std::span<const glm::dvec3> points = view.points_world;
  std::size_t lit = 0;
  for (std::size_t i = 0; i < points.size(); ++i) lit += may_be_lit(view, axes, light_world, i) ? 1 : 0;
  const std::size_t stride = lit > 0 ? 1 + (lit - 1) / SeenPoints::kMost : 1;
  SeenPoints seen;
  // The middle of each stride, over those that count.
  std::size_t place = stride - 1 - stride / 2;
  for (std::size_t i = 0; i < points.size() && seen.count < SeenPoints::kMost; ++i) {
    if (!may_be_lit(view, axes, light_world, i) || ++place < stride) continue;
    place = 0;
    const glm::dvec3 p = points[i] - view.camera.position;
    const double depth = glm::dot(axes.forward, p);
    if (depth >= view.camera.near_depth && depth <= view.camera.far_depth) seen.point[seen.count++] = p;
  }
  return seen;
}

}  // namespace gnomon
