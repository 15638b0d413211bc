// gnomon::shapes::rectilinear: columns and rows each as narrow as visible points need them (Rosen 2012).
#ifndef GNOMON_LIBRARY_SHAPE_RECTILINEAR_GLSL
#define GNOMON_LIBRARY_SHAPE_RECTILINEAR_GLSL
#include "library/shaped_point.glsl"

// Pieces of an axis, of as many texels each. As in C++.
const int kRectilinearPieces = 8;

// Where piece `i` of the axis begins, 0..1 without the margin.
float rectilinear_begin(mat4 shape, int axis, int i) {
  int at = axis * (kRectilinearPieces - 1) + i;
  float even = float(i) / float(kRectilinearPieces);
  return i == 0 || i == kRectilinearPieces ? even : even + shape[at / 4][at % 4];
}

// Share of the axis that is margin, at either end.
float rectilinear_margin(mat4 shape, float size) { return clamp(shape[3].w / size, 0.0, 0.49); }

// Share of the texels, and its derivative over the share of the square.
vec2 rectilinear_texels(mat4 shape, int axis, float size, float square) {
  float margin = rectilinear_margin(shape, size), inside = 1.0 - 2.0 * margin, at = (square - margin) / inside;
  if (!(at > 0.0 && at < 1.0)) return vec2(square, 1.0);
  int i = 0;
  float begin = 0.0, end = rectilinear_begin(shape, axis, 1);
  while (i + 1 < kRectilinearPieces && at >= end) {
    begin = end;
    end = rectilinear_begin(shape, axis, ++i + 1);
  }
  float slope = 1.0 / (float(kRectilinearPieces) * (end - begin));
  return vec2(margin + inside * (float(i) / float(kRectilinearPieces) + (at - begin) * slope), slope);
}

float rectilinear_square(mat4 shape, int axis, float size, float texels) {
  float margin = rectilinear_margin(shape, size), inside = 1.0 - 2.0 * margin, at = (texels - margin) / inside;
  if (!(at > 0.0 && at < 1.0)) return texels;
  int i = min(int(at * float(kRectilinearPieces)), kRectilinearPieces - 1);
  float begin = rectilinear_begin(shape, axis, i), end = rectilinear_begin(shape, axis, i + 1);
  return margin + inside * mix(begin, end, at * float(kRectilinearPieces) - float(i));
}

ShapedPoint place_rectilinear(mat4 shape, vec2 size, vec2 ndc) {
  vec2 x = rectilinear_texels(shape, 0, size.x, ndc.x * 0.5 + 0.5), y = rectilinear_texels(shape, 1, size.y, ndc.y * 0.5 + 0.5);
  return ShapedPoint(vec2(x.x, y.x) * size, mat2(0.5 * size.x * x.y, 0.0, 0.0, 0.5 * size.y * y.y));
}

vec2 ndc_of_rectilinear(mat4 shape, vec2 size, vec2 texel) {
  vec2 share = texel / size;
  return vec2(rectilinear_square(shape, 0, size.x, share.x), rectilinear_square(shape, 1, size.y, share.y)) * 2.0 - 1.0;
}
#endif
