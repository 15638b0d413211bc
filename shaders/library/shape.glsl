// How texels lie on the square that a map's matrix projects to: each shape of shapes.def by its place there.
#ifndef GNOMON_LIBRARY_SHAPE_GLSL
#define GNOMON_LIBRARY_SHAPE_GLSL
#include "library/shape/linear.glsl"
#include "library/shape/logarithmic.glsl"

// `shape`: its place in shapes.def, then its parameters.
ShapedPoint shaped_point(vec4 shape, vec2 size, vec2 ndc) {
  if (shape.x == 1.0) return place_logarithmic(shape.yzw, size, ndc);
  return place_linear(shape.yzw, size, ndc);
}

// The inverse: the place in ndc that lies at a place in the map.
vec2 ndc_of_texel(vec4 shape, vec2 size, vec2 texel) {
  if (shape.x == 1.0) return ndc_of_logarithmic(shape.yzw, size, texel);
  return ndc_of_linear(shape.yzw, size, texel);
}
#endif
