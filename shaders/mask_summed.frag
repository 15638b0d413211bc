#version 450 core
// The shadow mask by a filter that reads a summed-area table.
#include "common/mask.glsl"
#include "library/fetch_summed.glsl"

layout(binding = 8) uniform usampler2DArray shadow_sums;

float visibility(ShadowLookup question, ShadowMap map, ShadowOptions options) {
  ShadowLookup at = stored_lookup(question, map);
  return shadow_visibility(fetch_summed(shadow_sums, at, filtering.sums.x), shadow_depth, shadow_depth_max, at, options);
}
