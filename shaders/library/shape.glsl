// How texels lie on the square that a map's matrix projects to: each shape of shapes.def by its place there.
#ifndef GNOMON_LIBRARY_SHAPE_GLSL
#define GNOMON_LIBRARY_SHAPE_GLSL
#include "library/shape/linear.glsl"
#include "library/shape/logarithmic.glsl"
#include "library/shape/rectilinear.glsl"

// `shape`: its place in shapes.def, then its parameters, column by column.
ShapedPoint shaped_point(mat4 shape, vec2 size, vec2 ndc) {
  if (shape[0].x == 1.0) return place_logarithmic(shape, size, ndc);
  if (shape[0].x == 2.0) return place_rectilinear(shape, size, ndc);
  return place_linear(size, ndc);
}

// The inverse: the place in ndc that lies at a place in the map.
vec2 ndc_of_texel(mat4 shape, vec2 size, vec2 texel) {
  if (shape[0].x == 1.0) return ndc_of_logarithmic(shape, size, texel);
  if (shape[0].x == 2.0) return ndc_of_rectilinear(shape, size, texel);
  return ndc_of_linear(size, texel);
}
#endif
