// Reads stored texels that only the filter's own shadow_join may put together, bilinear and over at.footprint where there
// are mip-maps. The filter's file is included before this one.
#ifndef GNOMON_LIBRARY_FETCH_JOINED_GLSL
#define GNOMON_LIBRARY_FETCH_JOINED_GLSL
#include "library/compare.glsl"
#include "library/footprint.glsl"

// Texels are read at their centres, by place: software renderers take one level for four neighbouring pixels, and a texel
// that is counted in another pixel's level may lie outside of this one.
void join_2x2(inout ShadowTexel sum, sampler2DArray stored[GNOMON_SHADOW_VECTORS], vec3 place, int level, float share,
              ShadowOptions options) {
  vec2 size = vec2(textureSize(stored[0], level).xy);
  vec2 texel = place.xy * size - 0.5;
  vec2 first = floor(texel), part = texel - first;
  for (int corner = 0; corner < 4; ++corner) {
    vec2 step_to = vec2(corner & 1, corner >> 1);
    vec2 weight = mix(1.0 - part, part, step_to);
    if (weight.x * weight.y * share <= 0.0) continue;
    vec2 centre = clamp(first + step_to, vec2(0.0), size - 1.0) + 0.5;
    ShadowTexel texel_at;
    for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) {
      texel_at.v[i] = textureLod(stored[i], vec3(centre / size, place.z), float(level));
    }
    shadow_join(sum, texel_at, weight.x * weight.y * share, options);
  }
}

// `probes`: at most so many reads along a long footprint.
ShadowTexel fetch_joined(sampler2DArray stored[GNOMON_SHADOW_VECTORS], ShadowLookup at, int probes,
                         ShadowOptions options) {
  FootprintReads reads = footprint_reads(at, probes);
  float level = min(reads.level, float(textureQueryLevels(stored[0]) - 1)), share = 1.0 / float(reads.count);
  ShadowTexel sum = shadow_nothing(options);
  for (int read = 0; read < reads.count; ++read) {
    vec2 texel = at.texel + (float(read) - 0.5 * float(reads.count - 1)) * reads.apart;
    vec3 place = vec3(texel / at.layer_size, at.layer);
    join_2x2(sum, stored, place, int(level), (1.0 - fract(level)) * share, options);
    if (fract(level) > 0.0) join_2x2(sum, stored, place, int(level) + 1, fract(level) * share, options);
  }
  return sum;
}

#ifdef SHADOW_INTERPOLATES
// The mean of what the filter makes of four texels, weighted bilinearly: each against the receiver's plane at the texel's
// centre.
float visibility_2x2(sampler2DArray stored[GNOMON_SHADOW_VECTORS], vec3 place, int level, sampler2DArray depth_map,
                     sampler2DArray depth_max, ShadowLookup at, ShadowOptions options) {
  vec2 size = vec2(textureSize(stored[0], level).xy);
  vec2 texel = place.xy * size - 0.5;
  vec2 first = floor(texel), part = texel - first;
  float lit = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    vec2 step_to = vec2(corner & 1, corner >> 1);
    vec2 weight = mix(1.0 - part, part, step_to);
    vec2 centre = clamp(first + step_to, vec2(0.0), size - 1.0) + 0.5;
    ShadowTexel texel_at;
    for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) {
      texel_at.v[i] = textureLod(stored[i], vec3(centre / size, place.z), float(level));
    }
    ShadowLookup there = at;
    there.depth = plane_depth(at, centre / size * at.layer_size - at.texel);
    lit += weight.x * weight.y * shadow_visibility(texel_at, depth_map, depth_max, there, options);
  }
  return lit;
}
#endif

// The filter's result at a point: from what it joins its texels to, or the mean of its results for each where it
// defines SHADOW_INTERPOLATES.
float joined_visibility(sampler2DArray stored[GNOMON_SHADOW_VECTORS], sampler2DArray depth_map, sampler2DArray depth_max,
                        ShadowLookup at, int probes, ShadowOptions options) {
#ifdef SHADOW_INTERPOLATES
  FootprintReads reads = footprint_reads(at, probes);
  float level = min(reads.level, float(textureQueryLevels(stored[0]) - 1)), share = 1.0 / float(reads.count);
  float lit = 0.0;
  for (int read = 0; read < reads.count; ++read) {
    vec2 texel = at.texel + (float(read) - 0.5 * float(reads.count - 1)) * reads.apart;
    vec3 place = vec3(texel / at.layer_size, at.layer);
    float fine = visibility_2x2(stored, place, int(level), depth_map, depth_max, at, options);
    if (fract(level) > 0.0) {
      fine = mix(fine, visibility_2x2(stored, place, int(level) + 1, depth_map, depth_max, at, options), fract(level));
    }
    lit += share * fine;
  }
  return min(lit, 1.0);
#else
  return shadow_visibility(fetch_joined(stored, at, probes, options), depth_map, depth_max, at, options);
#endif
}
#endif
