// How texels lie on the square that a map's matrix projects to: each shape of shapes.def by its place there.
#ifndef GNOMON_LIBRARY_SHAPE_GLSL
#define GNOMON_LIBRARY_SHAPE_GLSL
// The includer may define GNOMON_SHAPES 0 where every map is linear: software renderers run all branches for every pixel.
#ifndef GNOMON_SHAPES
#define GNOMON_SHAPES 1
#endif
#include "library/shape/linear.glsl"
#include "library/shape/logarithmic.glsl"
#include "library/shape/rectilinear.glsl"
#include "library/shape/paraboloid.glsl"

// `shape`: its place in shapes.def, then its parameters, column by column.
ShapedPoint shaped_point(mat4 shape, vec2 size, vec2 ndc) {
#if GNOMON_SHAPES
  if (shape[0].x == 1.0) return place_logarithmic(shape, size, ndc);
  if (shape[0].x == 2.0) return place_rectilinear(shape, size, ndc);
  if (shape[0].x == 3.0) return place_paraboloid(shape, size, ndc);
#endif
  return place_linear(size, ndc);
}

// The inverse: the place in ndc that lies at a place in the map.
vec2 ndc_of_texel(mat4 shape, vec2 size, vec2 texel) {
  if (shape[0].x == 1.0) return ndc_of_logarithmic(shape, size, texel);
  if (shape[0].x == 2.0) return ndc_of_rectilinear(shape, size, texel);
  if (shape[0].x == 3.0) return ndc_of_paraboloid(shape, size, texel);
  return ndc_of_linear(size, texel);
}

// True where rows of texels are rows of ndc, whatever the column.
bool rows_stay_rows(mat4 shape) { return shape[0].x != 3.0; }

// The texels round the image of a rectangle of ndc: xy the lowest, zw the highest.
vec4 texel_bounds(mat4 shape, vec2 size, vec2 low, vec2 high) {
  if (shape[0].x == 3.0) return texel_bounds_paraboloid(shape, size, low, high);
  return vec4(shaped_point(shape, size, low).texel, shaped_point(shape, size, high).texel);
}
#endif
