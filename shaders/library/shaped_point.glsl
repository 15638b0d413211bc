// A place in a map and how it moves: ShapedPoint of include/gnomon/extend/shape.hpp in GLSL.
#ifndef GNOMON_LIBRARY_SHAPED_POINT_GLSL
#define GNOMON_LIBRARY_SHAPED_POINT_GLSL
struct ShapedPoint {
  vec2 texel;           // from the corner at ndc (-1, -1)
  mat2 texel_from_ndc;  // derivative: column 0 along ndc x, column 1 along ndc y
};
#endif
