// The shape: how texels lie on the square that a map's matrix projects to. Metric, bias, culling and look-up
// call it, so that nothing else knows shapes.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat2x2.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "gnomon/options.hpp"
#include "gnomon/shadow_map.hpp"

namespace gnomon {

/// Strips that TexelNeeds has along either axis.
inline constexpr std::size_t kNeedStrips = 64;

/// Where along both axes of a map its receivers that are seen need short texels.
struct TexelNeeds {
  /// Over equal strips of the map without its margin, from ndc -1 on. The longest that a texel of one size is
  /// there along the axis, pixels or any other unit; 0: nothing is seen there.
  std::array<double, kNeedStrips> x{}, y{};
  int margin_texels = 0;  ///< along each side; its texels keep their size
};

/// A shape that was set by TexelNeeds.
struct ServingShape {
  ShapeParameters parameters{};  ///< of the shape
  glm::dvec2 left{1.0};  ///< the largest need along x and y over the largest with linear texels, 1 or below
  glm::dvec2 longest{1.0};  ///< the longest texel anywhere along x and y over a linear one, 1 or above
};

/// A place in a map, and how it moves with the point in normalized device coordinates.
struct ShapedPoint {
  glm::dvec2 texel;           ///< texels, from the corner at ndc (-1, -1)
  glm::dmat2 texel_from_ndc;  ///< derivative: column 0 along ndc x, column 1 along ndc y
};

/// A rectangle along the axes, of ndc or of texels.
struct ShapeRectangle {
  glm::dvec2 low, high;  ///< corners
};

/// A shape that was fitted to a local light's rays.
struct RoundShape {
  ShapeParameters parameters{};  ///< of the shape
  ShapeRectangle slopes;         ///< that the square -1..1 has to show, margin included
  glm::dvec2 longest{1.0};       ///< bound of texels along x and y over those of even slopes
};

/// Logarithm of the largest growth of w that a shape undoes. Beyond it, places near the far end are rounding
/// in single precision: a texel of 1024 per 2^-24 of ndc.
inline constexpr double kMaxLogGrowth = 9.0;

/// Parameters of the same texels in another clip space, whose axes point the same or the opposite way.
[[nodiscard]] ShapeParameters parameters_in(const glm::dmat4& other_from_this, const Shape& shape,
                                            const ShapeParameters& parameters) noexcept;

/// The texels of one map: how many there are and how they lie.
struct TexelGrid {
  int width = 0, height = 0;             ///< texels
  const Shape* shape = &shapes::linear;  ///< never nullptr
  ShapeParameters parameters{};          ///< of the shape

  /// Width and height, texels.
  [[nodiscard]] glm::dvec2 size() const noexcept { return {width, height}; }
  /// Where a place in ndc lies in the map.
  [[nodiscard]] ShapedPoint place(const glm::dvec2& ndc) const noexcept {
    return shape->place(parameters, size(), ndc);
  }
  /// Where in ndc a place in the map lies.
  [[nodiscard]] glm::dvec2 ndc_of(const glm::dvec2& texel) const noexcept {
    return shape->ndc_of(parameters, size(), texel);
  }
};

inline TexelGrid ShadowMap::texels() const noexcept {
  return {width, height, shape, shape_parameters};
}

}  // namespace gnomon
