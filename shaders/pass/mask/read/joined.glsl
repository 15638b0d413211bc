// A filter that reads stored texels that only the filter itself may put together.
#include "library/fetch_joined.glsl"

layout(binding = 8) uniform sampler2DArray shadow_stored[GNOMON_SHADOW_VECTORS];

float visibility(ShadowLookup question, ShadowMap map, ShadowOptions options) {
  ShadowLookup at = stored_lookup(question, map);
  return joined_visibility(shadow_stored, shadow_depth, shadow_depth_max, at, int(filtering.sums.z), options);
}
