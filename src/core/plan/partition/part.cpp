// What every way to divide the receivers shares: a part cut out of the body, and the objective of its map.
#include "plan/partition/part.hpp"

#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "map/gain.hpp"

namespace gnomon::partition {
namespace {

// Parts overlap by this much of the body's distance, and of the camera's from the origin of the world: a
// point must not fall between three of them by rounding.
constexpr double kOverlap = 1e-12, kPositionRounding = 1e-14;

}  // namespace

MapRequest request_of(const Part& part, const Polytope& body) noexcept {
  LightSpace space;
  space.frame = part.frame;
  return {{}, body, space, *part.warp, part.begin, part.end, {}, 0.0, 0.0, 0.0, false, {}};
}

Polytope inside_of(const PlanContext& c, const Polytope& body, const Part& part) noexcept {
  Polytope inside = body;
  for (int i = 0; i < part.plane_count; ++i) clip(inside, part.plane[static_cast<std::size_t>(i)]);
  if (part.plane_count > 0) clip_part(inside, c.bounds.receivers, c.camera.position);
  return inside;
}

void narrow_depths(const PlanContext& c, const Polytope& body, Part& part) noexcept {
  const DepthRange depths = depths_of(body, c.axes.forward);
  part.begin = max_of(part.begin, min_of(depths.begin, part.end));
  part.end = clamp_to(depths.end, part.begin, part.end);
}

bool weigh_part(const PlanContext& c, const Polytope& body, Part& part, PartsSum& sum) noexcept {
  double farthest = 0.0;
  for (const Polytope::Vertex& v : body.vertices())
    farthest = max_of(farthest, largest_component(v.position));
  const double overlap = kOverlap * farthest + kPositionRounding * largest_component(c.camera.position);
  for (int i = 0; i < part.plane_count; ++i) part.plane[static_cast<std::size_t>(i)].offset += overlap;
  const Polytope inside = inside_of(c, body, part);
  if (inside.empty()) return false;
  if (part.plane_count > 0) narrow_depths(c, inside, part);
  part.objective = focused_objective(c, request_of(part, inside)).value;
  sum.objective = c.options.warp.objective == Objective::storage ? sum.objective + part.objective
                                                                 : max_of(sum.objective, part.objective);
  ++sum.count;
  return true;
}

bool add_part(const PlanContext& c, const Polytope& body, Part part, Parts& parts) noexcept {
  const auto place = static_cast<std::size_t>(parts.sum.count);
  if (!weigh_part(c, body, part, parts.sum)) return false;
  parts.part[place] = part;
  return true;
}

}  // namespace gnomon::partition
