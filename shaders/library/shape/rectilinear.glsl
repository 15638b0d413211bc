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

// Length of the texels of piece `i` over that of linear ones, which the margins have on both sides.
float rectilinear_length(mat4 shape, int axis, int i) {
  if (i < 0 || i >= kRectilinearPieces) return 1.0;
  return float(kRectilinearPieces) * (rectilinear_begin(shape, axis, i + 1) - rectilinear_begin(shape, axis, i));
}

// One axis of a ShapedPoint.
struct RectilinearShare {
  float at, slope;    // share of the texels, and its derivative over the share of the square
  vec2 ends, longer;  // below and above
};

RectilinearShare rectilinear_texels(mat4 shape, int axis, float size, float square) {
  float margin = rectilinear_margin(shape, size), inside = 1.0 - 2.0 * margin, at = (square - margin) / inside;
  int i = at > 0.0 ? kRectilinearPieces : -1;
  RectilinearShare share;
  share.at = square;
  if (at > 0.0 && at < 1.0) {
    i = 0;
    while (i + 1 < kRectilinearPieces && at >= rectilinear_begin(shape, axis, i + 1)) ++i;
  }
  float own = rectilinear_length(shape, axis, i);
  share.slope = 1.0 / own;
  if (at > 0.0 && at < 1.0) {
    float within = (at - rectilinear_begin(shape, axis, i)) * share.slope;
    share.at = margin + inside * (float(i) / float(kRectilinearPieces) + within);
  }
  share.ends = (margin + inside * vec2(i, i + 1) / float(kRectilinearPieces) - share.at) * size;
  share.longer = vec2(rectilinear_length(shape, axis, i - 1), rectilinear_length(shape, axis, i + 1)) / own - 1.0;
  return share;
}

float rectilinear_square(mat4 shape, int axis, float size, float texels) {
  float margin = rectilinear_margin(shape, size), inside = 1.0 - 2.0 * margin, at = (texels - margin) / inside;
  if (!(at > 0.0 && at < 1.0)) return texels;
  int i = min(int(at * float(kRectilinearPieces)), kRectilinearPieces - 1);
  float begin = rectilinear_begin(shape, axis, i), end = rectilinear_begin(shape, axis, i + 1);
  return margin + inside * mix(begin, end, at * float(kRectilinearPieces) - float(i));
}

ShapedPoint place_rectilinear(mat4 shape, vec2 size, vec2 ndc) {
  RectilinearShare x = rectilinear_texels(shape, 0, size.x, ndc.x * 0.5 + 0.5);
  RectilinearShare y = rectilinear_texels(shape, 1, size.y, ndc.y * 0.5 + 0.5);
  return ShapedPoint(vec2(x.at, y.at) * size, mat2(0.5 * size.x * x.slope, 0.0, 0.0, 0.5 * size.y * y.slope),
                     vec4(x.ends, y.ends).xzyw, vec4(x.longer, y.longer).xzyw);
}

vec2 ndc_of_rectilinear(mat4 shape, vec2 size, vec2 texel) {
  vec2 share = texel / size;
  return vec2(rectilinear_square(shape, 0, size.x, share.x), rectilinear_square(shape, 1, size.y, share.y)) * 2.0 - 1.0;
}
#endif
