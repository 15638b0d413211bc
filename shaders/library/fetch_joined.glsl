// Reads stored texels that only the filter's own shadow_join may put together, bilinear and over at.footprint where there
// are mip-maps. The filter's file is included before this one.
#include "library/lookup.glsl"

void join_2x2(inout ShadowTexel sum, sampler2DArray stored[GNOMON_SHADOW_VECTORS], ShadowLookup at, int level,
              float share, ShadowOptions options) {
  ivec2 last = textureSize(stored[0], level).xy - 1;
  vec2 texel = at.texel / at.layer_size * vec2(last + 1) - 0.5;
  ivec2 first = ivec2(floor(texel));
  vec2 part = texel - vec2(first);
  for (int corner = 0; corner < 4; ++corner) {
    ivec2 step_to = ivec2(corner & 1, corner >> 1);
    vec2 weight = mix(1.0 - part, part, vec2(step_to));
    if (weight.x * weight.y * share <= 0.0) continue;
    ShadowTexel texel_at;
    for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) {
      texel_at.v[i] = texelFetch(stored[i], ivec3(clamp(first + step_to, ivec2(0), last), int(at.layer)), level);
    }
    shadow_join(sum, texel_at, weight.x * weight.y * share, options);
  }
}

ShadowTexel fetch_joined(sampler2DArray stored[GNOMON_SHADOW_VECTORS], ShadowLookup at, ShadowOptions options) {
  float longest = max(length(at.footprint[0]), length(at.footprint[1]));
  float level = clamp(log2(max(longest, 1.0)), 0.0, float(textureQueryLevels(stored[0]) - 1));
  ShadowTexel sum = shadow_nothing(options);
  join_2x2(sum, stored, at, int(level), 1.0 - fract(level), options);
  if (fract(level) > 0.0) join_2x2(sum, stored, at, int(level) + 1, fract(level), options);
  return sum;
}
