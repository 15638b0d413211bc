#version 450 core
// The blur along y, of what store.frag has blurred along x. The part <target> says where.
#include "pass/common/filter.glsl"
#include "pass/store/wanted.glsl"
#include <filter>
#include <target>

layout(binding = 8) uniform sampler2DArray stored[GNOMON_SHADOW_VECTORS];
layout(location = 0) out vec4 texel_out[GNOMON_SHADOW_VECTORS];

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  if (kTiled && !wanted_within(texel, 0, map)) discard;
  ivec4 inside_of = place_in(textureSize(stored[0], 0).xy);
  ivec2 rows = ivec2(inside_of.y, inside_of.y + inside_of.w);
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
