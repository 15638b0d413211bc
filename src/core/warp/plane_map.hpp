// From a warp's strength and a rectangle to the map's matrix, and what the body needs of that map.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <span>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"

namespace gnomon {

/// Points of a body as warps see it: its vertices, or eight corners of each of eight views and of what does
/// not count.
inline constexpr int kMaxBodyPoints = 72;
static_assert(kMaxBodyPoints >= kMaxVertices);

/// How far a body's points go.
struct PointBounds {
  double x_min, x_max, y_min, y_max, z_min, z_max;
  double distance;  ///< the largest of their coordinates, without sign
};
/// Of one point or more.
[[nodiscard]] PointBounds bounds_of(std::span<const WarpInput::Point> body) noexcept;

/// A warp's map of the light plane with the rectangle round the body's image, before the border that filters
/// need.
struct PlaneMap {
  WarpChoice choice;
  double u_min, length;               ///< of the body along the axis
  double stretch;                     ///< 1 + kappa length: the image is as long as the body
  double a_min, a_max, b_min, b_max;  ///< rectangle in the turned image
  /// Of a point of the light plane.
  [[nodiscard]] double w(double x, double y) const noexcept {
    return 1.0 + choice.kappa * (x * choice.axis.x + y * choice.axis.y - u_min);
  }
  /// The image (X, Y) of a point of the light plane, before it is turned.
  [[nodiscard]] glm::dvec2 image(double x, double y) const noexcept {
    const double inverse = 1.0 / w(x, y);
    return {(x * choice.axis.y - y * choice.axis.x - choice.centre) * inverse,
            (x * choice.axis.x + y * choice.axis.y - u_min) * stretch * inverse};
  }
};

/// What a side of the rectangle is widened to where it is shorter. `extent`: the largest of the body's in its
/// image and in height; `distance`: the largest of its coordinates.
[[nodiscard]] double least_extent(double extent, double distance) noexcept;
/// Moves both ends apart to `least` where they are nearer.
void widen(double& low, double& high, double least) noexcept;
/// Moves each side of the rectangle out by this share of the rectangle.
void grow(PlaneMap& map, double share) noexcept;

/// How far a border of this share of both sides reaches in the image: farther than the sides are long where
/// the rows are not at a right angle.
[[nodiscard]] double border_in_image(const PlaneMap& map, double border) noexcept;

/// The smallest rectangle that holds the body's image. Flat and single-point bodies get an extent of 1e-6 of
/// the largest one.
[[nodiscard]] PlaneMap plane_map(std::span<const WarpInput::Point> body, const WarpChoice& choice) noexcept;
/// The same, of points whose bounds are known.
[[nodiscard]] PlaneMap plane_map(std::span<const WarpInput::Point> body, const PointBounds& bounds,
                                 const WarpChoice& choice) noexcept;

/// Depths along the light in the light frame: from `bottom` upwards, with (z - bottom) / w between 0 and
/// `height`.
struct LightDepths {
  double bottom, height;
};

/// OpenGL clip space from the light frame. The rectangle fills the map but for `border` of it on each side,
/// along the map's x and y (0 <= border < 0.5); depth grows away from the light.
[[nodiscard]] glm::dmat4 clip_from_light(const PlaneMap& map, const LightDepths& depths,
                                         const glm::dvec2& border) noexcept;
[[nodiscard]] inline glm::dmat4 clip_from_light(const PlaneMap& map, const LightDepths& depths,
                                                double border) noexcept {
  return clip_from_light(map, depths, glm::dvec2(border));
}

/// kappa times the body's distance beyond which w over the body is the rounding of positions.
inline constexpr double kMaxKappaDistance = 1e14;

/// False for a choice that no map can be made with: too strong for float matrices or, beyond `most_stretch`,
/// for the map's border, or with its axis along a body whose length that way is rounding.
[[nodiscard]] bool usable(std::span<const WarpInput::Point> body, const WarpChoice& choice,
                          double most_stretch) noexcept;
/// The same, of points whose bounds and map are known.
[[nodiscard]] bool usable(std::span<const WarpInput::Point> body, const PointBounds& bounds,
                          const PlaneMap& map, double most_stretch) noexcept;

/// Weakens a choice, whose map is `map`, to `most_stretch`. False where it is no stronger.
bool weaken(WarpChoice& choice, const PlaneMap& map, double most_stretch) noexcept;

/// Texels inside the border under which an error over the body is 1: bounds of m_s along the map's width, of
/// m_t along its height (at the body's vertices, with the simplified weights of Lloyd et al. 2006), and of
/// the longest extent that any texel has in any direction, in units where the rectangle is one texel.
struct TexelsNeeded {
  glm::dvec2 sides{0.0};
  struct Vertex {
    glm::dvec2 a, b;  ///< extents of the rectangle's sides at the vertex, as multiples of a pixel there
  };
  std::array<Vertex, kMaxBodyPoints> vertex;
  int count = 0;
  /// Bound of the perspective part of m over the body, in any direction, for a map with so many texels inside
  /// its border. `obliquity`: as of pixel_obliquity.
  [[nodiscard]] double bound(const glm::dvec2& inside, double obliquity) const noexcept;
};
/// `pixels_per_slope`: pixels per unit of the image's finer axis.
void texels_needed(std::span<const WarpInput::Point> body, const PlaneMap& plane, double pixels_per_slope,
                   TexelsNeeded& needed) noexcept;

/// How far a step of one unit of the light plane moves a point in the map, at most over the body, as a share
/// of the rectangle's side.
[[nodiscard]] double share_per_unit(const PlaneMap& map, std::span<const WarpInput::Point> body) noexcept;

}  // namespace gnomon
