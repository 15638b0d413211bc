// Which casters can shadow a body: the body swept towards the light, and the casters inside.
#include "cull/sweep.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

// Rounding of positions, relative to their distance from the origin of the world, and of the body's faces.
constexpr double kPositionRounding = 4e-13;
// Boxes whose part inside the region is cut out exactly to find the nearest; further ones count with their
// whole extent.
constexpr int kExactBoxes = 64;

}  // namespace

SweptBody sweep(const Polytope& body, const glm::dvec4& light, double margin_world,
                const glm::dvec3& eye_world) noexcept {
  SweptBody swept;
  swept.plane_count = swept_planes(body, light, swept.plane);
  double farthest = max_of(largest_component(eye_world), light.w * largest_component(glm::dvec3(light)));
  for (const Polytope::Vertex& v : body.vertices())
    farthest = max_of(farthest, largest_component(v.position));
  // A caster that touches the body counts, whatever rounding makes of the touch.
  const double slack = margin_world + kPositionRounding * farthest;
  for (int i = 0; i < swept.plane_count; ++i) swept.plane[static_cast<std::size_t>(i)].offset += slack;
  return swept;
}

NearBoxes nearest_boxes(std::span<const Plane> planes, std::span<const Box> boxes, const glm::dvec3& origin,
                        const glm::dvec3& apex, const glm::dvec3& axis, double least,
                        double stand_in) noexcept {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  NearBoxes found{0, kInfinite, 0};
  const double apex_along = glm::dot(axis, apex);
  int exact = 0;
  for (const Box& world : boxes) {
    if (world.empty()) continue;
    const Box box = relative_to(world, origin);
    bool reaches = true;
    for (std::size_t i = 0; i < planes.size() && reaches; ++i)
      reaches = side_of(planes[i], box) != Side::outside;
    if (!reaches) continue;
    const glm::dvec3 corner{axis.x > 0.0 ? box.min.x : box.max.x, axis.y > 0.0 ? box.min.y : box.max.y,
                            axis.z > 0.0 ? box.min.z : box.max.z};
    double nearest = glm::dot(axis, corner) - apex_along;
    if (nearest < found.nearest && exact < kExactBoxes) {
      ++exact;
      Polytope part = box_polytope(box);
      for (const Plane& plane : planes) clip(part, plane);
      if (part.empty()) continue;
      double cut = kInfinite;
      for (const Polytope::Vertex& v : part.vertices())
        cut = min_of(cut, glm::dot(axis, v.position) - apex_along);
      nearest = max_of(nearest, cut);
    }
    ++found.count;
    if (nearest < least) {
      ++found.too_near;
      nearest = stand_in;
    }
    found.nearest = min_of(found.nearest, nearest);
  }
  return found;
}

}  // namespace gnomon
