// Texels of one size over the whole square: what a rasterizer does by itself.
#include "gnomon/extend/shape.hpp"

namespace gnomon::shapes {
namespace {

ShapedPoint place(const ShapeParameters&, const glm::dvec2& size, const glm::dvec2& ndc) noexcept {
  return {(ndc * 0.5 + 0.5) * size, {0.5 * size.x, 0.0, 0.0, 0.5 * size.y}};
}

glm::dvec2 ndc_of(const ShapeParameters&, const glm::dvec2& size, const glm::dvec2& texel) noexcept {
  return texel / size * 2.0 - 1.0;
}

ShapeRectangle texel_bounds(const ShapeParameters&, const glm::dvec2& size,
                            const ShapeRectangle& ndc) noexcept {
  return {(ndc.low * 0.5 + 0.5) * size, (ndc.high * 0.5 + 0.5) * size};
}

ShapeRectangle ndc_bounds(const ShapeParameters&, const glm::dvec2& size,
                          const ShapeRectangle& texels) noexcept {
  return {texels.low / size * 2.0 - 1.0, texels.high / size * 2.0 - 1.0};
}

ShapeParameters undoing(double) noexcept {
  return {};
}

ShapeParameters mirrored(const ShapeParameters& parameters, bool, bool) noexcept {
  return parameters;
}

}  // namespace

const Shape linear{"linear",     "texels of one size", true,    place,   ndc_of,
                   texel_bounds, ndc_bounds,           undoing, mirrored};

}  // namespace gnomon::shapes
