// What visible points say about where receivers need a map.
// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010 (bounds of a partition's
// samples in light space).
#include "plan/points.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

// Callers read some pixels of many: surfaces go on up to the next one read, which may be so many pixels away.
constexpr double kPixelsBetween = 16.0;

}  // namespace

void clip_to_points(const PlanContext& c, const LightFrame& frame, double begin, double end,
                    Polytope& body) noexcept {
  Box bounds;  // along the frame's axes
  double farthest = 0.0;
  // Depths of points on the slice's ends are rounded, and so are the points.
  constexpr double kRounding = 1e-9;
  const double slack =
      kRounding * (max_of(std::abs(begin), std::abs(end)) + largest_component(c.camera.position));
  for (const glm::dvec3& point : c.seen_points) {
    const glm::dvec3 p = point - c.camera.position;
    const double depth = glm::dot(c.axes.forward, p);
    if (!(depth >= begin - slack && depth <= end + slack)) continue;
    bounds.extend(frame.turned(p));
    farthest = max_of(farthest, depth);
  }
  if (bounds.empty() || body.empty()) return;
  const Camera& camera = c.camera;
  const double pixel =
      max_of((camera.right - camera.left) / camera.width, (camera.top - camera.bottom) / camera.height);
  const double extent = max_of(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
  const double room = kPointSafety * extent + kPixelsBetween * pixel * (camera.orthographic ? 1.0 : farthest);
  Polytope part = body;
  clip(part, {frame.x, room - bounds.min.x});
  clip(part, {-frame.x, room + bounds.max.x});
  clip(part, {frame.y, room - bounds.min.y});
  clip(part, {-frame.y, room + bounds.max.y});
  // Points beside all receivers are of another scene.
  if (!part.empty()) body = part;
}

}  // namespace gnomon
