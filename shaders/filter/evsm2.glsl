// Variance shadow maps of depths under one exponential warp (Lauritzen, McCool 2008).
#include "filter/option/evsm2.glsl"
#include "library/mean.glsl"
#include "library/exponential_variance.glsl"

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = vec4(warped_moments(depth, options.value[option_c]), 0.0, 0.0);
  return texel;
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  float c = options.value[option_c], least = options.value[option_floor];
  float lit = warped_bound(texel.v[0].xy, min(at.depth, 1.0), c, 1.0, least, options.rounding);
  return without_bleeding(lit, options.value[option_bleed]);
}
