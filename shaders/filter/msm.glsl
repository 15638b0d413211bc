// Moment shadow maps (Peters, Klein 2015): four moments of the kernel's depths bound the share that is lit. A texel stores
// their means (GNOMON_MEAN, the default), or what 16 bits round without harm and has no means: see packed_moments.
#ifndef GNOMON_MEAN
#define GNOMON_MEAN 1
#endif
#include "filter/option/msm.glsl"
#include "library/moments.glsl"
#include "library/variance.glsl"

#if GNOMON_MEAN
#include "library/mean.glsl"

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) { return store_four_moments(depth, options); }

vec4 read_moments(ShadowTexel texel, ShadowOptions options) {
  return moments_of(texel, options, options.value[option_bias], options.unsigned_unit ? 8.0 : 64.0);
}
#else
ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = vec4(depth, depth, 0.5, 0.0);
  return texel;
}

ShadowTexel shadow_nothing(ShadowOptions options) {
  ShadowTexel sum;
  sum.v[0] = vec4(0.0);
  return sum;
}

void shadow_join(inout ShadowTexel sum, ShadowTexel texel, float weight, ShadowOptions options) {
  sum.v[0] += weight * unpacked_moments(texel.v[0]);
}

#define SHADOW_PACKS 1
ShadowTexel shadow_pack(ShadowTexel sum, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = packed_moments(sum.v[0]);
  return texel;
}

// Moments of numbers that were rounded apart are moments all the same: only sums round.
vec4 read_moments(ShadowTexel texel, ShadowOptions options) {
  const float kRounding = 64.0 / 16777216.0;
  return mix(texel.v[0], kSpreadOut, max(options.value[option_bias], kRounding));
}
#endif

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  vec4 b = read_moments(texel, options);
  float u = receiver_of_moments(at, at.box);
  vec2 z;
  float dark = options.value[option_bounded] > 0.5 ? share_in_front_bounded(b, u) : share_in_front(b, u, z);
  float lit = 1.0 - dark;
  return without_bleeding(lit < 1.0 ? max(lit, 0.0) : 1.0, options.value[option_bleed]);
}
