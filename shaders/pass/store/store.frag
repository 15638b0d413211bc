#version 450 core
// From depths to stored texels, and the blur along x in the same pass.
#include "pass/store/stored.glsl"
#include "pass/store/wanted.glsl"

layout(location = 0) out vec4 texel_out[GNOMON_SHADOW_VECTORS];

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  ShadowOptions options = shadow_options(map);
  ShadowTexel sum = shadow_nothing(options);
  int reach = filtering.reach[map].x;
  if (kTiled && !wanted_within(texel, reach, map)) discard;
  // Each depth along x is fetched once, though three taps use it.
  float before = depth_at(texel - ivec2(reach + 1, 0)), here = depth_at(texel - ivec2(reach, 0));
  for (int i = -reach; i <= reach; ++i) {
    ivec2 at = texel + ivec2(i, 0);
    float after = depth_at(at + ivec2(1, 0));
    vec2 slope = vec2(smaller_step(before, here, after), slope_along_y(at, here));
    shadow_join(sum, shadow_store(here, slope, options), tap_weight(map, abs(i)), options);
    before = here;
    here = after;
  }
#ifdef SHADOW_PACKS
  sum = shadow_pack(sum, options);
#endif
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel_out[i] = sum.v[i];
}
