// A filter that reads stored texels whose means the hardware takes.
#include "library/fetch_filtered.glsl"

layout(binding = 8) uniform sampler2DArray shadow_stored[GNOMON_SHADOW_VECTORS];

float visibility(ShadowLookup question, ShadowMap map, ShadowOptions options) {
  ShadowLookup at = stored_lookup(question, map);
  return shadow_visibility(fetch_filtered(shadow_stored, at, int(filtering.sums.z)), shadow_depth, shadow_depth_max, at, options);
}
