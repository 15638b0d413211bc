// Which casters can shadow a body: the body swept towards the light.
#include "cull/sweep.hpp"
#include "gnomon/extend/body.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/pair.hpp"

namespace gnomon {
namespace {

// Rounding of positions, relative to their distance from the origin of the world, and of the body's faces.
constexpr double kPositionRounding = 4e-13;

}  // namespace

void sweep(const Polytope& body, const glm::dvec4& light, double margin_world, const glm::dvec3& eye_world,
           SweptBody& swept) noexcept {
  swept.plane_count = swept_planes(body, light, swept.plane);
  double farthest = max_of(largest_component(eye_world), light.w * largest_component(glm::dvec3(light)));
  Pair xy(0.0);
  for (const Polytope::Vertex& v : body.vertices()) {
    xy = max_of(xy, abs(Pair::from(&v.position.x)));
    farthest = max_of(farthest, std::abs(v.position.z));
  }
  farthest = max_of(farthest, max_of(xy.low(), xy.high()));
  // A caster that touches the body counts, whatever rounding makes of the touch.
  const double slack = margin_world + kPositionRounding * farthest;
  for (int i = 0; i < swept.plane_count; ++i) swept.plane[static_cast<std::size_t>(i)].offset += slack;
}

}  // namespace gnomon
