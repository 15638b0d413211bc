// Reads stored texels through the hardware's filters: bilinear, and over at.footprint where there are mip-maps.
#include "library/lookup.glsl"

ShadowTexel fetch_filtered(sampler2DArray stored[GNOMON_SHADOW_VECTORS], ShadowLookup at) {
  ShadowTexel texel;
  vec3 coordinate = vec3(at.texel / at.layer_size, at.layer);
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) {
    texel.v[i] = textureGrad(stored[i], coordinate, at.footprint[0] / at.layer_size, at.footprint[1] / at.layer_size);
  }
  return texel;
}
