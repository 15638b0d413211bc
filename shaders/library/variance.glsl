// Two moments of depths and the bound that they give: shared by the filters that store them. Moments are of
// u = 2 depth - 1, which keeps the numbers smallest.
#ifndef GNOMON_LIBRARY_VARIANCE_GLSL
#define GNOMON_LIBRARY_VARIANCE_GLSL
#include "library/lookup.glsl"

// `slope_share`: share of the surface's slope within a texel that the second moment includes.
ShadowTexel store_moments(float depth, vec2 slope, float slope_share, ShadowOptions options) {
  const float kSteepest = 0.1;  // at an edge the difference of depths is no slope
  float u = 2.0 * depth - 1.0;
  float within = slope_share * min(dot(slope, slope), kSteepest * kSteepest);
  ShadowTexel texel;
  texel.v[0] = vec4(options.unsigned_unit ? depth : u, min(u * u + within, 1.0), 0.0, 0.0);
  return texel;
}

// Chebyshev's one-sided bound. A variance that is not a number counts as lit.
float chebyshev(float mean, float variance, float u) {
  if (!(u > mean)) return 1.0;
  float away = u - mean;
  float lit = variance / (variance + away * away);
  return lit < 1.0 ? max(lit, 0.0) : 1.0;
}

float without_bleeding(float lit, float bleed) { return clamp((lit - bleed) / (1.0 - bleed), 0.0, 1.0); }

// `bleed`: visibility up to this becomes 0. `floor_share`: least variance, as a share of the depth range squared.
float variance_visibility(ShadowTexel texel, ShadowLookup at, float bleed, float floor_share, ShadowOptions options) {
  const float kRoundings = 6.0;  // twice that of the second moment and four times that of the first
  float mean = options.unsigned_unit ? 2.0 * texel.v[0].x - 1.0 : texel.v[0].x;
  float least = max(4.0 * floor_share, kRoundings * options.rounding);
  float variance = max(texel.v[0].y - mean * mean, least);
  return without_bleeding(chebyshev(mean, variance, 2.0 * min(at.depth, 1.0) - 1.0), bleed);
}
#endif
