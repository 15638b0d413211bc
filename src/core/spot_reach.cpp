// Which casters a map of a light with a position needs, and how near to the light they come.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "spot_draft.hpp"
#include "vector.hpp"
#include "visible.hpp"

namespace gnomon {
namespace {

/// How far a filter's kernel reaches, as a slope: from the corners without the rim to those with it.
double kernel_reach(const Draft& d) noexcept {
  if (!(d.rim > 0.0)) return 0.0;
  const glm::dmat4 flat = clip_from_light(d.plane, {0.0, 1.0}, d.rim);
  const glm::dmat3 slopes_from_ndc = glm::inverse(glm::dmat3(glm::dvec3(flat[0][0], flat[0][1], flat[0][3]),
                                                             glm::dvec3(flat[1][0], flat[1][1], flat[1][3]),
                                                             glm::dvec3(flat[3][0], flat[3][1], flat[3][3])));
  double reach = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double x = (i & 1) ? 1.0 : -1.0, y = (i & 2) ? 1.0 : -1.0, fill = 1.0 - 2.0 * d.rim;
    const glm::dvec3 outer = slopes_from_ndc * glm::dvec3(x, y, 1.0);
    const glm::dvec3 inner = slopes_from_ndc * glm::dvec3(x * fill, y * fill, 1.0);
    const glm::dvec2 apart = glm::dvec2(outer) / outer.z - glm::dvec2(inner) / inner.z;
    reach = max_of(reach, std::sqrt(glm::dot(apart, apart)));
  }
  return reach;
}

}  // namespace

Reach reach_of(const Draft& d, const glm::dmat4& m, double slack) noexcept {
  Reach reach;
  const glm::dvec3 row_w{m[0][3], m[1][3], m[2][3]};
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    const glm::dvec3 row{m[0][axis], m[1][axis], m[2][axis]};
    const glm::dvec3 normal = safe_normalize(side % 2 == 0 ? row_w + row : row_w - row, -d.frustum.frame.z);
    reach.add({normal, slack - glm::dot(normal, d.frustum.apex)});
  }
  const glm::dvec3 axis = -d.frustum.frame.z;
  reach.add({-axis, glm::dot(axis, d.frustum.apex) + d.far_distance + slack});
  bool used[kMaxFaces] = {};
  for (const Polytope::Vertex& v : d.light.lit.vertices()) {
    for (const std::uint8_t f : v.face) used[f] = true;
  }
  const double outward = slack + kernel_reach(d) * d.far_distance;
  for (int f = 0; f < d.light.lit.face_count; ++f) {
    const Plane& p = d.light.lit.plane[static_cast<std::size_t>(f)];
    if (!used[f] || !(glm::dot(p.normal, d.frustum.apex) + p.offset >= 0.0)) continue;
    reach.add({p.normal, p.offset + outward});
  }
  return reach;
}

double nearest_caster(const Draft& d, const Reach& reach) noexcept {
  return nearest_inside({reach.plane.data(), static_cast<std::size_t>(reach.count)}, d.light.bounds.casters,
                        d.light.eye_world, d.frustum.frame.z, d.frustum.apex);
}

}  // namespace gnomon
