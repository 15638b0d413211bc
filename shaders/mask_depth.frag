#version 450 core
// The shadow mask by a filter that reads the depth map itself.
#include "common/mask.glsl"

layout(binding = 8) uniform sampler2DArray shadow_points;

// As silhouette.frag stores them.
vec2 shadow_silhouette(ShadowLookup at, vec2 texel) {
  return textureLod(shadow_points, vec3((texel + 0.5) / at.layer_size, at.layer), 0.0).rg * (255.0 / 254.0);
}

float visibility(ShadowLookup at, ShadowMap map, ShadowOptions options) {
  return shadow_visibility(shadow_compare, shadow_depth, at, options);
}
