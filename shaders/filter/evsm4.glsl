// Variance shadow maps of depths under a rising and a falling exponential warp, the lower bound of the two (Lauritzen,
// McCool 2008).
#include "filter/option/evsm4.glsl"
#include "library/mean.glsl"
#include "library/exponential_variance.glsl"

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = vec4(warped_moments(depth, options.value[option_c]), warped_moments(1.0 - depth, options.value[option_c_negative]));
  return texel;
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  float depth = min(at.depth, 1.0), least = options.value[option_floor];
  float rising = warped_bound(texel.v[0].xy, depth, options.value[option_c], 1.0, least, options.rounding);
  float falling = warped_bound(texel.v[0].zw, depth, options.value[option_c_negative], -1.0, least, options.rounding);
  return without_bleeding(min(rising, falling), options.value[option_bleed]);
}
