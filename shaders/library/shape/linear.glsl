// gnomon::shapes::linear: texels of one size over the whole square.
#ifndef GNOMON_LIBRARY_SHAPE_LINEAR_GLSL
#define GNOMON_LIBRARY_SHAPE_LINEAR_GLSL
#include "library/shaped_point.glsl"

ShapedPoint place_linear(vec2 size, vec2 ndc) {
  return smooth_point((ndc * 0.5 + 0.5) * size, mat2(0.5 * size.x, 0.0, 0.0, 0.5 * size.y));
}

vec2 ndc_of_linear(vec2 size, vec2 texel) { return texel / size * 2.0 - 1.0; }
#endif
