// gnomon::shapes::logarithmic: rows by the logarithm of the warp's w (Lloyd et al. 2008).
#ifndef GNOMON_LIBRARY_SHAPE_LOGARITHMIC_GLSL
#define GNOMON_LIBRARY_SHAPE_LOGARITHMIC_GLSL
#include "library/shaped_point.glsl"

// Logarithm of w at the far end of the square over w at its near end; 0: straight. As in C++.
float logarithmic_growth(mat4 shape) {
  const float kStraight = 1.0 / 128.0, kMaxLogGrowth = 9.0;
  float growth = clamp(shape[0].y, -kMaxLogGrowth, kMaxLogGrowth);
  return abs(shape[0].y) >= kStraight ? growth : 0.0;
}

ShapedPoint place_logarithmic(mat4 shape, vec2 size, vec2 ndc) {
  float growth = logarithmic_growth(shape), share = ndc.y * 0.5 + 0.5, slope = 1.0;
  if (growth != 0.0) {
    // 1 / w over its value at the near end, summed from the end where it is least: near that end it is all difference.
    float last = exp(-growth), c = 1.0 - last, inside = clamp(ndc.y, -1.0, 1.0);
    float inverse_w = growth > 0.0 ? last + c * (0.5 - 0.5 * inside) : 1.0 - c * (0.5 * inside + 0.5);
    slope = c / (growth * inverse_w);
    share = (ndc.y - inside) * 0.5 * slope - log(inverse_w) / growth;
  }
  return smooth_point(vec2(ndc.x * 0.5 + 0.5, share) * size, mat2(0.5 * size.x, 0.0, 0.0, 0.5 * size.y * slope));
}

vec2 ndc_of_logarithmic(mat4 shape, vec2 size, vec2 texel) {
  float growth = logarithmic_growth(shape);
  vec2 share = texel / size;
  if (growth != 0.0) {
    float last = exp(-growth), c = 1.0 - last, inside = clamp(share.y, 0.0, 1.0), inverse_w = exp(-growth * inside);
    share.y = (1.0 - inverse_w) / c + (share.y - inside) * growth * inverse_w / c;
  }
  return share * 2.0 - 1.0;
}
#endif
