// How good would a logarithmic perspective map be?
// Based on: Lloyd, Govindaraju, Quammen, Molnar, Manocha, "Logarithmic Perspective Shadow Maps", 2008: PSM
// across the axis, ln(w) along it, so that errors along the view are the same at all depths.
#include "gnomon/study/log_perspective.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/light_axes.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "lanes/elementary.hpp"
#include "map/gain.hpp"
#include "measure/log_histogram.hpp"
#include "measure/measure_grid.hpp"
#include "measure/metric_kernel.hpp"
#include "plan/cascades.hpp"
#include "plan/input.hpp"

namespace gnomon {
namespace {

/// A point on the map's own axes.
struct OnAxes {
  double across, along, w;
};
OnAxes on_axes(const LogPerspectiveMap& map, const glm::dvec3& point) noexcept {
  const glm::dvec3 p = point - map.eye_world;
  const double along = glm::dot(map.along, p) - map.u_min;
  return {glm::dot(map.across, p) - map.centre, along, 1.0 + map.kappa * along};
}

// Below this much of a warp the logarithm is a straight line to the last bit.
constexpr double kStraight = 1e-17;

/// Share of the map's side at a distance along the axis.
double share_along(const LogPerspectiveMap& map, double along) noexcept {
  const double reach = map.kappa * map.length;
  return reach > kStraight ? elementary::log1p(map.kappa * along) / elementary::log1p(reach)
                           : along / map.length;
}
/// Its derivative.
double share_slope(const LogPerspectiveMap& map, double w) noexcept {
  const double reach = map.kappa * map.length;
  return (reach > kStraight ? map.kappa / elementary::log1p(reach) : 1.0 / map.length) / w;
}

}  // namespace

LogPerspectiveMap log_perspective_map(const Camera& any_camera, const DirectionalLight& light,
                                      const SceneBounds& bounds, int size) noexcept {
  LogPerspectiveMap map;
  PlanOptions options;
  options.resolution.max_size = size;
  options.warp.warp = &warps::psm;
  if (!first_invalid_field(any_camera, light, bounds, options).empty()) return map;
  const Camera camera = with_finite_far(any_camera, bounds.receivers);
  const CameraAxes axes = camera_axes(camera);
  Polytope body = frustum_slice(camera, axes, camera.near_depth, camera.far_depth);
  clip(body, visible_bounds(body, bounds.receivers, camera.position));
  if (body.empty()) return map;
  const glm::dvec3 direction = safe_normalize(light.direction, {0.0, -1.0, 0.0});
  const PlanContext context{camera, bounds, options, axes};
  LightSpace space;
  space.frame = view_aligned_frame(direction, axes);
  const DepthRange depths = depths_of(body, axes.forward);
  const PlaneMap plane = focused_plane(
      context, request_for({body, depths, space, warps::psm}, body, max_of(depths.begin, camera.near_depth),
                           max_of(depths.end, camera.near_depth)));
  const LightFrame& frame = space.frame;
  const glm::dvec2 axis = plane.choice.axis;
  map.valid = true;
  map.size = size;
  map.eye_world = camera.position;
  map.light_direction = direction;
  map.along = frame.x * axis.x + frame.y * axis.y;
  map.across = frame.x * axis.y - frame.y * axis.x;
  map.kappa = plane.choice.kappa;
  map.centre = plane.choice.centre;
  map.u_min = plane.u_min;
  // Of a body without length, the extent that the plane was given.
  map.length = plane.length > 0.0 ? plane.length : plane.b_max - plane.b_min;
  map.x_min = plane.a_min;
  map.x_max = plane.a_max;
  return map;
}

glm::dvec2 log_perspective_texel(const LogPerspectiveMap& map, const glm::dvec3& point) noexcept {
  const OnAxes p = on_axes(map, point);
  if (!(p.w > 0.0)) return glm::dvec2(std::numeric_limits<double>::infinity());
  const double x = (p.across / p.w - map.x_min) / (map.x_max - map.x_min);
  return glm::dvec2(x, share_along(map, p.along)) * static_cast<double>(map.size);
}

LogPerspectiveJacobian log_perspective_jacobian(const LogPerspectiveMap& map,
                                                const glm::dvec3& point) noexcept {
  const OnAxes p = on_axes(map, point);
  if (!(p.w > 0.0)) return {glm::dvec3(0.0), glm::dvec3(0.0)};
  const double scale = map.size / ((map.x_max - map.x_min) * p.w);
  return {(map.across - map.along * (map.kappa * p.across / p.w)) * scale,
          map.along * (map.size * share_slope(map, p.w))};
}

PointAliasing measure_perspective(const LogPerspectiveMap& map, const Camera& camera,
                                  const glm::dvec3& point) noexcept {
  // A few units in the last place beyond the rim is rounding, not outside.
  const double rounding = 1e-9 * map.size;
  const glm::dvec2 texel = map.valid ? log_perspective_texel(map, point) : glm::dvec2(-1.0);
  const auto inside = [&](double t) { return t >= -rounding && t <= map.size + rounding; };
  if (!map.valid || !inside(texel.x) || !inside(texel.y)) return outside_map();
  const LogPerspectiveJacobian j = log_perspective_jacobian(map, point);
  return perspective_aliasing({j.x, j.y, 0.0, 0.0, 1.0}, view_point(camera, camera_axes(camera), point),
                              map.light_direction);
}

AliasingStats measure(const LogPerspectiveMap& map, const Camera& any_camera, const SceneBounds& bounds,
                      const MeasureOptions& grid) noexcept {
  AliasingStats stats;
  if (!map.valid) return stats;
  const Camera camera = with_finite_far(any_camera, bounds.receivers);
  LogHistogram<10, 128> histogram;
  double s_max = 0.0, t_max = 0.0;
  std::uint64_t undersampled = 0;
  const auto sample = [&](const glm::dvec3& point, double) {
    const PointAliasing a = measure_perspective(map, camera, point);
    if (a.status != PointAliasing::Status::ok) {
      ++stats.outside;
      return;
    }
    histogram.add(a.m_max);
    if (a.m_max > 1.0) ++undersampled;
    s_max = max_of(s_max, a.m_s);
    t_max = max_of(t_max, a.m_t);
  };
  for_each_visible(camera, camera_axes(camera), bounds.receivers, grid, sample);
  constexpr std::array<double, 2> kShares = {0.50, 0.95};
  if (!histogram.knows(kShares)) {
    histogram.count_again(kShares);
    stats.outside = undersampled = 0;
    for_each_visible(camera, camera_axes(camera), bounds.receivers, grid, sample);
  }
  stats.samples = histogram.count();
  if (stats.samples == 0) return stats;
  stats.p50 = histogram.percentile(kShares[0]);
  stats.p95 = histogram.percentile(kShares[1]);
  stats.max = histogram.largest();
  stats.share_undersampled = static_cast<double>(undersampled) / static_cast<double>(stats.samples);
  const double texels = static_cast<double>(map.size) * map.size;
  stats.storage = s_max * t_max * texels / (static_cast<double>(camera.width) * camera.height);
  return stats;
}

}  // namespace gnomon
