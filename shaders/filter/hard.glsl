// One texel, one comparison (Williams 1978). The receiver's plane is compared where the texel was sampled: at its
// centre.
#include "common/shadow_lookup.glsl"

vec4 shadow_store(float depth) { return vec4(depth, 0.0, 0.0, 0.0); }

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray map, ShadowLookup at,
                        ShadowParameters parameters) {
  vec2 centre = floor(at.texel) + 0.5;
  // The plane may go on behind the map's far plane, where nothing is drawn: lit.
  float depth = min(at.depth + dot(at.depth_gradient, centre - at.texel), 1.0);
  float stored = textureLod(map, vec3(centre / at.layer_size, at.layer), 0.0).r;
  return depth <= stored ? 1.0 : 0.0;
}
