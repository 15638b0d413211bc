// What of the receivers does a part hold, and what does its map cost?
#include "plan/part.hpp"

#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "map/gain.hpp"

namespace gnomon {
namespace {

// Parts overlap by this much of the body's distance, and of the camera's from the origin of the world: a
// point must not fall between three of them by rounding.
constexpr double kOverlap = 1e-12, kPositionRounding = 1e-14;

}  // namespace

MapRequest request_of(const Part& part) noexcept {
  LightSpace space;
  space.frame = part.frame;
  return {{}, part.body, space, *part.warp, part.begin, part.end, {}, 0.0, 0.0, 0.0, false, {}};
}

void narrow_depths(const PlanContext& c, Part& part) noexcept {
  const DepthRange depths = depths_of(part.body, c.axes.forward);
  part.begin = max_of(part.begin, min_of(depths.begin, part.end));
  part.end = clamp_to(depths.end, part.begin, part.end);
}

void add_part(const PlanContext& c, const Polytope& body, Part part, Parts& parts) noexcept {
  double farthest = 0.0;
  for (const Polytope::Vertex& v : body.vertices())
    farthest = max_of(farthest, largest_component(v.position));
  const double overlap = kOverlap * farthest + kPositionRounding * largest_component(c.camera.position);
  part.body = body;
  for (int i = 0; i < part.plane_count; ++i) {
    Plane& plane = part.plane[static_cast<std::size_t>(i)];
    plane.offset += overlap;
    clip(part.body, plane);
  }
  if (part.plane_count > 0) clip_part(part.body, c.bounds.receivers, c.camera.position);
  if (part.body.empty()) return;
  if (part.plane_count > 0) narrow_depths(c, part);
  part.objective = focused_objective(c, request_of(part)).value;
  parts.objective = c.options.warp.objective == Objective::storage ? parts.objective + part.objective
                                                                   : max_of(parts.objective, part.objective);
  parts.part[static_cast<std::size_t>(parts.count++)] = part;
}

}  // namespace gnomon
