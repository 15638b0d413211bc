#version 450 core
// From depths to stored texels, and the blur along x in the same pass.
#include "common/stored.glsl"

layout(location = 0) out vec4 texel_out[GNOMON_SHADOW_VECTORS];

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  ShadowOptions options = shadow_options(map);
  ShadowTexel sum = shadow_nothing(options);
  int reach = filtering.reach[map].x;
  for (int i = -reach; i <= reach; ++i) {
    shadow_join(sum, stored_at(texel + ivec2(i, 0), options), tap_weight(map, abs(i)), options);
  }
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel_out[i] = sum.v[i];
}
