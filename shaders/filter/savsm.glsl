// Summed-area variance shadow maps (Lauritzen 2007): the two moments of vsm, their means taken from a summed-area table
// of integers.
#include "filter/option/savsm.glsl"
#include "library/mean.glsl"
#include "library/variance.glsl"

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  return store_moments(depth, slope, options.value[option_slope], options);
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  return variance_visibility(texel, at, options.value[option_bleed], options.value[option_floor], options);
}
