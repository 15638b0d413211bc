// What becomes of the last frame's map: what is it over this frame's body, where does a search go on from it,
// and how far may a map go in one frame towards where it is best?
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"
#include "map/light_body.hpp"

namespace gnomon {

/// A map of the light plane as a matrix over (x, y, 1) of the light frame.
struct Homography {
  glm::dvec3 a, b, w;  // rows
  [[nodiscard]] double weight(const WarpInput::Point& p) const noexcept {
    return w.x * p.x + w.y * p.y + w.z;
  }
  [[nodiscard]] double determinant() const noexcept { return glm::dot(a, glm::cross(b, w)); }
};
[[nodiscard]] Homography of_plane(const PlaneMap& plane) noexcept;
/// The homography of a matrix to OpenGL clip space from the world.
[[nodiscard]] Homography of_matrix(const PlanContext& c, const LightSpace& space,
                                   const glm::dmat4& gl_from_world) noexcept;

/// The homography over the body in the terms of a WarpChoice with centre 0: rows over the image, not yet of
/// unit length, and the constant that goes with each.
struct Decomposed {
  bool valid;
  WarpChoice choice;
  double u_min, length;
  double const_a, const_b;
};
/// The length of a row over the image.
[[nodiscard]] inline double length_of(const glm::dvec2& row) noexcept {
  return std::sqrt(glm::dot(row, row));
}

/// The body's extent along a unit vector of the light plane.
struct Span {
  double low, high;
};
[[nodiscard]] Span along(std::span<const WarpInput::Point> body, const glm::dvec2& axis) noexcept;

/// `flat_axis` serves where the map has no fall-off that could tell an axis.
[[nodiscard]] Decomposed decompose(const Homography& h, std::span<const WarpInput::Point> body,
                                   const glm::dvec2& flat_axis) noexcept;

/// A map of an earlier frame over this frame's body.
struct CachedPlane {
  bool usable;
  Decomposed map;  // its rectangle runs from -1 to 1
  PlaneMap plane;  // round the body, with rows of unit length
};
/// `flat_axis`: as for decompose.
[[nodiscard]] CachedPlane cached_plane(const Homography& h, const WarpQuestion& question,
                                       const glm::dvec2& flat_axis) noexcept;

/// The last frame's map with this frame's body in it, as it was fitted: the whole rectangle and its depths.
struct CachedMap {
  bool holds;
  PlaneMap plane;
  LightDepths depths;
};
[[nodiscard]] CachedMap cached_map(const PlanContext& c, const MapRequest& request,
                                   const LightBody& body) noexcept;

/// What the last frame found and drew, and what a search does with it. False where nothing is known.
[[nodiscard]] bool find_start(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                              WarpStart& start) noexcept;
/// Where the next frame's search may begin: at this frame's choice.
[[nodiscard]] PlanHistory::SearchedWarp searched_warp(const PlanContext& c, const MapRequest& request,
                                                      const PlaneMap& plane) noexcept;

/// True where the last frame has a map of this size for the same slot and light.
[[nodiscard]] bool has_cached(const MapRequest& request) noexcept;

/// Gives a map the last frame's bits where both differ by rounding alone. has_cached() must hold, under the
/// same light.
void keep_last_bits(const PlanContext& c, const MapRequest& request, MapResult& result) noexcept;

/// The best map, `best`, or one on the way there from the last frame's that keeps the change of texels per
/// area over the body small; reports an event where it cannot.
[[nodiscard]] PlaneMap steady_plane(const PlanContext& c, const MapRequest& request,
                                    const WarpQuestion& question, const PlaneMap& best,
                                    MapResult& result) noexcept;

/// 1 + kappa length of the strongest warp whose texels change smoothly as it moves along with the viewer:
/// they change with the third power of w. `length`: of the body along the warp's axis. Infinite where neither
/// moves.
[[nodiscard]] double smooth_stretch(const PlanContext& c, const WarpQuestion& question,
                                    double length) noexcept;

}  // namespace gnomon
