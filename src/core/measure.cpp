// The error over everything the camera sees: percentiles, share of undersampled points, storage.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "elementary.hpp"
#include "gnomon/metric.hpp"
#include "log_histogram.hpp"
#include "metric_kernel.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

/// Where a ray from the eye is inside a box, as view depths; empty where begin > end.
struct Interval {
  double begin, end;
};

Interval depths_in_box(const Box& box, const glm::dvec3& start, const glm::dvec3& step,
                       Interval range) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    if (step[axis] == 0.0) {
      if (start[axis] < box.min[axis] || start[axis] > box.max[axis]) return {1.0, 0.0};
      continue;
    }
    const double a = (box.min[axis] - start[axis]) / step[axis],
                 b = (box.max[axis] - start[axis]) / step[axis];
    range.begin = max_of(range.begin, min_of(a, b));
    range.end = min_of(range.end, max_of(a, b));
  }
  return range;
}

AliasingStats measure_maps(const ShadowPlan& plan, int only, const Camera& camera, const SceneBounds& bounds,
                           const MeasureGrid& grid) noexcept {
  AliasingStats stats;
  if (plan.map_count == 0) return stats;
  if (std::isinf(camera.far_depth)) {
    return measure_maps(plan, only, with_finite_far(camera, bounds.receivers), bounds, grid);
  }
  const CameraAxes axes = camera_axes(camera);
  LogHistogram<10> histogram;
  std::array<double, kMaxMaps> s_max{}, t_max{};
  std::uint64_t undersampled = 0;
  const double n = camera.near_depth, f = camera.far_depth;
  const bool by_ratio = n > 0.0;
  const auto depth_of = [&](int k) {
    const double t = (k + 0.5) / grid.depths;
    return by_ratio ? n * elementary::pow(f / n, t) : n + (f - n) * t;
  };
  const auto sample = [&](const glm::dvec3& point, double depth) {
    const int index = map_serving(plan, point, depth);
    if (index < 0 || (only >= 0 && index != only)) {
      if (index < 0) ++stats.outside;
      return;
    }
    const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
    const TexelJacobian b = texel_jacobian(map.clip_from_world, map.width, map.height, point);
    constexpr double kRim = 1.0 + 1e-9;
    if (!(b.w > 0.0) || !(std::abs(b.ndc_x) <= kRim) || !(std::abs(b.ndc_y) <= kRim)) {
      ++stats.outside;
      return;
    }
    const ViewPoint view = view_point(camera, axes, point);
    const Extents e = extents(perspective_jacobian(b, view, light_ray(map.light_world, point)));
    histogram.add(e.longest);
    if (e.longest > 1.0) ++undersampled;
    s_max[static_cast<std::size_t>(index)] = max_of(s_max[static_cast<std::size_t>(index)], e.s);
    t_max[static_cast<std::size_t>(index)] = max_of(t_max[static_cast<std::size_t>(index)], e.t);
  };
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double x = camera.left + (camera.right - camera.left) * (column + 0.5) / grid.columns;
      const double y = camera.bottom + (camera.top - camera.bottom) * (row + 0.5) / grid.rows;
      const glm::dvec3 image = axes.right * x + axes.up * y;
      const glm::dvec3 start = camera.orthographic ? camera.position + image : camera.position;
      const glm::dvec3 step = camera.orthographic ? axes.forward : axes.forward + image;
      Interval hull{f, n};
      for (const Box& box : bounds.receivers) {
        const Interval part = depths_in_box(box, start, step, {n, f});
        if (part.begin > part.end) continue;
        hull = {min_of(hull.begin, part.begin), max_of(hull.end, part.end)};
      }
      if (hull.begin > hull.end) continue;
      for (int k = 0; k < grid.depths; ++k) {
        const double depth = depth_of(k);
        if (depth < hull.begin || depth > hull.end) continue;
        bool inside = bounds.receivers.size() == 1;
        for (std::size_t i = 0; i < bounds.receivers.size() && !inside; ++i) {
          const Interval part = depths_in_box(bounds.receivers[i], start, step, {n, f});
          inside = depth >= part.begin && depth <= part.end;
        }
        if (inside) sample(start + step * depth, depth);
      }
    }
  }
  stats.samples = histogram.count();
  if (stats.samples > 0) {
    stats.p50 = histogram.percentile(0.50);
    stats.p95 = histogram.percentile(0.95);
    stats.max = histogram.largest();
    stats.share_undersampled = static_cast<double>(undersampled) / static_cast<double>(stats.samples);
  }
  const double pixels = static_cast<double>(camera.width) * camera.height;
  for (int i = 0; i < plan.map_count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const double texels = static_cast<double>(plan.map[index].width) * plan.map[index].height;
    stats.storage += s_max[index] * t_max[index] * texels / pixels;
  }
  return stats;
}

}  // namespace

AliasingStats measure(const ShadowPlan& plan, const Camera& camera, const SceneBounds& bounds,
                      const MeasureGrid& grid) noexcept {
  return measure_maps(plan, -1, camera, bounds, grid);
}

AliasingStats measure_map(const ShadowPlan& plan, int map, const Camera& camera, const SceneBounds& bounds,
                          const MeasureGrid& grid) noexcept {
  return measure_maps(plan, map, camera, bounds, grid);
}

}  // namespace gnomon
