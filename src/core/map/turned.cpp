// Which way to turn a rectangle so that it is the smallest round some points.
// Based on: Freeman, Shapira, "Determining the Minimum-Area Encasing Rectangle for an Arbitrary Closed
// Curve", 1975: one side lies on an edge of the convex hull. The hull is Andrew's monotone chain, 1979.
#include "map/turned.hpp"
#include "gnomon/extend/warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "gnomon/extend/body.hpp"
#include "map/gain.hpp"
#include "warp/plane_error.hpp"

namespace gnomon {
namespace {

using Points = std::array<glm::dvec2, kMaxVertices>;

double cross(const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b) noexcept {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Half of the hull of sorted points: those that turn left all the way.
std::size_t chain(std::span<const glm::dvec2> sorted, Points& out) noexcept {
  std::size_t count = 0;
  for (const glm::dvec2& p : sorted) {
    while (count > 1 && cross(out[count - 2], out[count - 1], p) <= 0.0) --count;
    out[count++] = p;
  }
  return count;
}

double area_along(std::span<const glm::dvec2> points, const glm::dvec2& side) noexcept {
  double low_a = std::numeric_limits<double>::infinity(), high_a = -low_a, low_b = low_a, high_b = -low_a;
  for (const glm::dvec2& p : points) {
    const double a = p.x * side.x + p.y * side.y, b = p.y * side.x - p.x * side.y;
    low_a = min_of(low_a, a);
    high_a = max_of(high_a, a);
    low_b = min_of(low_b, b);
    high_b = max_of(high_b, b);
  }
  return (high_a - low_a) * (high_b - low_b);
}

/// Whether the turned map lowers the objective. Out of line: the hull need not make room for the samples.
[[gnu::noinline]] bool turning_pays(const WarpInput& in, const WarpChoice& turned,
                                    const WarpChoice& choice) noexcept {
  const PlaneError error(in);
  return error.value(turned) < error.value(choice) * (1.0 - kLeastWarpGain);
}

/// The side of the least rectangle round the body's image.
[[gnu::noinline]] glm::dvec2 least_side(const WarpInput& in, const WarpChoice& choice) noexcept {
  const PlaneMap map = plane_map(in.body, choice);
  std::array<glm::dvec2, kMaxBodyPoints> image;
  std::size_t count = 0;
  for (const WarpInput::Point& p : in.body) image[count++] = map.image(p.x, p.y);
  return least_rectangle_side({image.data(), count});
}

}  // namespace

glm::dvec2 least_rectangle_side(std::span<const glm::dvec2> points) noexcept {
  Points sorted, half;
  const std::size_t count = std::min(points.size(), sorted.size());
  if (count == 0) return {1.0, 0.0};
  std::copy_n(points.begin(), count, sorted.begin());
  const auto by_x = [](const glm::dvec2& a, const glm::dvec2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count), by_x);
  // What a turn must save: less would come and go with the last bits of the input.
  constexpr double kLeastGain = 1e-9;
  glm::dvec2 best{1.0, 0.0};
  double least = area_along({sorted.data(), count}, best);
  for (int lower = 0; lower < 2; ++lower) {
    const std::size_t on_chain = chain({sorted.data(), count}, half);
    for (std::size_t i = 0; i + 1 < on_chain; ++i) {
      const glm::dvec2 edge = half[i + 1] - half[i];
      const double length = std::sqrt(edge.x * edge.x + edge.y * edge.y);
      if (!(length > 0.0)) continue;
      const glm::dvec2 side = edge / length;
      const double area = area_along({sorted.data(), count}, side);
      if (!(area < least * (1.0 - kLeastGain))) continue;
      least = area;
      best = side;
    }
    std::reverse(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
  }
  // The side of the rectangle that is nearest to x: a mirrored body gets the mirrored rectangle.
  if (std::abs(best.y) > std::abs(best.x)) best = {best.y, -best.x};
  return best.x < 0.0 ? -best : best;
}

WarpChoice turned_to_least_area(const WarpInput& in, const WarpChoice& choice) noexcept {
  const glm::dvec2 side = least_side(in, choice);
  WarpChoice turned = choice;
  turned.row_a = side;
  turned.row_b = {-side.y, side.x};
  // What the warp has measured is of its own rectangle.
  turned.gain_ratio = turned.last_ratio = 0.0;
  // Without perspective the area is the objective.
  if (in.flat()) return turned;
  return turning_pays(in, turned, choice) ? turned : choice;
}

}  // namespace gnomon
