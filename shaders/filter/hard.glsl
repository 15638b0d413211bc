// One texel, one comparison (Williams 1978). The receiver's plane is compared where the texel was sampled: at its
// centre.
#include "library/compare.glsl"

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  vec2 centre = floor(at.texel) + 0.5;
  float stored = depth_of_texel(textureLod(depth_map, vec3(centre / at.layer_size, at.layer), 0.0).r);
  return plane_depth(at, centre - at.texel) <= stored ? 1.0 : 0.0;
}
