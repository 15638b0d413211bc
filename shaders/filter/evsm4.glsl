// Variance shadow maps of depths under a rising and a falling exponential warp, the lower bound of the two (Lauritzen,
// McCool 2008).
#include "library/mean.glsl"
#include "library/exponential_variance.glsl"

// Options: c, c_negative, bleed, floor.
ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = vec4(warped_moments(depth, options.value[0]), warped_moments(1.0 - depth, options.value[1]));
  return texel;
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  float depth = min(at.depth, 1.0);
  float rising = warped_bound(texel.v[0].xy, depth, options.value[0], 1.0, options.value[3], options.rounding);
  float falling = warped_bound(texel.v[0].zw, depth, options.value[1], -1.0, options.value[3], options.rounding);
  return without_bleeding(min(rising, falling), options.value[2]);
}
