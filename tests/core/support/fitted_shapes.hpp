// What shapes are fitted to, to try them with: growths of w, needs of visible points, slopes of a local
// light's rays.
#pragma once

#include <cmath>
#include <vector>

#include "gnomon/extend/shape.hpp"

namespace gnomon::test {

/// Largest at one place of each axis, 0..1.
inline TexelNeeds needs_round(double x, double y, int margin_texels) {
  TexelNeeds needs;
  needs.margin_texels = margin_texels;
  for (std::size_t i = 0; i < kNeedStrips; ++i) {
    const double at = (static_cast<double>(i) + 0.5) / kNeedStrips;
    needs.x[i] = 1.0 / (0.05 + std::abs(at - x));
    needs.y[i] = 1.0 / (0.02 + std::abs(at - y));
  }
  return needs;
}

/// Off the axis, across it, narrow, and wider than a cube's face.
inline std::vector<ShapeRectangle> rectangles_of_slopes() {
  return {{{-1.0, -1.0}, {1.0, 1.0}},
          {{-2.9, -2.9}, {2.9, 1.5}},
          {{0.2, -0.7}, {0.9, -0.1}},
          {{-1e-3, 0.5}, {1e-3, 0.501}}};
}

/// Parameters of a shape under all that it can be fitted to. `size`: of the map, texels.
inline std::vector<ShapeParameters> fitted_parameters(const Shape& shape, const glm::dvec2& size) {
  std::vector<ShapeParameters> all{{}};
  for (const double growth : {0.1, 2.0, -3.0, 5.0}) all.push_back(shape.undoing(growth));
  if (shape.serving != nullptr) {
    for (const double place : {0.0, 0.3, 0.95})
      all.push_back(shape.serving(needs_round(place, 1.0 - place, 9)).parameters);
  }
  if (shape.round != nullptr) {
    for (const ShapeRectangle& slopes : rectangles_of_slopes()) {
      all.push_back(shape.round(slopes, size, 0).parameters);
      all.push_back(shape.round(slopes, size, 9).parameters);
    }
  }
  return all;
}

}  // namespace gnomon::test
