// Stored texels that are put together by their weighted mean: most are.
#ifndef GNOMON_LIBRARY_MEAN_GLSL
#define GNOMON_LIBRARY_MEAN_GLSL
#include "library/lookup.glsl"

ShadowTexel shadow_nothing(ShadowOptions options) {
  ShadowTexel sum;
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) sum.v[i] = vec4(0.0);
  return sum;
}

void shadow_join(inout ShadowTexel sum, ShadowTexel texel, float weight, ShadowOptions options) {
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) sum.v[i] += weight * texel.v[i];
}
#endif
