// How texels lie on the square that a map's matrix projects to: each shape of shapes.def by its place there.
#ifndef GNOMON_LIBRARY_SHAPE_GLSL
#define GNOMON_LIBRARY_SHAPE_GLSL
#include "library/shape/linear.glsl"

// `shape`: its place in shapes.def, then its parameters.
ShapedPoint shaped_point(vec4 shape, vec2 size, vec2 ndc) {
  return place_linear(shape.yzw, size, ndc);
}
#endif
