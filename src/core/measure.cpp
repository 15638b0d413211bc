// The error over everything the camera sees: percentiles, share of undersampled points, storage.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "elementary.hpp"
#include "gnomon/metric.hpp"
#include "log_histogram.hpp"
#include "metric_lanes.hpp"
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

/// Points on their way to their maps' blocks, and what came out so far.
class Tally {
 public:
  Tally(const ShadowPlan& plan, const Camera& camera, const CameraAxes& axes) noexcept
      : plan_(plan), camera_(camera), axes_(axes) {}

  void add(int map, const glm::dvec3& point) noexcept {
    const auto index = static_cast<std::size_t>(map);
    waiting_[index].point.set(waiting_[index].count++, point);
    if (waiting_[index].count == kMetricLanes) judge(index);
  }
  void add_outside() noexcept { ++outside_; }
  [[nodiscard]] AliasingStats stats() noexcept;

 private:
  struct Waiting {
    VectorLanes point;
    std::size_t count = 0;
  };
  void judge(std::size_t index) noexcept;

  const ShadowPlan& plan_;
  const Camera& camera_;
  const CameraAxes& axes_;
  std::array<Waiting, kMaxMaps> waiting_;
  MetricBlock block_;
  LogHistogram<10> histogram_;
  std::array<double, kMaxMaps> s_max_{}, t_max_{};
  std::uint64_t undersampled_ = 0, outside_ = 0;
};

void Tally::judge(std::size_t index) noexcept {
  Waiting& waiting = waiting_[index];
  block_.point = waiting.point;
  judge_perspective(MetricFrame(plan_.map[index], camera_, axes_), block_, waiting.count);
  const ExtentLanes& e = block_.perspective;
  for (std::size_t i = 0; i < waiting.count; ++i) {
    if (!(block_.inside[i] > 0.0)) {
      ++outside_;
      continue;
    }
    histogram_.add(e.longest[i]);
    if (e.longest[i] > 1.0) ++undersampled_;
    s_max_[index] = max_of(s_max_[index], e.s[i]);
    t_max_[index] = max_of(t_max_[index], e.t[i]);
  }
  waiting.count = 0;
}

AliasingStats Tally::stats() noexcept {
  AliasingStats stats;
  for (std::size_t i = 0; i < static_cast<std::size_t>(plan_.map_count); ++i) {
    judge(i);
    const double texels = static_cast<double>(plan_.map[i].width) * plan_.map[i].height;
    stats.storage += s_max_[i] * t_max_[i] * texels / (static_cast<double>(camera_.width) * camera_.height);
  }
  stats.outside = outside_;
  stats.samples = histogram_.count();
  if (stats.samples > 0) {
    stats.p50 = histogram_.percentile(0.50);
    stats.p95 = histogram_.percentile(0.95);
    stats.max = histogram_.largest();
    stats.share_undersampled = static_cast<double>(undersampled_) / static_cast<double>(stats.samples);
  }
  return stats;
}

/// Where a pixel's ray starts, and how it goes on per unit of view depth.
struct PixelRay {
  glm::dvec3 start, step;
};

PixelRay pixel_ray(const Camera& camera, const CameraAxes& axes, const MeasureGrid& grid, int column,
                   int row) noexcept {
  const double x = camera.left + (camera.right - camera.left) * (column + 0.5) / grid.columns;
  const double y = camera.bottom + (camera.top - camera.bottom) * (row + 0.5) / grid.rows;
  const glm::dvec3 image = axes.right * x + axes.up * y;
  if (camera.orthographic) return {camera.position + image, axes.forward};
  return {camera.position, axes.forward + image};
}

/// From where the ray enters the first box to where it leaves the last.
Interval depths_in_hull(std::span<const Box> boxes, const PixelRay& ray, Interval range) noexcept {
  Interval hull{range.end, range.begin};
  for (const Box& box : boxes) {
    const Interval part = depths_in_box(box, ray.start, ray.step, range);
    if (part.begin > part.end) continue;
    hull = {min_of(hull.begin, part.begin), max_of(hull.end, part.end)};
  }
  return hull;
}

bool in_some_box(std::span<const Box> boxes, const PixelRay& ray, double depth, Interval range) noexcept {
  for (const Box& box : boxes) {
    const Interval part = depths_in_box(box, ray.start, ray.step, range);
    if (depth >= part.begin && depth <= part.end) return true;
  }
  return false;
}

/// Depths of a grid, a table at a time: their powers are taken once for all pixels.
constexpr int kDepths = 256;
struct DepthTable {
  std::array<double, kDepths> depth;
  int count;
};

DepthTable depth_table(const Camera& camera, const MeasureGrid& grid, int begin) noexcept {
  DepthTable table;
  table.count = grid.depths - begin < kDepths ? grid.depths - begin : kDepths;
  const double n = camera.near_depth, f = camera.far_depth;
  for (int k = 0; k < table.count; ++k) {
    const double t = (begin + k + 0.5) / grid.depths;
    table.depth[static_cast<std::size_t>(k)] = n > 0.0 ? n * elementary::pow(f / n, t) : n + (f - n) * t;
  }
  return table;
}

AliasingStats measure_maps(const ShadowPlan& plan, int only, const Camera& camera, const SceneBounds& bounds,
                           const MeasureGrid& grid) noexcept {
  if (plan.map_count == 0) return {};
  if (std::isinf(camera.far_depth)) {
    return measure_maps(plan, only, with_finite_far(camera, bounds.receivers), bounds, grid);
  }
  const CameraAxes axes = camera_axes(camera);
  const Interval range{camera.near_depth, camera.far_depth};
  const bool one_box = bounds.receivers.size() == 1;
  Tally tally(plan, camera, axes);
  const auto sample = [&](const PixelRay& ray, double depth) {
    const glm::dvec3 point = ray.start + ray.step * depth;
    const int map = map_serving(plan, point, depth);
    if (map < 0) tally.add_outside();
    if (map >= 0 && (only < 0 || map == only)) tally.add(map, point);
  };
  for (int begin = 0; begin < grid.depths; begin += kDepths) {
    const DepthTable table = depth_table(camera, grid, begin);
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const PixelRay ray = pixel_ray(camera, axes, grid, column, row);
        const Interval hull = depths_in_hull(bounds.receivers, ray, range);
        for (int k = 0; k < table.count; ++k) {
          const double depth = table.depth[static_cast<std::size_t>(k)];
          if (depth < hull.begin || depth > hull.end) continue;
          if (one_box || in_some_box(bounds.receivers, ray, depth, range)) sample(ray, depth);
        }
      }
    }
  }
  return tally.stats();
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
