// The aliasing error at one point, from the Jacobian d(texel)/d(pixel).
// Based on: Lloyd, Tuft, Yoon, Manocha, "Warping and Partitioning for Low Error Shadow Maps", 2006; Scherzer,
// Wimmer, Purgathofer, survey 2011, equations 1 and 2.
#include "gnomon/metric.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "jacobian.hpp"
#include "metric_kernel.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

// Cosines below this are edge-on: the ratios of the limits no longer mean anything in double.
constexpr double kEdgeOn = 1e-12;

}  // namespace

PointAliasing measure_perspective(const ShadowMap& map, const Camera& camera,
                                  const glm::dvec3& point) noexcept {
  const TexelJacobian b = texel_jacobian(map.clip_from_world, map.width, map.height, point);
  // A few units in the last place beyond the rim is rounding, not outside.
  constexpr double kRim = 1.0 + 1e-9;
  if (!(b.w > 0.0) || !(std::abs(b.ndc_x) <= kRim) || !(std::abs(b.ndc_y) <= kRim)) return outside_map();
  const ViewPoint view = view_point(camera, camera_axes(camera), point);
  return perspective_aliasing(b, view, light_ray(map.light_world, point));
}

PointAliasing measure_point(const ShadowMap& map, const Camera& camera, const glm::dvec3& point,
                            const glm::dvec3& normal) noexcept {
  PointAliasing result = measure_perspective(map, camera, point);
  if (result.status != PointAliasing::Status::ok) return result;
  const ViewPoint view = view_point(camera, camera_axes(camera), point);
  const glm::dvec3 light = light_ray(map.light_world, point);
  const double cos_eye = -glm::dot(normal, view.ray), cos_light = -glm::dot(normal, light);
  if (!(std::abs(cos_eye) > kEdgeOn) && !(std::abs(cos_light) > kEdgeOn)) {
    result.status = PointAliasing::Status::undetermined;
    return result;
  }
  if (cos_eye < 0.0 || cos_light < 0.0) {
    result.status = PointAliasing::Status::faces_away;
    return result;
  }
  result.projection = cos_eye / cos_light;
  const TexelJacobian b = texel_jacobian(map.clip_from_world, map.width, map.height, point);
  const Extents e = extents(surface_jacobian(b, view, normal));
  result.m_max = e.longest;
  result.m_min = e.shortest;
  result.m_s = e.s;
  result.m_t = e.t;
  result.m_area = std::sqrt(e.longest * e.shortest);
  result.anisotropy = e.longest / e.shortest;
  return result;
}

}  // namespace gnomon
