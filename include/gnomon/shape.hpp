// The shape: how texels lie on the square that a map's matrix projects to. Metric, bias, culling and look-up
// call it, so that nothing else knows shapes.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat2x2.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>

namespace gnomon {

/// Numbers that a shape is set by; what they mean is the shape's own. All 0: linear texels. At most fifteen,
/// so that shaders get them in one matrix, behind the shape's place in shapes.def.
using ShapeParameters = std::array<double, 15>;

/// Strips that TexelNeeds has along either axis.
inline constexpr std::size_t kNeedStrips = 64;

/// Where along both axes of a map its receivers that are seen need short texels.
struct TexelNeeds {
  /// Over equal strips of the map without its margin, from ndc -1 on: the longest that a texel of one size is
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

/// One entry of the registry shapes.def. `size`: width and height of the map in texels. Either texel
/// coordinate grows with the ndc coordinate of the same name. Every function takes any finite place; off the
/// square -1..1 the shape goes on as its formula does, or along its tangent where the formula ends.
struct Shape {
  std::string_view name;     ///< as in files
  std::string_view summary;  ///< one line
  /// True where the derivative is the same everywhere: straight lines stay straight, so that triangles are
  /// drawn as they are, and a map may be scrolled.
  bool affine;
  /// Where a place in ndc lies in the map.
  ShapedPoint (*place)(const ShapeParameters& parameters, const glm::dvec2& size,
                       const glm::dvec2& ndc) noexcept;
  /// The inverse: which place in ndc lies at a place in the map.
  glm::dvec2 (*ndc_of)(const ShapeParameters& parameters, const glm::dvec2& size,
                       const glm::dvec2& texel) noexcept;
  /// The smallest rectangle of texels round the image of a rectangle of ndc.
  ShapeRectangle (*texel_bounds)(const ShapeParameters& parameters, const glm::dvec2& size,
                                 const ShapeRectangle& ndc) noexcept;
  /// The smallest rectangle of ndc whose image holds a rectangle of texels.
  ShapeRectangle (*ndc_bounds)(const ShapeParameters& parameters, const glm::dvec2& size,
                               const ShapeRectangle& texels) noexcept;
  /// Parameters under which rows of texels undo the warp of a map whose w grows by exp(log_growth) from ndc y
  /// -1 to 1. Any value; beyond kMostLogGrowth and where it is not a number the shape goes as far as it can.
  ShapeParameters (*undoing)(double log_growth) noexcept;
  /// Parameters of the same shape seen in a mirror: over ndc x (`x`), ndc y (`y`) of the other sign.
  ShapeParameters (*mirrored)(const ShapeParameters& parameters, bool x, bool y) noexcept;
  /// How many of the parameters it has; the others are 0.
  int parameter_count = 0;
  /// Parameters under which the largest of the needs is as small as it gets; nullptr for shapes that do not
  /// follow visible points. Needs without a number above 0 give linear texels.
  ServingShape (*serving)(const TexelNeeds& needs) noexcept = nullptr;
  /// Parameters for a local light's rays; nullptr for shapes that do not follow them. `slopes`: those off the
  /// light's axis that receivers have, none empty; `size`: of the map, texels, more than two margins.
  RoundShape (*round)(const ShapeRectangle& slopes, const glm::dvec2& size,
                      int margin_texels) noexcept = nullptr;
};

/// Logarithm of the largest growth of w that a shape undoes. Beyond it, places near the far end are rounding
/// in single precision: a texel of 1024 per 2^-24 of ndc.
inline constexpr double kMostLogGrowth = 9.0;

/// Parameters of the same texels in another clip space, whose axes point the same or the opposite way.
[[nodiscard]] ShapeParameters parameters_in(const glm::dmat4& other_from_this, const Shape& shape,
                                            const ShapeParameters& parameters) noexcept;
/// All shapes, in the order of shapes.def.
[[nodiscard]] std::span<const Shape* const> all_shapes() noexcept;
/// nullptr where there is none of that name.
[[nodiscard]] const Shape* find_shape(std::string_view name) noexcept;

namespace shapes {
#define GNOMON_SHAPE(name) extern const Shape name;
#include "gnomon/shapes.def"
#undef GNOMON_SHAPE
}  // namespace shapes

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

}  // namespace gnomon
