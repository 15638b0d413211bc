#version 450 core
// The next smaller mip level of stored texels that only the filter itself may put together.
#include "pass/common/filter.glsl"
#include <filter>

// Its base level is the one to read.
layout(binding = 8) uniform sampler2DArray stored[GNOMON_SHADOW_VECTORS];
layout(location = 0) uniform int map;
layout(location = 0) out vec4 texel_out[GNOMON_SHADOW_VECTORS];

void main() {
  ivec2 last = textureSize(stored[0], 0).xy - 1;
  ShadowOptions options = shadow_options(map);
  ShadowTexel sum = shadow_nothing(options);
  for (int corner = 0; corner < 4; ++corner) {
    ivec2 at = min(2 * ivec2(gl_FragCoord.xy) + ivec2(corner & 1, corner >> 1), last);
    ShadowTexel next;
    for (int k = 0; k < GNOMON_SHADOW_VECTORS; ++k) next.v[k] = texelFetch(stored[k], ivec3(at, map), 0);
    shadow_join(sum, next, 0.25, options);
  }
#ifdef SHADOW_PACKS
  sum = shadow_pack(sum, options);
#endif
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel_out[i] = sum.v[i];
}
