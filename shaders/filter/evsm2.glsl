// Variance shadow maps of depths under one exponential warp (Lauritzen, McCool 2008).
#include "library/mean.glsl"
#include "library/exponential_variance.glsl"

// Options: c, bleed, floor.
ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = vec4(warped_moments(depth, options.value[0]), 0.0, 0.0);
  return texel;
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  float lit = warped_bound(texel.v[0].xy, min(at.depth, 1.0), options.value[0], 1.0, options.value[2], options.rounding);
  return without_bleeding(lit, options.value[1]);
}
