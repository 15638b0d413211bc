// Where do surfaces lie that the camera sees, as far as boxes tell?
// Based on: Kay, Kajiya, "Ray Tracing Complex Scenes", 1986 (slabs). Taking their hits as points that a map's
// error is counted at is this project's.
#include "geometry/first_hits.hpp"

#include <glm/geometric.hpp>
#include <limits>

#include "geometry/box_walk.hpp"
#include "geometry/even_points.hpp"
#include "geometry/vector.hpp"

namespace gnomon {
namespace {

// Rays of the fan: as many points as a percentile takes.
constexpr std::size_t kRays = 112;

/// A ray, with t as its view depth: direction's part along the view is 1.
struct DepthRay {
  glm::dvec3 origin, inverse;  // of the direction, component by component; 0: across the axis
  double least, most;          // view depths
};

/// Looks for the nearest box on a ray.
class HitQuery {
 public:
  static constexpr bool kCuts = false;
  explicit HitQuery(const DepthRay& ray) noexcept : ray_(ray), nearest_(ray.most) {}
  [[nodiscard]] std::uint32_t wanted(const CasterBlock& block) const noexcept {
    std::uint32_t lanes = 0;
    for_each_bit(block.occupied, [&](std::size_t lane) {
      const Through through = passed(lane_box(block, lane));
      if (through.begin <= through.end && through.end > ray_.least && through.begin < nearest_)
        lanes |= 1u << lane;
    });
    return lanes;
  }
  [[nodiscard]] std::uint32_t inside(const CasterBlock& block, std::uint32_t lanes, bool leaf) noexcept {
    if (!leaf) return lanes;
    for_each_bit(lanes, [&](std::size_t lane) {
      const Through through = passed(lane_box(block, lane));
      if (!(through.begin <= through.end)) return;
      const double at = through.begin > ray_.least ? through.begin : through.end;
      if (at > ray_.least && at < nearest_) {
        nearest_ = at;
        end_ = through.end;
      }
    });
    return 0;
  }
  /// View depth where a box is met; that of the far plane where none is.
  [[nodiscard]] double nearest() const noexcept { return nearest_; }
  /// View depth where the ray leaves that box.
  [[nodiscard]] double end() const noexcept { return end_; }

 private:
  struct Through {
    double begin, end;
  };
  [[nodiscard]] Through passed(const Box& box) const noexcept {
    Through through{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
      const double low = box.min[axis] - ray_.origin[axis], high = box.max[axis] - ray_.origin[axis];
      // Across the axis: between both sides all the way, or never.
      if (ray_.inverse[axis] == 0.0) {
        if (low > 0.0 || high < 0.0) return {1.0, 0.0};
        continue;
      }
      const double a = low * ray_.inverse[axis], b = high * ray_.inverse[axis];
      through.begin = max_of(through.begin, min_of(a, b));
      through.end = min_of(through.end, max_of(a, b));
    }
    return through;
  }

  const DepthRay& ray_;
  double nearest_, end_ = 0.0;
};

}  // namespace

SeenPoints first_hits(const Camera& camera, const CameraAxes& axes, const Boxes& boxes) noexcept {
  SeenPoints seen;
  static_assert(kRays <= SeenPoints::kMost);
  for (std::size_t i = 0; i < kRays; ++i) {
    const double x = camera.left + (camera.right - camera.left) * even_x(i);
    const double y = camera.bottom + (camera.top - camera.bottom) * even_y(i);
    const glm::dvec3 aside = axes.right * x + axes.up * y;
    const glm::dvec3 direction = camera.orthographic ? axes.forward : axes.forward + aside;
    const glm::dvec3 origin = camera.orthographic ? aside : glm::dvec3(0.0);
    const glm::dvec3 inverse{inverse_or_0(direction.x), inverse_or_0(direction.y), inverse_or_0(direction.z)};
    const DepthRay ray{origin, inverse, camera.near_depth, camera.far_depth};
    HitQuery query(ray);
    BoxWalk({}, boxes, camera.position, query).whole();
    if (!(query.nearest() < ray.most)) continue;
    // A surface lies somewhere inside of its box: points on the boxes' sides were as often worse than better.
    const double inside = spread(0.3819660112501051, i);
    const double end = min_of(query.end(), ray.most);
    seen.point[seen.count++] = origin + direction * (query.nearest() + inside * (end - query.nearest()));
  }
  return seen;
}

SeenPoints some_of(const Camera& camera, const CameraAxes& axes,
                   std::span<const glm::dvec3> points_world) noexcept {
  SeenPoints seen;
  if (points_world.empty()) return seen;
  const std::size_t stride = 1 + (points_world.size() - 1) / SeenPoints::kMost;
  for (std::size_t i = stride / 2; i < points_world.size() && seen.count < SeenPoints::kMost; i += stride) {
    const glm::dvec3 p = points_world[i] - camera.position;
    const double depth = glm::dot(axes.forward, p);
    if (depth >= camera.near_depth && depth <= camera.far_depth) seen.point[seen.count++] = p;
  }
  return seen;
}

}  // namespace gnomon
