// The aliasing error at one point, from the Jacobian d(texel)/d(pixel).
// Based on: Lloyd, Tuft, Yoon, Manocha, "Warping and Partitioning for Low Error Shadow Maps", 2006; Scherzer,
// Wimmer, Purgathofer, survey 2011, equations 1 and 2.
#include "gnomon/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/metric_kernel.hpp"
#include "measure/metric_lanes.hpp"

namespace gnomon {
namespace {

// Cosines below this are edge-on: the ratios of the limits no longer mean anything in double.
constexpr double kEdgeOn = 1e-12;

PointAliasing perspective_result(const MetricBlock& block, std::size_t i) noexcept {
  if (!(block.inside[i] > 0.0)) return outside_map();
  const ExtentLanes& e = block.perspective;
  PointAliasing result;
  result.status = PointAliasing::Status::ok;
  result.m_max = result.perspective_max = e.longest[i];
  result.m_s = result.perspective_s = e.s[i];
  result.m_t = result.perspective_t = e.t[i];
  result.m_min = e.shortest[i];
  result.m_area = e.area[i];
  result.anisotropy = e.anisotropy[i];
  return result;
}

PointAliasing surface_result(const MetricBlock& block, std::size_t i) noexcept {
  PointAliasing result = perspective_result(block, i);
  if (result.status != PointAliasing::Status::ok) return result;
  const double cos_eye = block.cos_eye[i], cos_light = block.cos_light[i];
  if (!(std::abs(cos_eye) > kEdgeOn) && !(std::abs(cos_light) > kEdgeOn)) {
    result.status = PointAliasing::Status::undetermined;
    return result;
  }
  if (cos_eye < 0.0 || cos_light < 0.0) {
    result.status = PointAliasing::Status::faces_away;
    return result;
  }
  const ExtentLanes& e = block.surface;
  result.projection = cos_light > 0.0 ? cos_eye / cos_light : std::numeric_limits<double>::infinity();
  result.m_max = e.longest[i];
  result.m_min = e.shortest[i];
  result.m_s = e.s[i];
  result.m_t = e.t[i];
  result.m_area = e.area[i];
  result.anisotropy = e.anisotropy[i];
  return result;
}

}  // namespace

void measure_perspectives(const ShadowMap& map, const Camera& camera, std::span<const glm::dvec3> points,
                          std::span<PointAliasing> out) noexcept {
  const MetricFrame frame(map, camera, camera_axes(camera));
  const std::size_t all = std::min(points.size(), out.size());
  MetricBlock block;
  for (std::size_t begin = 0; begin < all; begin += kMetricLanes) {
    const std::size_t count = std::min(kMetricLanes, all - begin);
    for (std::size_t i = 0; i < count; ++i) block.point.set(i, points[begin + i]);
    judge_perspective(frame, block, count);
    for (std::size_t i = 0; i < count; ++i) out[begin + i] = perspective_result(block, i);
  }
}

void measure_points(const ShadowMap& map, const Camera& camera, std::span<const glm::dvec3> points,
                    std::span<const glm::dvec3> normals, std::span<PointAliasing> out) noexcept {
  const MetricFrame frame(map, camera, camera_axes(camera));
  const std::size_t all = std::min({points.size(), normals.size(), out.size()});
  MetricBlock block;
  for (std::size_t begin = 0; begin < all; begin += kMetricLanes) {
    const std::size_t count = std::min(kMetricLanes, all - begin);
    for (std::size_t i = 0; i < count; ++i) {
      block.point.set(i, points[begin + i]);
      block.normal.set(i, normals[begin + i]);
    }
    judge_perspective(frame, block, count);
    judge_surface(frame, block, count);
    for (std::size_t i = 0; i < count; ++i) out[begin + i] = surface_result(block, i);
  }
}

PointAliasing measure_perspective(const ShadowMap& map, const Camera& camera,
                                  const glm::dvec3& point) noexcept {
  PointAliasing result;
  measure_perspectives(map, camera, {&point, 1}, {&result, 1});
  return result;
}

PointAliasing measure_point(const ShadowMap& map, const Camera& camera, const glm::dvec3& point,
                            const glm::dvec3& normal) noexcept {
  PointAliasing result;
  measure_points(map, camera, {&point, 1}, {&normal, 1}, {&result, 1});
  return result;
}

}  // namespace gnomon
