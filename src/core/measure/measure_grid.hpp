// The points at which errors are measured: a grid over the image, and along each pixel's ray depths inside
// the receivers. Between two depths lie flat receivers, and thin ones: there it is where the ray meets the
// nearest of them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "geometry/vector.hpp"
#include "gnomon/measure.hpp"
#include "lanes/elementary.hpp"
#include "lanes/lanes.hpp"

namespace gnomon {

/// Compilers divide before they choose: in place of 0 then, no quotient of coordinates is too large.
inline constexpr double kLeastDivisor = 1e-200;

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
    const double by = step[axis] + kLeastDivisor;
    const double a = (box.min[axis] - start[axis]) / by, b = (box.max[axis] - start[axis]) / by;
    range.begin = max_of(range.begin, min_of(a, b));
    range.end = min_of(range.end, max_of(a, b));
  }
  return range;
}

/// Where a pixel's ray starts, and how it goes on per unit of view depth.
struct PixelRay {
  glm::dvec3 start, step;
};

[[nodiscard]] inline PixelRay pixel_ray(const Camera& camera, const CameraAxes& axes,
                                        const MeasureOptions& grid, int column, int row) noexcept {
  const double x = camera.left + (camera.right - camera.left) * (column + 0.5) / grid.columns;
  const double y = camera.bottom + (camera.top - camera.bottom) * (row + 0.5) / grid.rows;
  const glm::dvec3 image = axes.right * x + axes.up * y;
  if (camera.orthographic) return {camera.position + image, axes.forward};
  return {camera.position, axes.forward + image};
}

/// Depths of a grid, a table at a time: their powers are taken once for all pixels.
inline constexpr int kTableDepths = 256;
struct DepthTable {
  std::array<double, kTableDepths> depth;
  int count;
};

[[nodiscard]] inline DepthTable depth_table(const Camera& camera, const MeasureOptions& grid,
                                            int begin) noexcept {
  DepthTable table;
  table.count = grid.depths - begin < kTableDepths ? grid.depths - begin : kTableDepths;
  const double n = camera.near_depth, f = camera.far_depth;
  for (int k = 0; k < table.count; ++k) {
    const double t = (begin + k + 0.5) / grid.depths;
    table.depth[static_cast<std::size_t>(k)] =
        n > 0.0 ? n * elementary::pow(f / divisor(n, kLeastDivisor), t) : n + (f - n) * t;
  }
  return table;
}

/// Whether no depth of the whole grid is in the interval, but for rounding.
[[nodiscard]] inline bool between_depths(const Camera& camera, const MeasureOptions& grid,
                                         DepthInterval part) noexcept {
  const double n = camera.near_depth, f = camera.far_depth;
  const auto place = [&](double depth) {
    const double t = n > 0.0 ? elementary::log(depth / n) / elementary::log(f / n) : (depth - n) / (f - n);
    return t * grid.depths - 0.5;
  };
  return std::ceil(place(part.begin)) > std::floor(place(part.end));
}

/// Which points of a piece of the grid, some rays one after the other along the rows, lie in a box: a bit
/// each.
class VisiblePiece {
 public:
  /// `thin`: finds boxes between two depths of the grid as well, at any depth.
  VisiblePiece(const Camera& camera, const CameraAxes& axes, const MeasureOptions& grid,
               const DepthTable& table, bool thin) noexcept;

  /// Takes the rays from number `first` on, at most `rays` of them, and finds their points in these boxes.
  /// Draws each box where it appears in the image, so that time grows with what the boxes cover.
  void find(const Boxes& boxes, std::int64_t first, std::int64_t rays) noexcept;
  /// Rays that fit.
  [[nodiscard]] std::int64_t capacity() const noexcept { return kWords / words_; }
  /// Which of 64 depths from 64 `at` on.
  [[nodiscard]] std::uint64_t held(std::int64_t ray, int at) const noexcept {
    return bits_[word(ray, 64 * at)];
  }

  /// Where the ray enters the nearest box that it passes between two depths; infinite: none.
  [[nodiscard]] double thin(std::int64_t ray) const noexcept {
    return thin_[static_cast<std::size_t>(ray - first_)];
  }

  void mark(const Box& box) noexcept;

 private:
  /// Where a box may be met: columns, rows and depths of the table, first and last. A superset.
  struct Footprint {
    int column[2], row[2], depth[2];
  };
  /// False where no ray of the piece meets the box at any depth of the table, or of the view with thin boxes.
  [[nodiscard]] bool footprint(const Box& box, Footprint& out) const noexcept;

  static constexpr std::int64_t kWords = 384;  // 6 KiB with the thin boxes: the default grid in eleven pieces
  [[nodiscard]] std::size_t word(std::int64_t ray, int depth) const noexcept {
    return static_cast<std::size_t>((ray - first_) * words_ + depth / 64);
  }
  /// False where no depth of the table is in that part.
  bool mark(std::int64_t ray, DepthInterval part, const Footprint& where) noexcept;

  const Camera& camera_;
  const CameraAxes& axes_;
  const MeasureOptions& grid_;
  const DepthTable& table_;
  int words_;
  bool with_thin_;
  std::int64_t first_ = 0, end_ = 0;
  std::array<std::uint64_t, kWords> bits_;
  std::array<double, kWords> thin_;  // of each ray
};

/// Calls sample(point, view depth) for each point of the grid that lies in a receiver. Needs a finite far
/// plane.
template <typename Sample>
void for_each_visible(const Camera& camera, const CameraAxes& axes, const Boxes& receivers,
                      const MeasureOptions& grid, Sample&& sample) noexcept {
  if (grid.columns <= 0 || grid.rows <= 0) return;
  const std::int64_t rays = std::int64_t{grid.columns} * grid.rows;
  for (int begin = 0; begin < grid.depths; begin += kTableDepths) {
    const DepthTable table = depth_table(camera, grid, begin);
    VisiblePiece piece(camera, axes, grid, table, begin == 0);
    for (std::int64_t first = 0; first < rays; first += piece.capacity()) {
      const std::int64_t end = std::min(first + piece.capacity(), rays);
      piece.find(receivers, first, end - first);
      for (std::int64_t i = first; i < end; ++i) {
        const PixelRay ray = pixel_ray(camera, axes, grid, static_cast<int>(i % grid.columns),
                                       static_cast<int>(i / grid.columns));
        for (int at = 0; 64 * at < table.count; ++at) {
          for (std::uint64_t left = piece.held(i, at); left != 0; left &= left - 1) {
            const double depth = table.depth[static_cast<std::size_t>(64 * at + std::countr_zero(left))];
            sample(ray.start + ray.step * depth, depth);
          }
        }
        if (const double depth = piece.thin(i); depth < camera.far_depth)
          sample(ray.start + ray.step * depth, depth);
      }
    }
  }
}

}  // namespace gnomon
