// What a camera sees of boxes and what a shadow ray meets, in long double and with what rounding may change
// left out.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "exact.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"

namespace gnomon::stress {

/// Of an interval without an end.
inline constexpr Real kNoBound = std::numeric_limits<Real>::infinity();

/// The numbers between two bounds.
struct Interval {
  Real low = -kNoBound, high = kNoBound;
  [[nodiscard]] bool empty() const { return !(low <= high); }
  /// Keeps what has slope t + offset >= 0.
  void keep(Real slope, Real offset) {
    if (slope == 0.0L) {
      if (offset < 0.0L) high = -kNoBound;
    } else if (slope > 0.0L) {
      low = std::max(low, -offset / slope);
    } else {
      high = std::min(high, -offset / slope);
    }
  }
};

/// The camera in Real; everything is relative to its position.
struct View {
  explicit View(const Camera& camera);
  Camera camera;
  Real3 right, up, forward, eye;
  [[nodiscard]] Real depth(const Real3& p) const;
  /// Inside of the frustum by more than any rounding of a double changes.
  [[nodiscard]] bool clearly_sees(const Real3& p) const;
};

/// Corners of what the camera sees of the box between two view depths, relative to the camera: ends of the
/// box's edges inside the frustum, and of the frustum's edges inside the box. Empty where nothing is seen.
[[nodiscard]] std::vector<Real3> seen_corners(const View& view, const Box& box, Real begin, Real end);
/// The same, and `between` points between the corners, as many near the camera as far from it.
[[nodiscard]] std::vector<Real3> seen_points(const View& view, const Box& box, Real begin, Real end,
                                             int between, Random& random);

/// A light as a point of the scene finds it, relative to the camera.
class LightAt {
 public:
  LightAt(const Light& light, const View& view);
  [[nodiscard]] bool parallel() const noexcept { return parallel_; }
  [[nodiscard]] const Real3& apex() const noexcept { return apex_; }
  /// Unit, the way a spot points.
  [[nodiscard]] const Real3& axis() const noexcept { return axis_; }
  /// Whether the light shines on the point, clear of cone, range and the light itself.
  [[nodiscard]] bool clearly_lights(const Real3& p) const;
  /// From the point towards the light: a unit vector for parallel light, else all the way to it.
  [[nodiscard]] Real3 way(const Real3& p) const { return parallel_ ? to_light_ : apex_ - p; }
  /// Unit, the way the light travels at the point.
  [[nodiscard]] Real3 travel(const Real3& p) const;
  /// How far along way() casters count. Of a local light all but the last thousandth: what is nearer stands
  /// at the light itself.
  [[nodiscard]] Real end() const noexcept;

 private:
  bool parallel_ = true, cone_ = false;
  Real3 to_light_{0.0L}, apex_{0.0L}, axis_{0.0L};
  Real range_ = 0.0L, outer_ = 0.0L, world_ = 0.0L;
};

/// Where the ray p + t way is inside of the box, for t in 0..end. No hit where rounding might miss the box.
struct RayHit {
  bool hits = false;
  Real enter = 0.0L, leave = 0.0L;
};
[[nodiscard]] RayHit clear_hit(const View& view, const Box& box, const Real3& p, const Real3& way, Real end);

[[nodiscard]] inline Real length(const Real3& v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}
[[nodiscard]] inline Real largest(const Real3& v) {
  return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
}

/// Where a ray enters the nearest box that it passes between two depths of the grid.
struct ThinHit {
  bool met = false, doubt = false;
  Real depth = 0.0L;
};

/// `doubt`: rounding decides whether there is one. `range`: the depths in view.
[[nodiscard]] ThinHit thin_hit(const std::vector<Box>& receivers, const View& view, const Real3& start,
                               const Real3& way, const std::vector<Real>& depths, const Interval& range);

}  // namespace gnomon::stress
