// The blur along y, of what store_texels.glsl has blurred along x.
#ifndef GNOMON_COMMON_BLUR_TEXELS_GLSL
#define GNOMON_COMMON_BLUR_TEXELS_GLSL
#include "common/filter.glsl"
#include <filter>
#ifdef GNOMON_PAGES
#include "common/page_slot.glsl"
#else
#include "common/wanted.glsl"
layout(location = 0) uniform int map;
#endif

layout(binding = 8) uniform sampler2DArray stored[GNOMON_SHADOW_VECTORS];
layout(location = 0) out vec4 texel_out[GNOMON_SHADOW_VECTORS];

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#ifdef GNOMON_PAGES
  ivec2 rows = ivec2(slot.y, slot.y + slot.w);
#else
  if (!wanted_within(texel, 0, map)) discard;
  ivec2 rows = ivec2(0, textureSize(stored[0], 0).y);
#endif
  ShadowOptions options = shadow_options(map);
  ShadowTexel sum = shadow_nothing(options);
  ShadowTexel outside = shadow_store(1.0, vec2(0.0), options);
  int reach = filtering.reach[map].x;
  for (int i = -reach; i <= reach; ++i) {
    ivec2 at = texel + ivec2(0, i);
    ShadowTexel next = outside;
    if (at.y >= rows.x && at.y < rows.y) {
      for (int k = 0; k < GNOMON_SHADOW_VECTORS; ++k) next.v[k] = texelFetch(stored[k], ivec3(at, 0), 0);
    }
    shadow_join(sum, next, tap_weight(map, abs(i)), options);
  }
#ifdef SHADOW_PACKS
  sum = shadow_pack(sum, options);
#endif
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel_out[i] = sum.v[i];
}
#endif
