// A filter that reads a summed-area table.
#include "library/fetch_summed.glsl"

layout(binding = 8) uniform usampler2DArray shadow_sums;

// For filters that read a second box.
ShadowTexel shadow_mean(ShadowLookup at) { return fetch_summed(shadow_sums, at, filtering.sums.x); }

float visibility(ShadowLookup question, ShadowMap map, ShadowOptions options) {
  ShadowLookup at = stored_lookup(question, map);
  return shadow_visibility(shadow_mean(at), shadow_depth, shadow_depth_max, at, options);
}
