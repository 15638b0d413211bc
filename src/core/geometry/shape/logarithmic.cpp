// Rows of texels that a perspective warp makes shorter and shorter, made even again: in y, texels lie by the
// logarithm of the warp's w. Based on: Lloyd, Govindaraju, Quammen, Molnar, Manocha, "Logarithmic Perspective
// Shadow Maps", 2008, section 3: y' = c0 log(c1 y + 1).
#include <cmath>

#include "geometry/vector.hpp"
#include "gnomon/extend/shape.hpp"
#include "lanes/elementary.hpp"

// parameters[0]: logarithm of w at the far end of the square over w at its near end, below 0 where w grows
// the other way. With s the share of the square along y, 1 / w is linear in s and falls to exp(-L): the share
// of the texels is -ln(1 - c s) / L, c = 1 - exp(-L).
namespace gnomon::shapes {
namespace {

// Below this much the logarithm is a straight line but for a thousandth of the square, and single precision
// would divide rounding by rounding. The twin in GLSL draws the same line.
constexpr double kStraight = 1.0 / 128.0;

/// A share of one side, and its derivative over the other's.
struct Share {
  double at, slope;
};

double growth_of(const ShapeParameters& parameters) noexcept {
  const double growth = parameters[0];
  if (!(std::abs(growth) >= kStraight)) return 0.0;
  return max_of(-kMaxLogGrowth, min_of(growth, kMaxLogGrowth));
}

/// Of the texels, from that of the square. Beyond the square along the tangent: the curve itself ends where w
/// does.
Share texels_of(double growth, double square) noexcept {
  if (growth == 0.0) return {square, 1.0};
  const double c = -elementary::expm1(-growth), inside = max_of(0.0, min_of(square, 1.0));
  const double slope = c / (growth * (1.0 - c * inside));
  return {(square - inside) * slope - elementary::log1p(-c * inside) / growth, slope};
}

/// Of the square, from that of the texels.
double square_of(double growth, double texels) noexcept {
  if (growth == 0.0) return texels;
  const double c = -elementary::expm1(-growth), inside = max_of(0.0, min_of(texels, 1.0));
  const double square = -elementary::expm1(-growth * inside) / c;
  return square + (texels - inside) * (growth * (1.0 - c * square) / c);
}

ShapedPoint place(const ShapeParameters& parameters, const glm::dvec2& size, const glm::dvec2& ndc) noexcept {
  const Share y = texels_of(growth_of(parameters), ndc.y * 0.5 + 0.5);
  return {{(ndc.x * 0.5 + 0.5) * size.x, y.at * size.y}, {0.5 * size.x, 0.0, 0.0, 0.5 * size.y * y.slope}};
}

glm::dvec2 ndc_of(const ShapeParameters& parameters, const glm::dvec2& size,
                  const glm::dvec2& texel) noexcept {
  const glm::dvec2 share = texel / size;
  return glm::dvec2(share.x, square_of(growth_of(parameters), share.y)) * 2.0 - 1.0;
}

// Both axes are monotone: a rectangle's corners are its image's.
ShapeRectangle texel_bounds(const ShapeParameters& parameters, const glm::dvec2& size,
                            const ShapeRectangle& ndc) noexcept {
  return {place(parameters, size, ndc.low).texel, place(parameters, size, ndc.high).texel};
}

ShapeRectangle ndc_bounds(const ShapeParameters& parameters, const glm::dvec2& size,
                          const ShapeRectangle& texels) noexcept {
  return {ndc_of(parameters, size, texels.low), ndc_of(parameters, size, texels.high)};
}

ShapeParameters undoing(double log_growth) noexcept {
  return {growth_of({log_growth})};
}

ShapeParameters mirrored(const ShapeParameters& parameters, bool, bool y) noexcept {
  return {y ? -parameters[0] : parameters[0]};
}

}  // namespace

const Shape logarithmic{"logarithmic", "rows by the logarithm of the warp's w: even along the view",
                        false,         place,
                        ndc_of,        texel_bounds,
                        ndc_bounds,    undoing,
                        mirrored,      1};

}  // namespace gnomon::shapes
