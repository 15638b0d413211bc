// What do the rays of a fan through the image meet, as far as boxes tell: the nearest, and all on their way?
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "geometry/even_points.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/view.hpp"

namespace gnomon {

/// Points that stand for what a camera sees, relative to it: each for an equal share of the image.
struct SeenPoints {
  static constexpr std::size_t kMost = 128;
  static constexpr std::size_t kFewest = 6;  // fewer are no picture: all may be seen
  std::array<glm::dvec3, kMost> point;
  std::size_t count = 0;
  [[nodiscard]] std::span<const glm::dvec3> points() const noexcept { return {point.data(), count}; }
};

/// A point on each ray of a fixed fan that meets a box between the near and the far plane: anywhere between
/// both sides of one of the first six boxes, but no nearer than half the view depth of the farther side. The
/// same ones in any order of the boxes.
[[nodiscard]] SeenPoints first_hits(const Camera& camera, const CameraAxes& axes,
                                    const Boxes& boxes) noexcept;

/// Where on each ray of the fan boxes are: cells of view depth, a bit each, even in its logarithm.
struct HeldDepths {
  static constexpr std::size_t kRays = 112;
  static constexpr int kCells = 64;
  std::array<std::uint64_t, kRays> cells{};  // of ray (even_x, even_y); the nearest is the lowest bit
  double first, step, per_step;              // log2_of the nearest depth, and from cell to cell

  /// Between these view depths, both positive.
  HeldDepths(double nearest, double farthest) noexcept : first(log2_of(nearest)) {
    constexpr double kLeastStep = 1e-5;  // places of all doubles' depths fit an int
    step = (log2_of(farthest) - first) / kCells;
    step = step > kLeastStep ? step : kLeastStep;
    per_step = 1.0 / step;
  }

  /// The binary logarithm to a hundredth, of a normal positive number: much quicker than a good one.
  [[nodiscard]] static double log2_of(double x) noexcept {
    constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1, kOne = std::uint64_t{1023} << 52;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const auto m = std::bit_cast<double>((bits & kMantissa) | kOne);
    return static_cast<double>(static_cast<int>(bits >> 52) - 1023) + ((2.0 - m / 3.0) * m - 5.0 / 3.0);
  }
  /// How far into its cell a ray's depth is: between 0 and 1, another on every ray.
  [[nodiscard]] static constexpr double into_cell(std::size_t ray) noexcept {
    return spread(0.3819660112501051, static_cast<double>(ray));
  }
  /// The ray's cells whose depths are between two, from `first` to `last`; none where last < first.
  struct Range {
    int first, last;
    [[nodiscard]] std::uint64_t bits() const noexcept {
      return first > last ? 0 : ~std::uint64_t{0} >> (kCells - 1 - (last - first)) << first;
    }
  };
  [[nodiscard]] Range between(std::size_t ray, double begin, double end) const noexcept;
};

/// Where any box is, between the near and the far plane and no nearer than `nearest`. A box between two of a
/// ray's depths holds the nearer one. The same in any order of the boxes.
[[nodiscard]] HeldDepths held_depths(const Camera& camera, const CameraAxes& axes, const Boxes& boxes,
                                     double nearest) noexcept;

/// Copies those of `points`, no more than fit, which are inside `body` or off it by no more than this share
/// of their coordinates. Returns how many.
std::size_t points_inside(const Polytope& body, std::span<const glm::dvec3> points, double touching,
                          std::array<glm::dvec3, SeenPoints::kMost>& inside) noexcept;

/// Evenly chosen ones of the view's points that are in view and, as far as normals tell, not turned from the
/// light. `light_world`: as ShadowMap::light_world.
[[nodiscard]] SeenPoints some_of(const View& view, const CameraAxes& axes,
                                 const glm::dvec4& light_world) noexcept;

}  // namespace gnomon
