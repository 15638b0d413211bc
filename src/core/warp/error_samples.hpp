// The points of a body at which a warp's error is measured, and what a pixel covers there.
#pragma once

#include <array>
#include <cstddef>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "lanes/lanes.hpp"

namespace gnomon {

/// Points of the light plane, and d(light plane)/d(pixel) there on a surface that faces the half vector.
struct PixelLanes {
  static constexpr std::size_t kMost = 192;
  static_assert(kMost % kDoubleLanes == 0 && kMost >= whole_lanes(2 * kMaxVertices));
  alignas(64) std::array<double, kMost> x, y, xx, xy, yx, yy, inverse_determinant;
  std::size_t count = 0;

  // Before find_pixels, x and y are the point's along the light frame's axes, and z is the third; the pixel
  // there counts as `size` times as wide as it is. Both lie where find_pixels writes.
  [[nodiscard]] std::array<double, kMost>& z() noexcept { return xx; }
  [[nodiscard]] std::array<double, kMost>& size() noexcept { return xy; }

  void add(const glm::dvec3& point, double times) noexcept {
    if (count == kMost) return;
    x[count] = point.x;
    y[count] = point.y;
    z()[count] = point.z;
    size()[count++] = times;
  }
  /// Copies of the first fill the last lanes.
  void fill_lanes() noexcept;
};

void add_vertices(const Polytope& body, double size, PixelLanes& lanes) noexcept;
/// The middles of edges.
void add_middles(const Polytope& body, double size, PixelLanes& lanes) noexcept;
/// The middles of faces.
void add_faces(const Polytope& body, double size, PixelLanes& lanes) noexcept;
/// Sets of points that have none in common. The first is the smallest: a search goes by it.
inline constexpr int kRaySets = 6;
/// A further set: where the rays' parts in boxes begin and end; without boxes, or with few rays, none.
inline constexpr int kRayEnds = kRaySets;
/// Points spread evenly over the pixels that show the body, and over the logarithm of depth: of boxes in it,
/// where those are known. `set`: up to kRayEnds.
void add_visible_points(const WarpInput& input, int set, PixelLanes& lanes) noexcept;

/// Points of surfaces that are seen.
void add_seen_points(const WarpInput& input, PixelLanes& lanes) noexcept;

/// From points to pixels, dropping those where nothing is known of a pixel. Returns how many are in front of
/// the first that was dropped.
std::size_t find_pixels(const WarpInput& input, PixelLanes& lanes) noexcept;

}  // namespace gnomon
