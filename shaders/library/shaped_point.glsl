// A place in a map and how it moves: ShapedPoint of include/gnomon/extend/shape.hpp in GLSL, and how far that holds.
#ifndef GNOMON_LIBRARY_SHAPED_POINT_GLSL
#define GNOMON_LIBRARY_SHAPED_POINT_GLSL
struct ShapedPoint {
  vec2 texel;           // from the corner at ndc (-1, -1)
  mat2 texel_from_ndc;  // derivative: column 0 along ndc x, column 1 along ndc y
  vec4 ends;            // offsets, texels, beyond which texels have another length: xy below the place, zw above
  vec4 longer;          // of those texels over the place's own, less 1; 0: there is no such end
};

// A place of a shape whose texels change their lengths nowhere, or smoothly.
ShapedPoint smooth_point(vec2 texel, mat2 texel_from_ndc) { return ShapedPoint(texel, texel_from_ndc, vec4(0.0), vec4(0.0)); }
#endif
