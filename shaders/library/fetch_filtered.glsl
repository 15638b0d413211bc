// Reads stored texels through the hardware's filters: bilinear, and over at.footprint where there are mip-maps.
#ifndef GNOMON_LIBRARY_FETCH_FILTERED_GLSL
#define GNOMON_LIBRARY_FETCH_FILTERED_GLSL
#include "library/footprint.glsl"

// `probes`: at most so many reads along a long footprint.
ShadowTexel fetch_filtered(sampler2DArray stored[GNOMON_SHADOW_VECTORS], ShadowLookup at, int probes) {
  FootprintReads reads = footprint_reads(at, probes);
  ShadowTexel texel;
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel.v[i] = vec4(0.0);
  for (int read = 0; read < reads.count; ++read) {
    vec2 place = at.texel + (float(read) - 0.5 * float(reads.count - 1)) * reads.apart;
    vec3 coordinate = vec3(place / at.layer_size, at.layer);
    for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel.v[i] += textureLod(stored[i], coordinate, reads.level);
  }
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel.v[i] /= float(reads.count);
  return texel;
}
#endif
