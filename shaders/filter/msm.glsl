// Moment shadow maps (Peters, Klein 2015): four moments of the kernel's depths bound the share that is lit.
#include "library/mean.glsl"
#include "library/moments.glsl"
#include "library/variance.glsl"

// Options: bounded, bleed, bias.
ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) { return store_four_moments(depth, options); }

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  vec4 b = moments_of(texel, options, options.value[2], options.unsigned_unit ? 8.0 : 64.0);
  float u = receiver_of_moments(at, at.box);
  vec2 z;
  float dark = options.value[0] > 0.5 ? share_in_front_bounded(b, u) : share_in_front(b, u, z);
  float lit = 1.0 - dark;
  return without_bleeding(lit < 1.0 ? max(lit, 0.0) : 1.0, options.value[1]);
}
