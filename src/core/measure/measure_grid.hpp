// The points at which errors are measured: a grid over the image, and depths along each pixel's ray inside
// the receivers.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "geometry/elementary.hpp"
#include "geometry/vector.hpp"
#include "gnomon/metric.hpp"

namespace gnomon {

/// Where a ray from the eye is inside a box, as view depths; empty where begin > end.
struct DepthInterval {
  double begin, end;
};

[[nodiscard]] inline DepthInterval depths_in_box(const Box& box, const glm::dvec3& start,
                                                 const glm::dvec3& step, DepthInterval range) noexcept {
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

/// Where a pixel's ray starts, and how it goes on per unit of view depth.
struct PixelRay {
  glm::dvec3 start, step;
};

[[nodiscard]] inline PixelRay pixel_ray(const Camera& camera, const CameraAxes& axes, const MeasureGrid& grid,
                                        int column, int row) noexcept {
  const double x = camera.left + (camera.right - camera.left) * (column + 0.5) / grid.columns;
  const double y = camera.bottom + (camera.top - camera.bottom) * (row + 0.5) / grid.rows;
  const glm::dvec3 image = axes.right * x + axes.up * y;
  if (camera.orthographic) return {camera.position + image, axes.forward};
  return {camera.position, axes.forward + image};
}

/// From where the ray enters the first box to where it leaves the last.
[[nodiscard]] inline DepthInterval depths_in_hull(std::span<const Box> boxes, const PixelRay& ray,
                                                  DepthInterval range) noexcept {
  DepthInterval hull{range.end, range.begin};
  for (const Box& box : boxes) {
    const DepthInterval part = depths_in_box(box, ray.start, ray.step, range);
    if (part.begin > part.end) continue;
    hull = {min_of(hull.begin, part.begin), max_of(hull.end, part.end)};
  }
  return hull;
}

[[nodiscard]] inline bool in_some_box(std::span<const Box> boxes, const PixelRay& ray, double depth,
                                      DepthInterval range) noexcept {
  for (const Box& box : boxes) {
    const DepthInterval part = depths_in_box(box, ray.start, ray.step, range);
    if (depth >= part.begin && depth <= part.end) return true;
  }
  return false;
}

/// Depths of a grid, a table at a time: their powers are taken once for all pixels.
inline constexpr int kTableDepths = 256;
struct DepthTable {
  std::array<double, kTableDepths> depth;
  int count;
};

[[nodiscard]] inline DepthTable depth_table(const Camera& camera, const MeasureGrid& grid,
                                            int begin) noexcept {
  DepthTable table;
  table.count = grid.depths - begin < kTableDepths ? grid.depths - begin : kTableDepths;
  const double n = camera.near_depth, f = camera.far_depth;
  for (int k = 0; k < table.count; ++k) {
    const double t = (begin + k + 0.5) / grid.depths;
    table.depth[static_cast<std::size_t>(k)] = n > 0.0 ? n * elementary::pow(f / n, t) : n + (f - n) * t;
  }
  return table;
}

/// Calls sample(point, view depth) for each point of the grid that lies in a receiver. Needs a finite far
/// plane.
template <typename Sample>
void for_each_visible(const Camera& camera, const CameraAxes& axes, std::span<const Box> receivers,
                      const MeasureGrid& grid, Sample&& sample) noexcept {
  const DepthInterval range{camera.near_depth, camera.far_depth};
  const bool one_box = receivers.size() == 1;
  for (int begin = 0; begin < grid.depths; begin += kTableDepths) {
    const DepthTable table = depth_table(camera, grid, begin);
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const PixelRay ray = pixel_ray(camera, axes, grid, column, row);
        const DepthInterval hull = depths_in_hull(receivers, ray, range);
        for (int k = 0; k < table.count; ++k) {
          const double depth = table.depth[static_cast<std::size_t>(k)];
          if (depth < hull.begin || depth > hull.end) continue;
          if (one_box || in_some_box(receivers, ray, depth, range))
            sample(ray.start + ray.step * depth, depth);
        }
      }
    }
  }
}

}  // namespace gnomon
